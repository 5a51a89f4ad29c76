"""The list of a class, which platforms and spreadsheets write in many ways."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

from .plain_text import clean, spellings, squeezed
from .roster_columns import columns

DELIMITERS = "\t;,"
"""Of two that read equally well the first counts: commas stand in cells, too."""
EXCEL = re.compile(r'\s*"?sep=([,;\t])"?[,; \t]*(?:\r?\n|$)', re.I)
"""The line in which spreadsheets are told the delimiter."""


class Listed(NamedTuple):
    """A student on the list."""

    name: str
    ids: tuple[str, ...] = ()  # whatever else tells who it is, in the order of the columns

    def is_named(self, name: str) -> bool:
        """Whether this is the student's name, whichever of its words comes first."""
        return squeezed(name) in spellings(self.name)

    @property
    def numbers(self) -> set[str]:
        """The student's numbers and addresses, and the fronts of those, in small letters."""
        known = {part.casefold() for one in self.ids for part in (one, one.partition("@")[0])}
        return known - {""}

    def has(self, id_: str) -> bool:
        """Whether this is one of the student's numbers, or the front of an address."""
        return id_.casefold() in self.numbers


def read_roster(path: str | Path) -> list[Listed]:
    """Return the students on a list; ValueError if nobody is on it.

    It is a CSV file: commas, semicolons or tabs; UTF-8, UTF-16 or Latin-1. The first line may name
    the columns, as "name", "student", "first name" and "last name", "id", "email" and so on, or in
    German, French or Russian; else the first column has the names, and a second one numbers.
    """
    try:
        if Path(path).exists() and not Path(path).is_file():
            raise ValueError(f"roster: {str(path)!r} is not a file.")
        content = Path(path).read_bytes()
    except OSError as error:
        raise ValueError(
            f"roster: {str(path)!r} cannot be read ({error.strerror or error})."
        ) from None
    text = _decoded(content)
    try:
        table = _table(text)
    except csv.Error:
        raise ValueError(f"roster: {str(path)!r} is not a CSV file.") from None
    listed = _listed(table)
    if not listed:
        raise ValueError(f"roster: nobody is on the list {str(path)!r}.")
    return listed


def known(listed: Iterable[Listed]) -> Callable[[str], bool]:
    """Return what tells whether somebody of that name or number is on the list."""
    names = {spelling for one in listed for spelling in spellings(one.name)}
    numbers = {number for one in listed for number in one.numbers}
    return lambda name: squeezed(name) in names or name.casefold() in numbers


def once(listed: list[Listed]) -> tuple[list[Listed], list[str]]:
    """Return each student once, and sentences on who stood there more often."""
    kept: dict[tuple[str, ...], Listed] = {}
    twice: dict[str, None] = {}
    for one in listed:
        key = (squeezed(one.name) or one.name, *(part.casefold() for part in one.ids))
        if kept.setdefault(key, one) is not one:
            twice[kept[key].name] = None
    notes = [f"{name} stands on the list more than once, and has one row." for name in twice]
    return list(kept.values()), notes


def _decoded(content: bytes) -> str:
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _table(text: str) -> list[list[str]]:
    """Return the cells; of several delimiters the one with which the heading makes sense."""
    told = EXCEL.match(text)
    candidates, text = (told[1], text[told.end() :]) if told else (DELIMITERS, text)
    tables = [_cells(text, delimiter) for delimiter in candidates]
    return max(tables, key=_sense)


def _cells(text: str, delimiter: str) -> list[list[str]]:
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    table = [[clean(cell, 200) for cell in line] for line in lines]
    return [line for line in table if any(line)]


def _sense(table: list[list[str]]) -> tuple[int, int]:
    """How well a table reads: known headings, as many cells in each line as in the first."""
    if not table:
        return 0, 0
    width = len(table[0])
    even = sum(len(line) == width for line in table) if width > 1 else 0
    return sum(map(len, columns(table[0]))), even


def _listed(table: list[list[str]]) -> list[Listed]:
    if not table:
        return []
    names, ids = columns(table[0])
    if not names and not ids:
        return [_without_head(*line, "") for line in table if line[0]]
    listed = []
    for line in table[1:]:
        cells = dict(enumerate(line))
        numbers = tuple(filter(None, (cells.get(i, "") for i in ids)))
        name = " ".join(filter(None, (cells.get(i, "") for i in names)))
        # Canvas has a line for the points that can be had.
        if (name or numbers) and name.casefold() not in ("points possible", "student, test"):
            listed.append(Listed(name or numbers[0], numbers))
    return listed


def _without_head(first: str, second: str, *_: str) -> Listed:
    """A line of a list that does not name its columns."""
    is_name = second and not any(sign.isdigit() or sign == "@" for sign in second)
    if is_name and " " not in first:
        return Listed(f"{second} {first}")  # Lovelace, Ada
    return Listed(first, (second,) if second else ())
