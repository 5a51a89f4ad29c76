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

    Parameters
    ----------
    content : bytes
        UTF-8 with or without its mark, UTF-16 with it, or else Latin-1.

    Returns
    -------
    str

    Examples
    --------
    >>> decoded(b"wx [\\xb0/s]\\r\\n1\\r\\n")
    'wx [°/s]\\n1\\n'
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
    """Return what stands between the numbers of a line.

    Parameters
    ----------
    line : str
        Among its numbers there may be a date, a label, or nothing.

    Returns
    -------
    str or None
        Semicolon, tab, comma, or nothing at all for blanks; None if these are no numbers.

    Examples
    --------
    >>> number_delimiter("0,5;1,5"), number_delimiter("0,5 1,5"), number_delimiter("wx;wy")
    (';', '', None)
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
    """Return the cells of a line, without quotes.

    Parameters
    ----------
    line : str
        A comma in quotes is part of its cell.
    delimiter : str or None
        Between cells; None are blanks.

    Returns
    -------
    list of str

    Examples
    --------
    >>> split_cells('1, "2,5"', ",")
    ['1', '2,5']
    """
    if '"' in line and delimiter == ",":
        return [cell.strip(' "') for cell in re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', line)]
    return [cell.strip(' "') for cell in line.split(delimiter)]


def names_like(wanted: str, names: Sequence[str]) -> str:
    """Return names of columns for a sentence: all of few, of many the nearest.

    Parameters
    ----------
    wanted : str
        What was asked for and is not there.
    names : sequence of str
        Of all columns; empty if the file has no header.

    Returns
    -------
    str
        With an "or" at the end, unless it is empty.

    Examples
    --------
    >>> names_like("wz", ("wx", "wy"))
    'wx, wy, or '
    """
    if not any(names):
        return ""
    if len(names) <= FEW:
        return f"{', '.join(names)}, or "
    nearest = get_close_matches(wanted, names, 3, 0.4) or names[:3]
    return f"one of {len(names)} names ({', '.join(nearest)}, ...) or "


def without_mark(line: str) -> str:
    """Return a line, or the name of its first column, without the mark of a comment.

    Parameters
    ----------
    line : str

    Returns
    -------
    str

    Examples
    --------
    >>> without_mark("%time,x"), without_mark("// t")
    ('time,x', 't')
    """
    return re.sub(r"^(%|#|//)+\s*", "", line)


def header(
    lines: list[str], delimiter: str | None, width: int
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return names and units of columns, from the last one or two lines before the numbers.

    Parameters
    ----------
    lines : list of str
        All before the numbers.
    delimiter : str or None
        Between cells; None are blanks.
    width : int
        Cells in a line of numbers.

    Returns
    -------
    names, units : tuple of str
        Of all columns, "" where there is none; no names at all if no line has so many cells.

    Examples
    --------
    >>> header(["# log", "t [ms],wx"], ",", 2), header(["t,wx", "ms,deg/s"], ",", 2)
    ((('t', 'wx'), ('ms', '')), (('t', 'wx'), ('ms', 'deg/s')))
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
    """Refuse a last line whose last cell may be a part of a number.

    Many programs leave out the last end of line, so that alone is no sign.

    Parameters
    ----------
    path : Path
        Of the file, for the sentence.
    lines : list of str
        Those with numbers.
    number : int
        In the file of the last of them.
    delimiter : str or None
        Between cells; None are blanks.

    Raises
    ------
    ValueError
        If the last cell of the last line is shorter than that of any other of many lines.

    Examples
    --------
    >>> refuse_cut(  # doctest: +NORMALIZE_WHITESPACE
    ...     Path("log.csv"), ["1,0.25"] * 20 + ["1,0.2"], 21, ","
    ... )
    Traceback (most recent call last):
    ValueError: log.csv, line 21: expected a last cell of 4 characters or more, as in all other
    lines, or an end of line after it, got '1,0.2': is the file cut off?
    """
    *sizes, last = (len(line.rsplit(delimiter, 1)[-1]) for line in lines if line)
    if len(sizes) >= MANY and last < min(sizes):
        raise ValueError(
            f"{path.name}, line {number}: expected a last cell of {min(sizes)} characters or "
            f"more, as in all other lines, or an end of line after it, got {lines[-1]!r:.200}: is "
            "the file cut off?"
        )
