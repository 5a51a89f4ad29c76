"""Logs of the toolbox PSINS: pulses of gyros and accelerometers, after their place and scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from driftlab import earth
from driftlab.checks import FloatArray, checked_path

from ._text_table import TextTable, read_table
from .guards import without_doubts
from .recording import Recording


@dataclass(frozen=True, eq=False)
class PsinsHeader:
    """What the first three lines of numbers of a PSINS log say; "maybe inaccurate", as they put it.

    Attributes
    ----------
    pitch, roll, heading : float
        At the start, rad, as in PSINS: the heading is positive from North to West.
    velocity : ndarray, shape (3,)
        East, North, Up, m/s.
    latitude, longitude : float
        rad.
    height : float
        m.
    start, interval : float
        Of the samples, s.
    gravity : float
        m/s^2; one g of the scale of the accelerometers, seldom that of the place.
    gyro_scale : ndarray, shape (3,)
        rad a pulse.
    accelerometer_scale : ndarray, shape (3,)
        m/s a pulse.
    """

    pitch: float
    roll: float
    heading: float
    velocity: FloatArray
    latitude: float
    longitude: float
    height: float
    start: float
    interval: float
    gravity: float
    gyro_scale: FloatArray
    accelerometer_scale: FloatArray


def psins_header(path: str | Path) -> PsinsHeader:
    """Return what stands before the samples of a PSINS log.

    Parameters
    ----------
    path : str or Path
        A text file: comments (%), three lines with six numbers each, then six pulses in a line.

    Returns
    -------
    PsinsHeader

    Raises
    ------
    ValueError
        If the file is no such log.
    OSError
        If it cannot be read.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     log = Path(folder, "ring.imu")
    ...     head = "0 0 -90 0 0 0\\n30 0 0 0 10 9.78\\n.1 .1 .1 125 125 125\\n"
    ...     _ = log.write_text(head + "1 0 2 0 0 80\\n")
    ...     header = psins_header(log)
    >>> header.heading, header.interval
    (-1.5707963267948966, 0.01)
    """
    table, rows = _rows(path)
    return _header(table, rows)


def read_psins(
    path: str | Path,
    *,
    name: str = "",
    source: str = "",
    licence: str = "",
    allow: Sequence[str] = (),
) -> Recording:
    """Read a log of PSINS.

    Parameters
    ----------
    path : str or Path
        As for `psins_header`.
    name, source, licence : str
        As in `Recording`.
    allow : sequence of str
        Rules of `guards.doubts` that this log may break.

    Returns
    -------
    Recording
        Increments in the axes right, forward, up (RFU), the toolbox's convention. The latitude is
        the header's; gravity that of the ellipsoid at its latitude and height.

    Raises
    ------
    ValueError
        If the file is no such log, a line is no line of six numbers, or `guards.doubts` has some.
    OSError
        If it cannot be read.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     log = Path(folder, "ring.imu")
    ...     head = "0 0 -90 0 0 0\\n30 0 0 0 10 9.78\\n.1 .1 .1 125 125 125\\n"
    ...     _ = log.write_text(head + "1 0 2 0 0 80\\n")
    ...     recording = read_psins(log)
    >>> recording.axes, recording.interval, recording.accelerometer
    ('RFU', 0.01, array([[0.    , 0.    , 0.0978]]))
    """
    table, rows = _rows(path)
    header = _header(table, rows)
    recording = Recording(
        header.gyro_scale * rows[3:, :3],
        header.accelerometer_scale * rows[3:, 3:],
        header.interval,
        "increments",
        axes="RFU",
        latitude=header.latitude,
        gravity=float(earth.gravity(header.latitude, header.height)),
        name=name or table.path.stem,
        source=source,
        licence=licence,
    )
    return without_doubts(recording, allow)


def _rows(path: str | Path) -> tuple[TextTable, FloatArray]:
    table = read_table(checked_path(path, "path"))
    if table.width != 6:
        raise ValueError(f"{table.path.name}: expected six numbers in a line, got {table.width}.")
    rows = table.numbers(range(6))
    if len(rows) < 4:
        raise ValueError(
            f"{table.path.name}: expected three lines of header and then samples, got {len(rows)} "
            "lines."
        )
    return table, rows


def _header(table: TextTable, rows: FloatArray) -> PsinsHeader:
    attitude, place, scale = rows[:3]
    latitude, longitude = np.radians(place[:2])
    pitch, roll, heading = np.radians(attitude[:3])
    for row, values in ((1, place[4:]), (2, scale)):
        if not (values > 0).all():
            raise ValueError(
                f"{table.place(row)}: expected interval, gravity and "
                f"scale above zero, got {values.min():g}."
            )
    return PsinsHeader(
        float(pitch),
        float(roll),
        float(heading),
        attitude[3:],
        float(earth.checked_latitude(latitude)),
        float(longitude),
        height=float(place[2]),
        start=float(place[3]),
        interval=float(place[4] / 1000),
        gravity=float(place[5]),
        gyro_scale=np.radians(scale[:3] / 3600),
        accelerometer_scale=1e-6 * place[5] * scale[3:],
    )
