"""Numbers in columns, as all the loggers write them: found, read fast, and refused by line.

NumPy's parser reads the numbers. Only if it stumbles, or a line has more or fewer cells than the
others, are the lines looked at one by one, for a sentence that says which and why.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from driftlab.checks import FloatArray

from ._table_columns import TableColumns
from ._text_form import (
    COMMENTS,
    NUMBER,
    decoded,
    header,
    number_delimiter,
    refuse_cut,
    split_cells,
)
from ._time_stamps import seconds_since_first

_DATE = re.compile(r"(\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(?:\.\d+)?)(Z|[-+][\d:]+)?")


@dataclass(frozen=True, eq=False)
class TextTable(TableColumns):
    """The lines of a text file that hold numbers, and what its header calls the columns.

    Attributes
    ----------
    path : Path
        Where it was read.
    names, units : tuple of str
        Of the columns, without quotes; empty if the file has no header, or "" for a column.
    lines : list of str
        From the first with numbers to the last.
    first_line : int
        Number in the file of the first of them, counted from 1.
    delimiter : str or None
        Between cells; None are blanks.
    width : int
        Cells in a line.
    """

    path: Path
    names: tuple[str, ...]
    units: tuple[str, ...]
    lines: list[str]
    first_line: int
    delimiter: str | None
    width: int

    @property
    def title(self) -> str:
        """The file's name."""
        return self.path.name

    def numbers(self, columns: Sequence[int]) -> FloatArray:
        """Return columns, given by their indices, all of whose cells must be finite numbers."""
        rows: FloatArray | None = None
        fault = ""
        if {len(line.split(self.delimiter)) for line in self.lines if line} <= {self.width}:
            try:
                rows = np.loadtxt(
                    self.lines,
                    delimiter=self.delimiter,
                    usecols=columns,
                    comments=None,
                    ndmin=2,
                )
            except ValueError as error:
                fault = str(error)
        if rows is None or not np.isfinite(rows).all():
            self._refuse(columns, fault)
        assert rows is not None
        return rows

    def since_first(self, column: int, values: FloatArray) -> FloatArray:
        """Numbers (n,) of a column less the first, exact where they are whole."""
        if np.abs(values).max() > 2**53:  # where floats skip whole numbers
            with suppress(ValueError):  # of a point or an exponent
                whole = [int(text) for text in self.texts(column)]
                return np.array([each - whole[0] for each in whole], float)
        return values - values[0]

    def texts(self, column: int) -> list[str]:
        """Return a column, given by its index, as text."""
        return [self.cells(line)[column] for line in self.lines if line]

    def moments(self, column: int) -> FloatArray:
        """Return a column of dates and times of one time zone as seconds since the first."""
        dates = []
        for row, text in enumerate(self.texts(column)):
            match = _DATE.fullmatch(text)
            if not match:
                raise ValueError(
                    f"{self.place(row)}: expected a date and time such as "
                    f"2024-05-01T12:00:00.25, got {text!r:.60}."
                )
            dates.append(match[1])
        return seconds_since_first(np.array(dates, "datetime64[ns]"))

    def place(self, row: int) -> str:
        """Return the file's name and the line of a row, counted from 1 as in an editor."""
        line = [i for i, line in enumerate(self.lines) if line][row]
        return f"{self.path.name}, line {self.first_line + line}"

    def cells(self, line: str) -> list[str]:
        """Return the cells of a line."""
        return split_cells(line, self.delimiter)

    def _refuse(self, columns: Sequence[int], fault: str) -> None:
        """Say what is wrong with the first line that something is wrong with."""
        for number, line in enumerate(self.lines, self.first_line):
            if not line:
                continue
            cells = self.cells(line)
            where = f"{self.path.name}, line {number}: expected"
            if len(cells) != self.width:
                raise ValueError(
                    f"{where} {self.width} cells as in line {self.first_line}, got {len(cells)}: "
                    f"{line!r:.60}."
                )
            for column in columns:
                if not NUMBER.fullmatch(cells[column]) or "n" in cells[column].lower():
                    name = self.names[column] if any(self.names) else ""
                    got = repr(cells[column]) if cells[column] else "an empty cell"
                    raise ValueError(
                        f"{where} a number in column {name or column + 1}, got {got:.60}."
                    )
        raise ValueError(f"{self.path.name}: expected lines of numbers, got one: {fault}.")


def read_table(path: str | Path) -> TextTable:
    """Find the numbers in a text file: its header, its delimiter and its decimal sign.

    Cells are separated by commas, semicolons, tabs or blanks. Decimal commas, if the delimiter
    is not a comma, become points. Lines that begin with %, # or // are comments, and so is the
    rest of a line of numbers after % or #. A file without numbers, or cut off inside one, is
    refused.
    """
    path = Path(path)
    text = decoded(path.read_bytes())
    if not text.strip():
        raise ValueError(f"{path.name}: expected lines of numbers, got an empty file.")
    lines = [line.strip(" ") for line in text.split("\n")]
    while lines and not lines[-1].strip(",;\t "):
        lines.pop()
    start, delimiter = next(
        (
            (i, found or None)
            for i, line in enumerate(lines)
            if not line.startswith(COMMENTS) and (found := number_delimiter(line)) is not None
        ),
        (-1, None),
    )
    if start < 0:
        raise ValueError(f"{path.name}: expected lines of numbers, got none in {len(lines)} lines.")
    names, units = header(lines[:start], delimiter, len(split_cells(lines[start], delimiter)))
    body = "\n".join(lines[start:])
    if '"' in body:
        # In quotes a comma is decimal even where commas part the cells.
        body = re.sub(r'"([^"\n]*)"', lambda cell: cell[1].replace(",", "."), body)
    if delimiter != "," and "," in body:
        body = body.replace(",", ".")
    if any(mark in body for mark in COMMENTS):
        body = re.sub(r"(^//|[%#]).*", "", body, flags=re.M)
    lines = body.split("\n")
    width = len(lines[0].split(delimiter))
    if not text.endswith("\n"):
        refuse_cut(path, lines, start + len(lines), delimiter)
    return TextTable(path, names, units, lines, start + 1, delimiter, width=width)
