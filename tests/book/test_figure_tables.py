"""Each figure can be drawn from its CSV alone, and the CSV says of what parameters it is."""

import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from driftlab.book import figures
from driftlab.book.machinery.curve_rows import Rows, numbers
from driftlab.book.machinery.drawn import Curve, curves, fields, panels
from driftlab.book.machinery.figure_table import (
    MissingCurves,
    as_words,
    header,
    read_curves,
    read_table,
    write_table,
)
from driftlab.book.machinery.picture import GUIDE, filled_contours
from driftlab.book.machinery.publish import PublishedFigure
from driftlab.book.machinery.sheet import COLUMN, Sheet
from figure_variations import VARIATIONS
from published import NAMES, of_figure, published

PUBLISHED = Path(__file__).parents[2] / "figures"
WITH_NUMBERS = [name for name in NAMES if figures.figure_definitions(name[:2])[name].columns]


@published(*WITH_NUMBERS)
def test_a_figure_can_be_drawn_from_its_csv_alone(figure: PublishedFigure) -> None:
    """Every curve, point and bar that is drawn, and the contours."""
    if not isinstance(figure.on_screen, Figure):
        return  # a scene: it plays, and its readouts are the table
    path = PUBLISHED / f"{figure.definition.name}.csv"
    again = as_drawn(read_curves(path))
    for (number, name), of_one_name in as_drawn(curves(figure.on_screen)).items():
        axes = panels(figure.on_screen)[number - 1]
        found = again[number, name]
        for curve in of_one_name:
            assert any(same_to_the_eye(curve, other, axes) for other in found), (number, name)
    comments, table = read_table(path)
    drawn = [line for line in comments if line.startswith("  contours: ")]
    shown = fields(figure.on_screen)
    assert len(drawn) == len(shown)
    for line, field in zip(drawn, shown, strict=True):
        for name, values in zip(re.findall(r" = ([^,]+)", line), field[1:], strict=True):
            column = numbers(table[name])
            least = 1e-9 * np.abs(values).max()
            np.testing.assert_allclose(column[np.isfinite(column)], values, 1e-9, least)


def as_drawn(shown: list[Curve]) -> dict[tuple[int, str], list[Curve]]:
    """Curves by panel and name: several may have one name, or none."""
    found: dict[tuple[int, str], list[Curve]] = {}
    for curve in shown:
        found.setdefault((curve.panel, " ".join(curve.name.split())), []).append(curve)
    return found


def same_to_the_eye(curve: Curve, other: Curve, axes: object) -> bool:
    """Whether two curves differ by less than a thousandth of their panel, on its own scale."""
    for direction, one, two in (("x", curve.x, other.x), ("y", curve.y, other.y)):
        if one.shape != two.shape:
            return False
        if one.size:
            zeros = np.zeros(one.size)
            places = (
                np.column_stack([values, zeros] if direction == "x" else [zeros, values])
                for values in (np.nan_to_num(one, nan=-1.0), np.nan_to_num(two, nan=-1.0))
            )
            size = axes.bbox.width if direction == "x" else axes.bbox.height
            index = "xy".index(direction)
            one, two = (axes.transData.transform(each)[:, index] for each in places)
            if not np.allclose(one, two, atol=size / 1000):
                return False
    return True


@published(*WITH_NUMBERS)
def test_the_csv_names_its_parameters_its_call_and_the_version(figure: PublishedFigure) -> None:
    comments, _ = read_table(PUBLISHED / f"{figure.definition.name}.csv")
    if missing := figures.not_at_hand(figure.definition):
        pytest.skip(missing)
    computed = figure.comments(as_words(figure.table()))
    version = r"driftlab \d+\.\d+\.\d+"
    assert re.search(version, comments[1])
    assert f"driftlab.figure('{figure.definition.name}')" in comments[1]
    plain = [
        [re.sub(version, "driftlab", line).rstrip() for line in each]
        for each in (comments, computed)
    ]
    assert plain[0] == plain[1]


def test_every_figure_takes_parameters_or_is_a_drawing() -> None:
    for name in NAMES:
        definition = figures.figure_definitions(name[:2])[name]
        if definition.columns and not definition.recordings:
            assert definition.parameters, name
        assert bool(definition.parameters) == (name in VARIATIONS), name


