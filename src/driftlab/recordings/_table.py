"""A table of columns, wherever it came from, and the recording that a layout makes of it."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from driftlab.checks import FloatArray, shown

from ._text_form import names_like, without_mark
from ._time_stamps import spacing_of_stamps
from ._units import Unit, accelerometer_unit, gyro_unit, spelled, time_unit
from .guards import _without_problems
from .layout import Layout
from .recording import Recording

ANY_GAP = 1e12
"""In usual steps."""


class TableColumns(ABC):
    """A table whose columns may have names and units.

    Attributes
    ----------
    names, units : tuple of str
        Of the columns; empty if there are none, or "" for a column. An index comes last.
    width : int
        How many columns there are to be counted, without an index.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    width: int

    @property
    @abstractmethod
    def title(self) -> str:
        """What the table is called in sentences."""

    @abstractmethod
    def numbers(self, columns: Sequence[int]) -> FloatArray:
        """Columns (n, k), by their places counted from 0, all finite numbers, or a sentence."""

    @abstractmethod
    def moments(self, column: int) -> FloatArray:
        """Dates and times of a column, (n,), s since the first, or a sentence."""

    def since_first(self, column: int, values: FloatArray) -> FloatArray:
        """Numbers (n,) of a column less the first of them; `values` are these numbers as floats."""
        return values - values[0]

    @abstractmethod
    def place(self, row: int) -> str:
        """Where a row stands, counted from 0, for a sentence."""

    def column(self, wanted: str | int, argument: str = "columns") -> tuple[int, int]:
        """Return the index of a column, counted from 0, and its sign, 1 or -1.

        `wanted` is its name or its number, counted from 1; a minus before either changes
        the sign. A column that is missing or ambiguous is refused, also if digits are the
        name of one column and the number of another.
        """
        text = str(wanted).strip()
        for name, sign in ((text, 1), (without_mark(text), 1), (text[1:].strip(), -1)):
            if sign < 0 and not text.startswith("-"):
                break
            places = [i for i, one in enumerate(self.names) if one == name] or [
                i for i, one in enumerate(self.names) if one.lower() == name.lower()
            ]
            if len(places) > 1:
                raise ValueError(
                    f"{argument}: expected one column {name!r} in {self.title}, got "
                    f"{len(places)}: say it by number."
                )
            number = int(name) - 1 if re.fullmatch(r"\d+", name) else -1
            counted = 0 <= number < self.width
            if places and counted and places[0] != number:
                raise ValueError(
                    f"{argument}: expected a name or a number that mean one column of "
                    f"{self.title}, got {shown(wanted)}, which names column {places[0] + 1} and "
                    "counts another: give the columns names that are no numbers."
                )
            if places or counted:
                return places[0] if places else number, sign
        raise ValueError(
            f"{argument}: expected {names_like(text, self.names)}a number from 1 to {self.width} "
            f"for {self.title}, got {shown(wanted)}."
        )


def record_of_table(table: TableColumns, layout: Layout, name: str) -> Recording:
    """Recording of the columns of a table that a layout names; `name` if the layout has none."""
    places = {
        triad: [table.column(one) for one in wanted] for triad, wanted in layout.triads.items()
    }
    scales = _scales(table, places, layout.units)
    stamp, size = _stamp_column(table, layout)
    indices = [index for columns in places.values() for index, _ in columns]
    numbers = table.numbers(indices if size is None else [*indices, stamp])
    triads = []
    for i, (columns, scale) in enumerate(zip(places.values(), scales, strict=True)):
        rows = np.empty((len(numbers), 3))
        for axis, (_, sign) in enumerate(columns):
            moved = numbers[:, 3 * i + axis] - layout.zeros[i]
            np.multiply(moved, scale.size * sign, out=rows[:, axis])
        triads.append(rows)
    # First the difference: of 1.7e18 ns, say, little is left in s.
    since = None if size is None else size * table.since_first(stamp, numbers[:, -1])
    del numbers  # a long log has no room for both
    longest = ANY_GAP if "gap" in layout.allow else layout.longest_gap
    times = None
    if layout.time is None:
        spacing = float(layout.interval or 1 / (layout.rate or 1))
    else:
        since = table.moments(stamp) if since is None else since
        spacing, times = spacing_of_stamps(since, longest, table.place)
    recording = Recording(
        gyro=triads[0],
        accelerometer=triads[1] if len(triads) > 1 else None,
        interval=spacing,
        kind=scales[0].kind,
        times=times,
        axes=layout.axes,
        latitude=layout.latitude,
        gravity=layout.gravity,
        name=layout.name or name,
        source=layout.source,
        licence=layout.licence,
        longest_gap=longest,
    )
    return _without_problems(recording, layout.allow)


def _scales(
    table: TableColumns, places: dict[str, list[tuple[int, int]]], units: Sequence[str] | None
) -> list[Unit]:
    """Units of the triads, as told or as the header has them."""
    told: Sequence[str | None] = units or [None] * len(places)
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
    if len({scale.kind for scale in scales}) > 1:
        words = {"rates": "rates", "increments": "increments over each interval"}
        raise ValueError(
            "units: expected rates with specific force, or increments of angle with those of "
            f"velocity, got {words[scales[0].kind]} of the gyros with "
            f"{words[scales[1].kind]} of the accelerometers; read the triads one by one."
        )
    return scales


def _stamp_column(table: TableColumns, layout: Layout) -> tuple[int, float | None]:
    """Index of the column of time stamps and size of its unit, None if they are no numbers."""
    if layout.time is None:
        if layout.interval is None and layout.rate is None:
            raise layout.not_one_clock()
        return -1, None
    column, unit = layout.stamps
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
