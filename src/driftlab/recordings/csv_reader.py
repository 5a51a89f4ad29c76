"""Anybody's log, as text in columns: what each column is must be said once, or stand in its header.

Logs in other forms (ULog, rosbag, what vendors write) come with tools of their own that write CSV.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from driftlab.checks import checked_path

from ._record_of_table import Columns, Time, record_of_table
from ._text_table import read_table
from .recording import Recording


def read_csv(
    path: str | Path,
    *,
    gyro: Columns,
    accelerometer: Columns | None = None,
    units: str | Sequence[str] | None = None,
    zeros: Sequence[float] = (0.0, 0.0),
    time: Time | None = None,
    interval: float | None = None,
    rate: float | None = None,
    longest_gap: float = 1.5,
    axes: str = "",
    latitude: float | None = None,
    gravity: float | None = None,
    name: str = "",
    source: str = "",
    licence: str = "",
    allow: Sequence[str] = (),
) -> Recording:
    """Read the log of an inertial unit from a text file with columns.

    The record of a unit on a turntable goes on by `Recording.increments` to
    `driftlab.calibration.calibrate`, as chapter 08 shows.

    Parameters
    ----------
    path : str or Path
        Numbers between commas, semicolons, tabs or blanks, with decimal points, or with decimal
        commas if the delimiter is another; lines that begin with %, # or // are comments.
    gyro, accelerometer : sequence of str or int
        Three columns each, in the order of the axes: names from the header, without their units, or
        numbers counted from 1. A minus before either, as in "-gyr_y", changes the sign.
    units : str or sequence of str, optional
        Of the gyros and the accelerometers, ("deg/s", "g") say, or of the gyros alone. Those of
        increments, as ("arcsec", "ug*s"), make a record of increments. Before a unit the size of
        one count may stand: "1/131 deg/s". Without `units` the header must tell them, in brackets.
    zeros : sequence of float
        What stands in the file for zero, of the gyros and of the accelerometers: 32768, say, of
        counts that have no sign.
    time : str, int or tuple, optional
        Column of time stamps; with its unit, as ("t", "ms"), if the header does not tell it; the
        unit "iso" stands for dates and times such as 2024-05-01T12:00:00.25.
    interval, rate : float, optional
        Between samples, s, or how many there are in a second. Give one of time, interval, rate.
    longest_gap : float
        Longest step of the time stamps that is let through, in usual steps; any if "gap" is
        allowed. Integrals of the rates bridge it by a spline.
    axes : str
        Body axes, as in `driftlab.axes`.
    latitude, gravity : float, optional
        Of the place, rad and m/s^2.
    name, source, licence : str
        As in `Recording`; the file's name, if none is given.
    allow : sequence of str
        Rules of `guards.doubts` that this log may break.

    Returns
    -------
    Recording
        In SI units, with `times` since the first sample if the stamps are not equally spaced.

    Raises
    ------
    ValueError
        With the number of the line: if a cell is empty, NaN or no number, a line is too short or
        too long, or time stamps stand still or leave a gap. If a column or unit is unknown, rates
        stand beside increments, or `guards.doubts` has some.
    OSError
        If the file cannot be read.

    See Also
    --------
    from_dataframe : From a table in memory.
    rests : Where the unit lay still.
    Recording.increments : What filters and algorithms take.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> header = "t,Gyroscope x (deg/s),Gyroscope y (deg/s),Gyroscope z (deg/s)"
    >>> with TemporaryDirectory() as folder:
    ...     log = Path(folder, "phone.csv")
    ...     _ = log.write_text(header + "\\n0,90,1,0\\n10,90,2,0\\n20,90,3,1\\n", encoding="utf-8")
    ...     columns = ("Gyroscope x", "-Gyroscope y", "Gyroscope z")
    ...     recording = read_csv(log, gyro=columns, time=("t", "ms"))
    >>> recording.interval, recording.kind, recording.gyro[0].round(4)
    (0.01, 'rates', array([ 1.5708, -0.0175,  0.    ]))
    """
    table = read_table(checked_path(path, "path"))
    return record_of_table(
        table,
        gyro=gyro,
        accelerometer=accelerometer,
        units=units,
        zeros=zeros,
        time=time,
        interval=interval,
        rate=rate,
        longest_gap=longest_gap,
        axes=axes,
        latitude=latitude,
        gravity=gravity,
        name=name or table.path.stem,
        source=source,
        licence=licence,
        allow=allow,
    )
