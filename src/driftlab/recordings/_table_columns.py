"""A table of numbers, wherever it came from: columns by name or number, rows with a place."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Sequence

from driftlab.checks import FloatArray, shown

from ._text_form import names_like, without_mark


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
