"""Anybody's log, as text in columns: what each column is must be said once, or stand in its header.

Logs in other forms (ULog, rosbag, what vendors write) come with tools of their own that write CSV.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from driftlab.checks import FloatArray, finite_array, positive_number

from ._text_table import TextTable, read_table
from ._time_stamps import spacing_of_stamps
from .guards import without_doubts
from .recording import Recording
from .units import Unit, accelerometer_unit, gyro_unit, time_unit

Columns = Sequence[str | int]
ANY_GAP = 1e12
"""In usual steps."""


def read_csv(
    path: str | Path,
    *,
    gyro: Columns,
    accelerometer: Columns | None = None,
    units: str | Sequence[str] | None = None,
    zeros: Sequence[float] = (0.0, 0.0),
    time: str | int | tuple[str | int, str] | None = None,
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
        As for `text_table.read_table`, which finds the delimiter and the decimal sign.
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
    table = read_table(path)
    columns = {"gyro": gyro} | ({} if accelerometer is None else {"accelerometer": accelerometer})
    places = {triad: _places(table, wanted, triad) for triad, wanted in columns.items()}
    scales = _scales(table, places, units)
    offsets = finite_array(zeros, "zeros", 2)
    stamp, size = _stamp_column(table, time, interval, rate)
    indices = [index for triad in places.values() for index, _ in triad]
    numbers = table.numbers(indices if size is None else [*indices, stamp])
    triads = []
    for i, (triad, scale) in enumerate(zip(places.values(), scales, strict=True)):
        signs = np.array([sign for _, sign in triad])
        triads.append(scale.size * signs * (numbers[:, 3 * i : 3 * i + 3] - offsets[i]))
    longest = ANY_GAP if "gap" in allow else positive_number(longest_gap, "longest_gap")
    times = None
    if time is None:
        spacing = float(interval or 1 / (rate or 1))
    else:
        if size is None:
            stamps = _seconds_of_dates(table, stamp)
        else:  # first the difference: of 1.7e18 ns, say, little is left in s
            stamps = size * (numbers[:, -1] - numbers[0, -1])
        spacing, times = spacing_of_stamps(stamps, longest, table.place)
    recording = Recording(
        triads[0],
        triads[1] if len(triads) > 1 else None,
        spacing,
        scales[0].kind,
        times,
        axes,
        latitude,
        gravity,
        name or table.path.stem,
        source,
        licence,
        longest,
    )
    return without_doubts(recording, allow)


def checked_kind(scales: Sequence[Unit]) -> None:
    """Refuse rates beside increments.

    Parameters
    ----------
    scales : sequence of Unit
        Of the gyros, and of the accelerometers if there are any.

    Raises
    ------
    ValueError
        If they are of two kinds.

    Examples
    --------
    >>> checked_kind([gyro_unit("deg"), accelerometer_unit("m/s")])
    """
    if len({scale.kind for scale in scales}) > 1:
        words = {"rates": "rates", "increments": "increments over each interval"}
        raise ValueError(
            "units: expected rates with specific force, or increments of angle with those of "
            f"velocity, got {words[scales[0].kind]} of the gyros with "
            f"{words[scales[1].kind]} of the accelerometers; read the triads one by one."
        )


def _places(table: TextTable, wanted: Columns, triad: str) -> list[tuple[int, int]]:
    """Indices and signs of the three columns of a triad."""
    if isinstance(wanted, str) or len(wanted) != 3:
        raise ValueError(f"{triad}: expected three columns, got {wanted!r}.")
    return [table.column(one) for one in wanted]


def _scales(
    table: TextTable,
    places: dict[str, list[tuple[int, int]]],
    units: str | Sequence[str] | None,
) -> list[Unit]:
    """Units of the triads, as told or as the header has them."""
    told: list[str | None] = [None] * len(places)
    if units is not None:
        told = [units] if isinstance(units, str) else list(units)
    if len(told) != len(places):
        raise ValueError(f"units: expected one for each of {', '.join(places)}, got {units!r}.")
    meanings = {"gyro": gyro_unit, "accelerometer": accelerometer_unit}
    scales = []
    for unit, (triad, columns) in zip(told, places.items(), strict=True):
        meaning = meanings[triad]
        written = {table.units[index] for index, _ in columns} if table.units else {""}
        if unit is None:
            if len(written) > 1:
                raise ValueError(
                    f"units: expected one unit for all columns of {triad}, got "
                    f"{' and '.join(sorted(map(repr, written)))} in the header."
                )
            unit = written.pop()
        elif any(one and meaning(one) != meaning(unit) for one in written):
            known = " or ".join(sorted(filter(None, written)))
            raise ValueError(
                f"units: expected {known} for {triad}, as the header of {table.path.name} has it, "
                f"got {unit!r}."
            )
        scales.append(meaning(unit))
    checked_kind(scales)
    return scales


def _stamp_column(
    table: TextTable,
    time: str | int | tuple[str | int, str] | None,
    interval: float | None,
    rate: float | None,
) -> tuple[int, float | None]:
    """Index of the column of time stamps and size of its unit, None if they are no numbers."""
    if sum(value is not None for value in (time, interval, rate)) != 1:
        raise ValueError(
            f"time, interval, rate: expected one of them, got {time!r}, {interval!r} and {rate!r}."
        )
    if time is None:
        positive_number(interval or rate or 0, "rate" if interval is None else "interval")
        return -1, None
    column, unit = time if isinstance(time, tuple) else (time, "")
    index, _ = table.column(column)
    unit = unit or (table.units[index] if table.units else "")
    if not unit:
        raise ValueError(
            f"time: expected a unit beside column {column!r} (s, ms, us, ns, or iso for dates and "
            "times), because the header does not tell it, got none."
        )
    return index, None if unit == "iso" else time_unit(unit)


def _seconds_of_dates(table: TextTable, index: int) -> FloatArray:
    """Seconds since the first of the dates and times in a column, all of one time zone."""
    dates = []
    for row, text in enumerate(table.texts(index)):
        match = re.fullmatch(r"(\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(?:\.\d+)?)(Z|[-+][\d:]+)?", text)
        if not match:
            raise ValueError(
                f"{table.place(row)}: expected a date and time such as "
                f"2024-05-01T12:00:00.25, got {text!r:.60}."
            )
        dates.append(match[1])
    moments = np.array(dates, "datetime64[ns]")
    return (moments - moments[0]).astype(float) * 1e-9
