"""Each figure can be drawn from its CSV alone, and with other parameters."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from matplotlib.figure import Figure

import driftlab
from driftlab.book import figures
from driftlab.book.machinery.figure.csv_table import numbers, read_table
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import GUIDE, nature, panels
from driftlab.book.machinery.figure.publish import PublishedFigure, call_of
from driftlab.book.machinery.figure.written import imports
from driftlab.checks import FloatArray
from figure_variations import VARIATIONS
from published import NAMES, of_figure, published

PUBLISHED = Path(__file__).parents[2] / "figures"
WITH_NUMBERS = [name for name in NAMES if figures.figure_definitions(name[:2])[name].columns]


class Curve(NamedTuple):
    """A curve as a reader takes it from a CSV; empty along an axis without a column."""

    panel: int
    label: str
    x: FloatArray
    y: FloatArray


def read_curves(path: Path) -> list[Curve]:
    """Return the curves that the head of a CSV describes, and nothing else knows."""
    comments, table = read_table(path)
    found, panel = [], 0
    for line in comments:
        if number := re.match(r"panel (\d+)", line):
            panel = int(number[1])
        elif curve := re.fullmatch(r'  "(.*)": (.*)', line):
            found.append(Curve(panel, curve[1], *points(curve[2], table)))
    return found


def points(described: str, table: Mapping[str, list[str]]) -> tuple[FloatArray, FloatArray]:
    """Abscissa and ordinate of ``x = time_s, y = -error_deg, where axis = x, every 3 rows ...``."""
    parts = re.split(r", (?=x = |y = |where |every \d)", described)
    pairs = [part.removeprefix("where ").split(" = ", 1) for part in parts if " = " in part]
    names = {name: word for name, word in pairs if name in "xy"}
    where = [(name, word) for name, word in pairs if name not in "xy"]
    chosen = [all(table[name][i] == word for name, word in where) for i in range(len_of(table))]
    thin = re.search(r"every (\d+) rows", parts[-1])
    x, y = (
        column(table, names[axis])[chosen] if names.get(axis, RANK) != RANK else np.empty(0)
        for axis in "xy"
    )
    if names.get("y") == RANK:
        x = np.sort(x[np.isfinite(x)])
        return x, np.arange(1, len(x) + 1) / len(x)
    there = np.isfinite(x if x.size else y)
    every = slice(None, None, int(thin[1]) if thin else 1)
    return (x[there][every] if x.size else x), (y[there][every] if y.size else y)


RANK = "rank / number"


def len_of(table: Mapping[str, list[str]]) -> int:
    return len(next(iter(table.values())))


def column(table: Mapping[str, list[str]], name: str) -> FloatArray:
    """A column of numbers, or its mirror image."""
    values = numbers(table[name if name in table else name.removeprefix("-")])
    assert values is not None, name
    return values if name in table else -values


@published(*WITH_NUMBERS)
def test_a_figure_can_be_drawn_from_its_csv_alone(figure: PublishedFigure) -> None:
    """Every line that is drawn; other kinds in machinery/test_drawing.py."""
    if not isinstance(figure.on_screen, Figure):
        return  # a scene: it plays, and its readouts are the table
    if isinstance(figure.data, DataTable):
        assert not [line for line in figure.data.notes() if line.endswith(": ")]  # all say what
    read = read_curves(PUBLISHED / f"{figure.definition.name}.csv")
    for number, axes in enumerate(panels(figure.on_screen), 1):
        for line in axes.lines if not nature(axes) else []:
            x, y = (np.asarray(values, float) for values in line.get_data())
            if line.get_label() == GUIDE or not len(x) or not line.get_visible():
                continue
            through = len(x) == 2 and (np.ptp(x) == 0 or np.ptp(y) == 0)
            panel = [each for each in read if each.panel == number]
            largest = [max(map(largest_number, each[2:])) for each in panel]
            assert any(
                same(x, each.x, max(largest), through) and same(y, each.y, max(largest), through)
                for each in panel
            ), (number, line.get_label())


def same(drawn: FloatArray, read: FloatArray, largest: float, through: bool) -> bool:
    """Whether two coordinates are the same; some columns are rounded, to the fifth digit.

    What is below 1e-12, of one or of the largest number of its panel, is rounding, and on a
    logarithmic scale a gap stands for zero. A line through the whole panel is one value.
    """
    if not read.size:
        return True  # the axis counts words, or the line runs along it
    if through and len(read) == 1:
        drawn = drawn[:1]
    drawn = drawn[np.isfinite(drawn)]
    read = read[np.isfinite(read)]
    residue = 1e-12 * max(1.0, largest)
    if len(drawn) != len(read):
        drawn, read = (values[np.abs(values) > residue] for values in (drawn, read))
    least = max(residue, 1e-5 * largest_number(read))
    return len(drawn) == len(read) and np.allclose(drawn, read, rtol=0, atol=least)


def largest_number(values: FloatArray) -> float:
    """The largest size of the finite ones."""
    return float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))


def test_every_figure_takes_parameters_or_is_a_drawing() -> None:
    for name in NAMES:
        definition = figures.figure_definitions(name[:2])[name]
        if definition.columns and not definition.recordings:
            assert definition.parameters, name
        assert bool(definition.parameters) == (name in VARIATIONS), name


@pytest.mark.parametrize("name", [of_figure(name) for name in VARIATIONS])
def test_a_figure_is_drawn_with_other_parameters(name: str, tmp_path: Path) -> None:
    """On a screen and as numbers, and what is drawn is in them."""
    if missing := figures.not_at_hand(figures.figure_definitions(name[:2])[name]):
        pytest.skip(missing)
    definition = figures.figure_definitions(name[:2])[name]
    asked = definition.parameters | VARIATIONS[name]
    call, page = call_of(definition, asked), {"driftlab": driftlab}
    exec("\n".join(imports(VARIATIONS[name])), page)
    figure = eval(call, page)  # as a reader who has the line and the imports above it
    assert figure.call == call
    assert all(f"{parameter}=" in call for parameter in VARIATIONS[name])
    if isinstance(figure.on_screen, Figure):
        figure.on_screen.draw_without_rendering()
    if figure.definition.columns:
        path = figure.save(tmp_path / "numbers.csv")
        assert read_table(path)[1] != read_table(PUBLISHED / f"{name}.csv")[1]