@pytest.mark.parametrize("name", [of_figure(name) for name in VARIATIONS])
def test_a_figure_is_drawn_with_other_parameters(name: str, tmp_path: Path) -> None:
    """On a screen, in a column, and as numbers, and what is drawn is in them."""
    if missing := figures.not_at_hand(figures.figure_definitions(name[:2])[name]):
        pytest.skip(missing)
    figure = figures.figure(name, **VARIATIONS[name])
    assert all(f"{parameter}=" in figure.call for parameter in VARIATIONS[name])
    for drawn in (figure.on_screen, figure.definition.draw(figure.data, Sheet(COLUMN))):
        if isinstance(drawn, Figure):
            drawn.set_dpi(50)
            FigureCanvasAgg(drawn).draw()
    if figure.definition.columns:
        path = figure.save(tmp_path / "numbers.csv")
        assert read_table(path)[1] != read_table(PUBLISHED / f"{name}.csv")[1]


def a_figure() -> Figure:
    figure = Figure()
    left, right = figure.subplots(1, 2)
    left.plot([0, 1, 2], [1, 3, 9], label="cubes of three")
    left.plot([0, 2], [5, 5], label=GUIDE)
    left.axhline(0.3)
    left.set(title="powers", xlabel="exponent", ylabel="power, m")
    right.bar([0, 1], [4.0, 5.0])
    right.set_xticks([0, 1], ["one", "other"])
    return figure


def test_the_header_says_which_columns_are_which_curve(tmp_path: Path) -> None:
    table = as_words({"exponent": [0, 1, 2], "power_m": [1, 3, 9], "bars": [4.0, 5.0]})
    assert table["bars"] == ["4", "5", ""]
    lines = header(a_figure(), table)
    assert lines == [
        'panel 1, "powers": x is "exponent", y is "power, m"',
        '  "cubes of three": x = exponent, y = power_m',
        "panel 2:",
        '  "": y = bars',
    ]
    write_table(tmp_path / "powers.csv", table, lines)
    powers, bars = read_curves(tmp_path / "powers.csv")
    np.testing.assert_array_equal(powers.y, [1, 3, 9])
    np.testing.assert_array_equal(bars.y, [4, 5])
    assert read_table(tmp_path / "powers.csv") == (lines, table)


def test_two_panels_may_show_the_same_rows() -> None:
    figure = Figure()
    for axes in figure.subplots(1, 2):
        axes.plot([0, 1], [2, 3], label="both")
    lines = header(figure, as_words({"x": [0, 1], "y": [2, 3]}))
    assert lines == ["panel 1:", '  "both": x = x, y = y', "panel 2:", '  "both": x = x, y = y']


def test_a_curve_that_is_in_two_panels_is_said_of_both(tmp_path: Path) -> None:
    figure = Figure()
    for panel in figure.subplots(1, 2):
        for _ in range(2):  # and twice in each
            panel.plot([0, 1, 2], [1, 3, 9], label="cubes of three")
    table = as_words({"exponent": [0, 1, 2], "power_m": [1, 3, 9]})
    write_table(tmp_path / "powers.csv", table, header(figure, table))
    assert [curve.panel for curve in read_curves(tmp_path / "powers.csv")] == [1, 2]


def test_a_curve_that_two_panels_share_is_told_for_both() -> None:
    figure = Figure()
    for panel in figure.subplots(1, 2):
        panel.plot([0.5, 1.5], [2.5, 3.5], label="both")
    lines = header(figure, as_words({"x": [0.5, 1.5], "y": [2.5, 3.5]}))
    assert lines == ["panel 1: ", '  "both": x = x, y = y', "panel 2: ", '  "both": x = x, y = y']


def test_a_curve_that_is_not_in_the_table_is_refused_by_name() -> None:
    table = as_words({"exponent": [0, 1, 2], "power_m": [1, 3, 8], "bars": [4.0, 5.0]})
    with pytest.raises(MissingCurves, match="panel 1, cubes of three of 3 points"):
        header(a_figure(), table)
    with pytest.raises(MissingCurves, match="panel 2, a curve without a name of 2 points"):
        header(a_figure(), as_words({"exponent": [0, 1, 2], "power_m": [1, 3, 9]}))


def test_contours_are_compared_with_the_table() -> None:
    figure = Figure()
    x, y = np.arange(4.0), np.arange(3.0)
    z = np.add.outer(y**2, x)
    filled_contours(figure.subplots(), x, y, z)
    across, up = np.meshgrid(x, y)
    table = as_words({"x": across.ravel(), "y": up.ravel(), "z": z.ravel()})
    assert header(figure, table)[-1] == "  contours: x = x, y = y, value = z"
    table["z"][5] = "7"
    with pytest.raises(MissingCurves, match="panel 1, contours"):
        header(figure, table)


@pytest.mark.parametrize(
    "rows",
    [
        Rows("time, s", "error = truth, m", {"run": "3", "kind": "one, two"}, 6, 2),
        Rows("", "-bias", {}),
    ],
)
def test_rows_are_read_as_they_are_written(rows: Rows) -> None:
    assert Rows.read(str(rows)) == rows
