"""Logs of the program IMU-TK: two text files with a time stamp and three numbers in a line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from driftlab.checks import checked_path, finite_array, shown

from ._record_of_table import checked_kind
from ._text_table import read_table
from ._time_stamps import checked_longest_gap, spacing_of_stamps
from .guards import without_doubts
from .recording import Recording
from .units import accelerometer_unit, gyro_unit


def read_imu_tk(
    accelerometer_path: str | Path,
    gyro_path: str | Path,
    *,
    units: Sequence[str] = ("rad/s", "m/s^2"),
    zeros: Sequence[float] = (0.0, 0.0),
    longest_gap: float = 1.5,
    axes: str = "",
    latitude: float | None = None,
    gravity: float | None = None,
    name: str = "",
    source: str = "",
    licence: str = "",
    allow: Sequence[str] = (),
) -> Recording:
    """Read a log in the form of IMU-TK.

    Parameters
    ----------
    accelerometer_path, gyro_path : str or Path
        The two files: time in s, and the three axes. Their time stamps must be the same.
    units : sequence of str
        Of the gyros and the accelerometers; of raw counts with the size of one, as
        ("1/4778 rad/s", "1/415 m/s^2").
    zeros : sequence of float
        What stands in the files for zero, of the gyros and of the accelerometers.
    longest_gap : float
        Longest step of the time stamps that is let through, in usual steps.
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
        In SI units.

    Raises
    ------
    ValueError
        If the two have not the same stamps, or as for `csv_reader.read_csv`.
    OSError
        If a file cannot be read.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     acc, gyro = Path(folder, "acc.mat"), Path(folder, "gyro.mat")
    ...     _ = acc.write_text("0.00 0.1 0.2 9.7\\n0.01 0.1 0.1 9.8\\n0.02 0.2 0.1 9.9\\n")
    ...     _ = gyro.write_text("0.00 0.1 0.2 0.3\\n0.01 0.1 0.1 0.2\\n0.02 0.2 0.1 0.1\\n")
    ...     recording = read_imu_tk(acc, gyro)
    >>> recording.interval, recording.gyro[:, 2]
    (0.01, array([0.3, 0.2, 0.1]))
    """
    accelerometer_path = checked_path(accelerometer_path, "accelerometer_path")
    gyro_path = checked_path(gyro_path, "gyro_path")
    if not isinstance(units, tuple | list) or len(units) != 2:
        raise ValueError(f"units: expected two, of gyros and accelerometers, got {shown(units)}.")
    scales = gyro_unit(units[0]), accelerometer_unit(units[1])
    checked_kind(scales)
    offsets = finite_array(zeros, "zeros", 2)
    if offsets.ndim > 1:
        raise ValueError(f"zeros: expected shape (2,), got shape {offsets.shape}.")
    longest_gap = checked_longest_gap(longest_gap)
    tables = read_table(gyro_path), read_table(accelerometer_path)
    for table in tables:
        if table.width != 4:
            raise ValueError(
                f"{table.path.name}: expected a time stamp and three numbers in a line, got "
                f"{table.width} cells."
            )
    gyro, accelerometer = (table.numbers(range(4)) for table in tables)
    if len(gyro) != len(accelerometer) or (gyro[:, 0] != accelerometer[:, 0]).any():
        raise ValueError(
            f"gyro_path: expected the time stamps of {tables[1].path.name}, got others: the triads "
            "were not sampled together, and this reader resamples nothing."
        )
    stamps = gyro[:, 0] - gyro[0, 0]
    interval, times = spacing_of_stamps(stamps, longest_gap, tables[0].place)
    recording = Recording(
        gyro=scales[0].size * (gyro[:, 1:] - offsets[0]),
        accelerometer=scales[1].size * (accelerometer[:, 1:] - offsets[1]),
        interval=interval,
        kind=scales[0].kind,
        times=times,
        axes=axes,
        latitude=latitude,
        gravity=gravity,
        name=name or tables[0].path.stem,
        source=source,
        licence=licence,
    )
    return without_doubts(recording, allow)
