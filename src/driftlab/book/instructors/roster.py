"""The list of a class, which platforms and spreadsheets write in many ways."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import NamedTuple

from .plain_text import clean, spellings, squeezed

FULL = ("name", "student", "full name", "fullname", "student name")
FIRST = ("first name", "firstname", "given name")
LAST = ("last name", "lastname", "surname", "family name")
IDS = (
    "id", "id number", "student id", "student number", "number", "sis user id", "sis login id",
    "username", "login", "email", "email address",
)  # fmt: skip


class Listed(NamedTuple):
    """A student on the list.

    Attributes
    ----------
    name : str
    ids : tuple of str
        Whatever else tells who it is, in the order of the columns.
    """

    name: str
    ids: tuple[str, ...] = ()

    def is_named(self, name: str) -> bool:
        """Whether this is the student's name, whichever of its words comes first."""
        return squeezed(name) in spellings(self.name)

    def has(self, id_: str) -> bool:
        """Whether this is one of the student's numbers, or the front of an address."""
        known = {part.casefold() for one in self.ids for part in (one, one.partition("@")[0])}
        return bool(id_) and id_.casefold() in known


def read_roster(path: str | Path) -> list[Listed]:
    """Return the students on a list.

    Parameters
    ----------
    path : path
        A CSV file: commas, semicolons or tabs; UTF-8, UTF-16 or Latin-1. The first line may name
        the columns, as "name", "student", "first name" and "last name", "id", "email" and so on;
        else the first column has the names, and a second one numbers.

    Raises
    ------
    ValueError
        If it cannot be read, or nobody is on it.
    """
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise ValueError(
            f"roster: {str(path)!r} cannot be read ({error.strerror or error})."
        ) from None
    text = _decoded(content)
    head = text.splitlines()[0] if text.strip() else ""
    delimiter = max(",;\t", key=head.count)
    try:
        lines = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter))
    except csv.Error:
        raise ValueError(f"roster: {str(path)!r} is not a CSV file.") from None
    table = [[clean(cell, 200) for cell in line] for line in lines]
    table = [line for line in table if any(line)]
    listed = _listed(table)
    if not listed:
        raise ValueError(f"roster: nobody is on the list {str(path)!r}.")
    return listed


def _decoded(content: bytes) -> str:
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _listed(table: list[list[str]]) -> list[Listed]:
    if not table:
        return []
    head = [cell.casefold() for cell in table[0]]
    full, first, last = (
        next((i for i, cell in enumerate(head) if cell in names), None)
        for names in (FULL, FIRST, LAST)
    )
    ids = [i for i, cell in enumerate(head) if cell in IDS]
    if full is None and first is None and last is None and not ids:
        return [_without_head(*line, "") for line in table if line[0]]
    names = [full] if full is not None else [i for i in (first, last) if i is not None]
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
