"""The form of a text file with columns: its code, its delimiter, and what its header says."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable, Sequence
from difflib import get_close_matches

from ._units import is_unit

NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?|[-+]?(nan|inf(inity)?)", re.I)
"""A number as logs write it, or what some write where they have none."""
COMMENTS = ("%", "#", "//")
"""What begins a comment."""
BLANK = ",;\t \n"
"""Characters of lines that hold nothing."""
FEW, MANY = 12, 20
"""Columns that a sentence can name all; lines from which their lengths tell something."""
_SEVERAL_NUMBERS = re.compile(rf"({NUMBER.pattern})(\s+({NUMBER.pattern}))+", re.I)


def code_of(beginning: bytes) -> str:
    """Return the code of a text by its first lines.

    It is UTF-8 with or without a byte order mark, UTF-16 with one, or else Latin-1.
    """
    if beginning.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    try:
        beginning.decode()
    except UnicodeDecodeError:  # such as the degree sign of an old program
        return "latin-1"
    return "utf-8-sig"


def plain(lines: str, delimiter: str | None) -> str:
    """Return lines of numbers with decimal points, without quotes and comments."""
    if '"' in lines:
        # In quotes a comma is decimal even where commas part the cells.
        lines = re.sub(r'"([^"\n]*)"', lambda cell: cell[1].replace(",", "."), lines)
    if delimiter != ",":
        lines = lines.replace(",", ".")
    if any(mark in lines for mark in COMMENTS):
        lines = re.sub(r"(^ *//|[%#]).*", "", lines, flags=re.M)
    return lines


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


def refuse_cut(name: str, lines: Iterable[tuple[int, str]], delimiter: str | None) -> None:
    """Refuse a last line whose last cell is shorter than all others, perhaps a number cut off.

    Many programs leave out the last end of line, so that alone is no sign.
    """
    line, sizes = (0, ""), []
    for line in lines:
        sizes.append(len(line[1].rsplit(delimiter, 1)[-1]))
    *others, last = sizes
    if len(others) >= MANY and last < min(others):
        raise ValueError(
            f"{name}, line {line[0]}: expected a last cell of {min(others)} characters or more, "
            f"as in all other lines, or an end of line after it, got {line[1]!r:.200}: is the file "
            "cut off?"
        )
