"""The form of a text file with columns: its code, its delimiter, and what its header says."""

from __future__ import annotations

import codecs
import re
from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path

from .units import is_unit

NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?|[-+]?(nan|inf(inity)?)", re.I)
"""A number as logs write it, or what some write where they have none."""
COMMENTS = ("%", "#", "//")
"""What begins a comment."""
FEW, MANY = 12, 20
"""Columns that a sentence can name all; lines from which their lengths tell something."""
_SEVERAL_NUMBERS = re.compile(rf"({NUMBER.pattern})(\s+({NUMBER.pattern}))+", re.I)


def decoded(content: bytes) -> str:
    """Return the text of a file, with one kind of line end.

    It is UTF-8 with or without a byte order mark, UTF-16 with one, or else Latin-1.
    """
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = content.decode("utf-16")
    else:
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:  # such as the degree sign of an old program
            text = content.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def number_delimiter(line: str) -> str | None:
    """Return the delimiter between the numbers of a line, "" for blanks; None if it has no numbers.

    Other cells of the line may be dates or labels, or empty.
    """
    for delimiter in (";", "\t", ",", ""):
        cells = split_cells(line, delimiter or None)
        if any(_SEVERAL_NUMBERS.fullmatch(cell) for cell in cells):
            continue  # blanks part the cells, and the commas are decimal
        numbers = sum(bool(NUMBER.fullmatch(cell)) for cell in cells)
        if numbers >= 2 and 2 * numbers > len(cells):
            return delimiter
    return None


def split_cells(line: str, delimiter: str | None) -> list[str]:
    """Return the cells of a line without quotes; a comma in quotes is part of its cell."""
    if '"' in line and delimiter == ",":
        return [cell.strip(' "') for cell in re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', line)]
    return [cell.strip(' "') for cell in line.split(delimiter)]


def names_like(wanted: str, names: Sequence[str]) -> str:
    """Return all of a few names of columns, or the most similar of many, to begin a sentence."""
    if not any(names):
        return ""
    if len(names) <= FEW:
        return f"{', '.join(names)}, or "
    nearest = get_close_matches(wanted, names, 3, 0.4) or names[:3]
    return f"one of {len(names)} names ({', '.join(nearest)}, ...) or "


def without_mark(line: str) -> str:
    """Return a line, or the name of its first column, without the mark of a comment."""
    return re.sub(r"^(%|#|//)+\s*", "", line)


def header(
    lines: list[str], delimiter: str | None, width: int
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return names and units of columns from the last one or two lines before the numbers.

    Both have `width` entries, "" where there is none. If no line has so many cells, there are
    no names.
    """
    units = ("",) * width
    for line in reversed([line for line in lines if line]):
        cells = tuple(split_cells(without_mark(line), delimiter))
        cells += ("",) * (width - len(cells) == 1)  # a delimiter after the last number
        if len(cells) != width:
            break
        if not any(units) and all(not cell or is_unit(cell.strip("()[]")) for cell in cells):
            units = tuple(cell.strip("()[]") for cell in cells)
            continue
        named = [re.fullmatch(r"(.*?)\s*[(\[]([^()\[\]]*)[)\]]", cell) for cell in cells]
        known = [match if match and is_unit(match[2]) else None for match in named]
        names = tuple(m[1] if m else cell for m, cell in zip(known, cells, strict=True))
        return names, units if any(units) else tuple(m[2] if m else "" for m in known)
    return ("",) * width if any(units) else (), units


def refuse_cut(path: Path, lines: list[str], number: int, delimiter: str | None) -> None:
    """Refuse a last line whose last cell is shorter than all others, perhaps a number cut off.

    Many programs leave out the last end of line, so that alone is no sign.
    """
    *sizes, last = (len(line.rsplit(delimiter, 1)[-1]) for line in lines if line)
    if len(sizes) >= MANY and last < min(sizes):
        raise ValueError(
            f"{path.name}, line {number}: expected a last cell of {min(sizes)} characters or "
            f"more, as in all other lines, or an end of line after it, got {lines[-1]!r:.200}: is "
            "the file cut off?"
        )
