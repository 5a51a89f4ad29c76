"""From a table of columns to a recording: what each column is, its unit, the time, guards."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from driftlab.checks import checked_text, finite_array, positive_number, shown, some_of

from ._table_columns import TableColumns
from ._time_stamps import checked_longest_gap, spacing_of_stamps
from ._unit_spellings import spelled
from .guards import RULES, without_doubts
from .recording import Recording
from .units import Unit, accelerometer_unit, gyro_unit, time_unit

Columns = Sequence[str | int]
Time = str | int | tuple[str | int, str]
ANY_GAP = 1e12
"""In usual steps."""


def record_of_table(
    table: TableColumns,
    *,
    gyro: Columns,
    accelerometer: Columns | None,
    units: str | Sequence[str] | None,
    zeros: Sequence[float],
    time: Time | None,
    interval: float | None,
    rate: float | None,
    longest_gap: float,
    axes: str,
    latitude: float | None,
    gravity: float | None,
    name: str,
    source: str,
    licence: str,
    allow: Sequence[str],
) -> Recording:
    """Recording of some columns of a table; arguments as of `csv_reader.read_csv`."""
    columns = {"gyro": gyro} | ({} if accelerometer is None else {"accelerometer": accelerometer})
    places = {triad: _places(table, wanted, triad) for triad, wanted in columns.items()}
    scales = _scales(table, places, units)
    offsets = finite_array(zeros, "zeros", 2)
    if offsets.ndim > 1:
        raise ValueError(f"zeros: expected shape (2,), got shape {offsets.shape}.")
    stamp, size = _stamp_column(table, time, interval, rate)
    indices = [index for triad in places.values() for index, _ in triad]
    numbers = table.numbers(indices if size is None else [*indices, stamp])
    triads = []
    for i, (triad, scale) in enumerate(zip(places.values(), scales, strict=True)):
        signs = np.array([sign for _, sign in triad])
        triads.append(scale.size * signs * (numbers[:, 3 * i : 3 * i + 3] - offsets[i]))
    longest = (
        ANY_GAP if "gap" in some_of(allow, RULES, "allow") else checked_longest_gap(longest_gap)
    )
    times = None
    if time is None:
        spacing = float(interval or 1 / (rate or 1))
    else:
        # First the difference: of 1.7e18 ns, say, little is left in s.
        since = (
            table.moments(stamp)
            if size is None
            else size * table.since_first(stamp, numbers[:, -1])
        )
        spacing, times = spacing_of_stamps(since, longest, table.place)
    recording = Recording(
        gyro=triads[0],
        accelerometer=triads[1] if len(triads) > 1 else None,
        interval=spacing,
        kind=scales[0].kind,
        times=times,
        axes=axes,
        latitude=latitude,
        gravity=gravity,
        name=name,
        source=source,
        licence=licence,
        longest_gap=longest,
    )
    return without_doubts(recording, allow)


def checked_kind(scales: Sequence[Unit]) -> None:
    """Refuse rates of one triad with increments of the other."""
    if len({scale.kind for scale in scales}) > 1:
        words = {"rates": "rates", "increments": "increments over each interval"}
        raise ValueError(
            "units: expected rates with specific force, or increments of angle with those of "
            f"velocity, got {words[scales[0].kind]} of the gyros with "
            f"{words[scales[1].kind]} of the accelerometers; read the triads one by one."
        )


def _places(table: TableColumns, wanted: Columns, triad: str) -> list[tuple[int, int]]:
    """Indices and signs of the three columns of a triad."""
    if not isinstance(wanted, tuple | list) or len(wanted) != 3:
        raise ValueError(f"{triad}: expected three columns, got {shown(wanted)}.")
    return [table.column(one) for one in wanted]


def _scales(
    table: TableColumns,
    places: dict[str, list[tuple[int, int]]],
    units: str | Sequence[str] | None,
) -> list[Unit]:
    """Units of the triads, as told or as the header has them."""
    told: list[str | None] = [None] * len(places)
    if units is not None:
        several = units if isinstance(units, tuple | list) else [units]
        told = [checked_text(unit, "units") for unit in several]
    if len(told) != len(places):
        raise ValueError(
            f"units: expected one for each of {', '.join(places)}, got {shown(units)}."
        )
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
                f"units: expected {known} for {triad}, as the header of {table.title} has it, "
                f"got {shown(unit)}."
            )
        scales.append(meaning(unit))
    checked_kind(scales)
    return scales


def _stamp_column(
    table: TableColumns,
    time: Time | None,
    interval: float | None,
    rate: float | None,
) -> tuple[int, float | None]:
    """Index of the column of time stamps and size of its unit, None if they are no numbers."""
    if sum(value is not None for value in (time, interval, rate)) != 1:
        raise ValueError(
            "time, interval, rate: expected one of them, "
            f"got {shown(time)}, {shown(interval)} and {shown(rate)}."
        )
    if time is None:
        positive_number(interval or rate or 0, "rate" if interval is None else "interval")
        return -1, None
    column, unit = time if type(time) is tuple and len(time) == 2 else (time, "")
    if not isinstance(column, str | int) or not isinstance(unit, str):
        raise ValueError(
            f"time: expected the name or number of a column, or it and its unit, got {shown(time)}."
        )
    index, _ = table.column(column, "time")
    known = table.units[index] if table.units else ""
    if unit and known and spelled(unit) != spelled(known):
        raise ValueError(
            f"time: expected {known} for column {column!r}, as {table.title} has it, "
            f"got {shown(unit)}."
        )
    unit = unit or known
    if not unit:
        raise ValueError(
            f"time: expected a unit beside column {column!r} (s, ms, us, ns, or iso for dates and "
            "times), because the header does not tell it, got none."
        )
    return index, None if unit == "iso" else time_unit(unit)
