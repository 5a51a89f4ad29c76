"""The numbers behind a figure as CSV, with a header that says how the picture is drawn from them.

Every curve that a figure shows is looked for in its table, in the units of its axes, before the
table is written; one that is not there is a `MissingCurves`. So nothing is drawn that a reader of
the CSV does not have, and the header can say of each panel which columns make it:

    # panel 2, "drift": x is "turns", y is "error, arcmin"
    #   "exact": x = turns, y = exact_arcmin, where axis = along

`read_curves` draws from such a file alone; `pandas.read_csv(path, comment="#")` has its columns.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .curve_rows import Finder, Rows, Words, taken
from .drawn import Curve, curves, fields, panels


class MissingCurves(ValueError):
    """Something is drawn that is not in the figure's table."""


def as_words(columns: Mapping[str, Any]) -> dict[str, list[str]]:
    """Return columns as a CSV holds them: numbers to twelve digits, nothing for NaN.

    Columns may be of different lengths; the shorter have nothing below their values.
    """
    rows = max(len(column) for column in columns.values())
    return {
        name: [*map(_word, column), *[""] * (rows - len(column))]
        for name, column in columns.items()
    }


def _word(value: Any) -> str:
    if isinstance(value, str):
        return value
    return "" if value != value else f"{value:.12g}"


def header(figure: Figure, table: Words) -> list[str]:
    """Return lines that say which columns make which curve of which panel.

    Raises
    ------
    MissingCurves
        If something is drawn that is not in the table.
    """
    finder = Finder(table)
    lines: list[str] = []
    missing = []
    drawn, contours = curves(figure), fields(figure)
    for number, axes in enumerate(panels(figure), 1):
        own = []
        for curve in (curve for curve in drawn if curve.panel == number):
            rows = finder.rows(curve, axes)
            if rows is None:
                missing.append(f"panel {number}, {_described(curve)}")
            else:
                own.append(f'  "{_one_line(curve.name)}": {rows}')
        for field in (field for field in contours if field.panel == number):
            names = finder.field(field)
            if names is None:
                missing.append(f"panel {number}, contours")
            else:
                own.append("  contours: x = {}, y = {}, value = {}".format(*names))
        lines.append(f"panel {number}{_title(axes)}: {_axis_words(axes)}".rstrip())
        lines += dict.fromkeys(own)  # several curves may be made of the same rows
    if missing:
        raise MissingCurves(f"The table does not hold what is drawn: {'; '.join(missing)}.")
    return lines


def write_table(path: Path, table: Words, comments: list[str]) -> None:
    """Write comments, each after a #, and the columns below them."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {line}".rstrip() + "\n" for line in comments)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table)
        writer.writerows(zip(*table.values(), strict=True))


def read_table(path: Path) -> tuple[list[str], dict[str, list[str]]]:
    """Return the comments and the columns, as words, of a file that `write_table` wrote."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    count = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    titles, *rows = csv.reader(lines[count:])
    columns = {
        title: list(column) for title, column in zip(titles, zip(*rows, strict=True), strict=True)
    }
    return [line[2:].rstrip("\n") for line in lines[:count]], columns


def read_curves(path: Path) -> list[Curve]:
    """Return what a figure shows, from its CSV alone."""
    comments, table = read_table(path)
    found, number = [], 0
    for line in comments:
        if panel := re.match(r"panel (\d+)", line):
            number = int(panel[1])
        elif curve := re.fullmatch(r"  \"(.*)\": (.*)", line):
            found.append(Curve(number, curve[1], *taken(table, Rows.read(curve[2]))))
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


def _described(curve: Curve) -> str:
    ends = [
        f"{axis} from {values[0]:.6g} to {values[-1]:.6g}"
        for axis, values in (("x", curve.x), ("y", curve.y))
        if values.size
    ]
    name, count = curve.name or "a curve without a name", max(curve.x.size, curve.y.size)
    return f"{name} of {count} points, {', '.join(ends)}"
