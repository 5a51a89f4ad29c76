"""The numbers behind a figure as CSV, with a header that says how the picture is drawn from them.

Whatever a panel with axes shows is looked for in the figure's table, in the units of the axes and
to the digits of a CSV, before the table is written; what is not there, or of a kind that is not
read, is a `MissingCurves`. So nothing is drawn that a reader of the CSV does not have, but for what
only guides the eye, and the header can say of each panel which columns make it:

    # panel 2, "drift": x is "turns", y is "error, arcmin"
    #   "exact": x = turns, y = exact_arcmin, where axis = along
    #   "largest possible": y = most_arcmin
    # panel 3: a drawing, without axes

A line through a whole panel is one value, in a column of its own. Of a panel of words both ways,
a figure's own tests say that its marks are those of the table.

`read_curves` draws from such a file alone; `pandas.read_csv(path, comment="#")` has its columns.
"""

from __future__ import annotations

import re
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .csv_table import Words, as_words as as_words, read_table, write_table as write_table
from .curve_rows import RANK, Finder, Rows, taken
from .drawn import Curve, Field, Unread, nature, panels, shown


class MissingCurves(ValueError):
    """Something is drawn that is not in the figure's table."""


def header(figure: Figure, table: Words) -> list[str]:
    """Return lines that say which columns make which curve of which panel.

    MissingCurves is raised if something is drawn that is not in the table, or that cannot be
    compared with it.
    """
    for name in table:
        _check_word(name)
        if name in ("", RANK):
            raise ValueError(f"Columns: expected names of their own, got {name!r}.")
    finder = Finder(table)
    drawn = list(shown(figure))
    lines: list[str] = []
    missing = [f"{_place(each.panel)}{each.what}" for each in drawn if isinstance(each, Unread)]
    for number, axes in enumerate(panels(figure), 1):
        own = []
        for each in drawn:
            if each.panel != number or isinstance(each, Unread):
                continue
            if isinstance(each, Curve):
                rows = finder.rows(each, axes)
                line = None if rows is None else curve_line(each.name, rows)
            else:
                names = finder.field(each)
                line = names and "  contours: x = {}, y = {}, value = {}".format(*names)
            if line:
                own.append(line)
            else:
                missing.append(_place(number) + _described(each))
        says = nature(axes) or _axis_words(axes)
        lines.append(f"panel {number}{_title(axes)}: {says}".rstrip())
        lines += dict.fromkeys(own)  # several curves may be made of the same rows
    if missing:
        raise MissingCurves(
            f"The table does not hold what is drawn: {'; '.join(missing)}. "
            "Give the table a column of it, or label it GUIDE if it only guides the eye."
        )
    return lines


def curve_line(name: str, rows: Rows) -> str:
    """Return the line of a header that says where a curve is, as `read_curves` reads it."""
    line = f'  "{_one_line(name)}": {rows}'
    for word in (rows.x, rows.y, *rows.where, *rows.where.values()):
        _check_word(word)
    if any(" = " in key for key in rows.where):
        raise ValueError(f"Columns: expected names without ' = ' where they are keys, got {line}.")
    return line


def _check_word(word: str) -> None:
    """Refuse what a header would take for its own words, or a reader of the CSV for a comment."""
    if re.search(r'[#"\r\n]|, (x|y|where|every)\b', word) or word != word.strip():
        raise ValueError(
            "Names and keys of a table: expected no number sign, quotation mark, line break, outer "
            f"blank, nor any of x, y, where and every after a comma, got {word!r}."
        )


def _read_line(line: str) -> tuple[str, Rows] | None:
    curve = re.fullmatch(r'  "(.*)": ([^"]*)', line)
    return (curve[1], Rows.read(curve[2])) if curve else None


def read_curves(path: Path) -> list[Curve]:
    """Return what a figure shows, from its CSV alone."""
    comments, table = read_table(path)
    found, number = [], 0
    for line in comments:
        if panel := re.match(r"panel (\d+)", line):
            number = int(panel[1])
        elif curve := _read_line(line):
            found.append(Curve(number, curve[0], *taken(table, curve[1])))
    return found


def _title(axes: Axes) -> str:
    title = _one_line(axes.get_title("left") or axes.get_title())
    return f', "{title}"' if title else ""


def _axis_words(axes: Axes) -> str:
    words = []
    for axis in "xy":
        shared = getattr(axes, f"get_shared_{axis}_axes")().get_siblings(axes)
        labels = [getattr(each, f"get_{axis}label")() for each in (axes, *shared)]
        words += [f'{axis} is "{_one_line(label)}"' for label in labels if label][:1]
    return ", ".join(words)


def _one_line(text: str) -> str:
    return " ".join(text.split())


def _place(panel: int) -> str:
    return f"panel {panel}, " if panel else ""


def _described(curve: Curve | Field) -> str:
    if isinstance(curve, Field):
        return "contours"
    ends = [
        f"{axis} from {values[0]:.6g} to {values[-1]:.6g}"
        for axis, values in (("x", curve.x), ("y", curve.y))
        if values.size
    ]
    name, count = curve.name or "a curve without a name", max(curve.x.size, curve.y.size)
    if count == 1:
        ends = [f"{axis} = {v[0]:.6g}" for axis, v in (("x", curve.x), ("y", curve.y)) if v.size]
        return f"{curve.name or 'a value without a name'} at {', '.join(ends)}"
    return f"{name} of {count} points, {', '.join(ends)}"
