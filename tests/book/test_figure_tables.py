"""Each figure can be drawn from its CSV alone, and the CSV says of what parameters it is."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon, Rectangle
from matplotlib.transforms import Affine2D

import driftlab
from driftlab.book import figures
from driftlab.book.machinery.curve_rows import Rows, numbers
from driftlab.book.machinery.data_table import KEPT
from driftlab.book.machinery.drawn import Curve, curves, fields
from driftlab.book.machinery.figure_table import (
    MissingCurves,
    as_words,
    header,
    read_curves,
    read_table,
    write_table,
)
from driftlab.book.machinery.picture import GUIDE, filled_contours
from driftlab.book.machinery.publish import PublishedFigure, call_of
from driftlab.book.machinery.sheet import COLUMN, Sheet
from driftlab.book.machinery.written import imports, written
from figure_variations import SHORT, VARIATIONS, plain
from published import NAMES, of_figure, published

PUBLISHED = Path(__file__).parents[2] / "figures"
WITH_NUMBERS = [name for name in NAMES if figures.figure_definitions(name[:2])[name].columns]


@published(*WITH_NUMBERS)
def test_a_figure_can_be_drawn_from_its_csv_alone(figure: PublishedFigure) -> None:
    """Every curve, point and bar that is drawn, and the contours."""
    if not isinstance(figure.on_screen, Figure):
        return  # a scene: it plays, and its readouts are the table
    path = PUBLISHED / f"{figure.definition.name}.csv"
    again, shown = as_drawn(read_curves(path)), curves(figure.on_screen)
    for (number, name), of_one_name in as_drawn(shown).items():
        found = again[number, name]
        panel = [curve for curve in shown if curve.panel == number]
        for curve in of_one_name:
            assert any(same(curve, other, panel) for other in found), (number, name)
    comments, table = read_table(path)
    drawn = [line for line in comments if line.startswith("  contours: ")]
    maps = fields(figure.on_screen)
    assert len(drawn) == len(maps)
    for line, field in zip(drawn, maps, strict=True):
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


def same(curve: Curve, other: Curve, panel: list[Curve]) -> bool:
    """Whether two curves have the same numbers; some tables are rounded, to the fifth digit.

    What is below 1e-12, of one or of the largest number of its panel, is rounding (a motion that
    leaves nothing, beside others that leave degrees), and each processor rounds in its own way.
    """
    for axis in ("x", "y"):
        one, two = getattr(curve, axis), getattr(other, axis)
        if one.shape != two.shape:
            return False
        two = np.where(np.isfinite(two), two, np.nan)
        residue = 1e-12 * max(1.0, *(largest_number(getattr(each, axis)) for each in panel))
        # On a logarithmic scale a gap stands for zero.
        one, two = (
            np.where(np.isnan(a) & (np.abs(b) < residue), 0.0, a)
            for a, b in ((one, two), (two, one))
        )
        least = max(residue, 1e-5 * largest_number(one))
        if not np.allclose(one, two, rtol=0, atol=least, equal_nan=True):
            return False
    return True


def largest_number(values: np.ndarray) -> float:
    """The largest size of the finite ones."""
    return float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))


@published(*WITH_NUMBERS)
def test_the_csv_names_its_parameters_its_call_and_the_version(figure: PublishedFigure) -> None:
    comments, _ = read_table(PUBLISHED / f"{figure.definition.name}.csv")
    if missing := figures.not_at_hand(figure.definition):
        pytest.skip(missing)
    computed = figure.comments(as_words(figure.table()))
    version = r"driftlab \d+\.\d+\.\d+"
    made = next(line for line in comments if line.startswith("made by: "))
    assert re.search(version, made)
    assert f"driftlab.figure('{figure.definition.name}')" in made
    assert [*map(without_numbers, comments)] == [*map(without_numbers, computed)]


def without_numbers(line: str) -> str:
    """A line without the version, and without the digits of facts, which processors round."""
    line = re.sub(r"driftlab \d+\.\d+\.\d+", "driftlab", line).rstrip()
    if line.startswith(KEPT):
        return KEPT
    is_fact = re.search(r"^[^\s,=\"]+.*: -?[\d.]+(e[-+]\d+)?\S*( \S+)?$", line)
    return line.rpartition(": ")[0] if is_fact else line


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
    definition = figures.figure_definitions(name[:2])[name]
    asked = definition.parameters | VARIATIONS[name]
    call, page = call_of(definition, asked), {"driftlab": driftlab}
    exec("\n".join(imports(VARIATIONS[name])), page)
    figure = eval(call, page)  # as a reader who has the line and the imports above it
    assert figure.call == call
    assert all(f"{parameter}=" in call for parameter in VARIATIONS[name])
    for drawn in (figure.on_screen, figure.definition.draw(figure.data, Sheet(COLUMN))):
        figure_drawn = getattr(drawn, "figure", drawn)
        if isinstance(figure_drawn, Figure):
            figure_drawn.draw_without_rendering()
    if figure.definition.columns:
        path = figure.save(tmp_path / "numbers.csv")
        assert read_table(path)[1] != read_table(PUBLISHED / f"{name}.csv")[1]


def a_figure() -> Figure:
    figure = Figure()
    left, right = figure.subplots(1, 2)
    left.plot([0, 1, 2], [1, 3, 9], label="cubes of three")
    left.plot([0, 2], [5, 5], label=GUIDE)
    left.axhline(0.3, label=GUIDE)
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


def drawn_by(draw: Callable[[Axes], object]) -> Figure:
    """A figure of one panel."""
    figure = Figure()
    axes = figure.subplots()
    draw(axes)
    return figure


def in_band(axes: Axes, *corners: tuple[float, float]) -> Polygon:
    """A polygon over the whole height, as axvspan draws before Matplotlib 3.9."""
    return Polygon(corners, transform=axes.get_xaxis_transform(which="grid"))


NOTHING = as_words({"nothing": [0.123]})


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (lambda a: a.stairs([1, 2]), "a StepPatch"),
        (lambda a: a.hist([1, 2, 2], histtype="step"), "a Polygon"),
        (lambda a: a.fill([0, 1, 1], [0, 0, 1]), "a Polygon"),
        (lambda a: a.imshow(np.eye(2)), "a AxesImage"),
        (lambda a: a.pcolormesh(np.eye(2)), "a QuadMesh"),
        (lambda a: a.quiver([0], [0], [1], [1]), "a Quiver"),
        (lambda a: a.pie([1, 2]), "a drawing"),
        (lambda a: a.add_patch(Circle((0, 0), 1)), "a Circle"),
        (lambda a: a.add_patch(Rectangle((0, 0), 1, 1)), "a Rectangle"),
        (lambda a: a.add_patch(in_band(a, (0, 0), (0, 1), (1, 1))), "a Polygon"),
        (lambda a: a.arrow(0, 0, 1, 1), "a FancyArrow"),
        (lambda a: a.annotate("", (0, 0), (1, 1), arrowprops={}), "a Annotation"),
        (lambda a: a.table([["1"]]), "a Table"),
        (lambda a: a.axline((0, 0), slope=1), "a AxLine"),
        (lambda a: a.scatter([0, 1], [0, 1], c=[3, 4]), "a PathCollection"),
        (lambda a: a.contour(np.outer([1, 2], [1, 2])), "contours that filled_contours has not"),
        (lambda a: a.contourf(np.outer([1, 2], [1, 2])).set_label(GUIDE), "contours that"),
        (lambda a: a.plot([0, 1], transform=a.transData + Affine2D()), "a Line2D"),
        (lambda a: a.figure.add_artist(Line2D([0, 1], [0, 1])), "a Line2D on no panel"),
        (lambda a: a.inset_axes((0, 0, 1, 1)).plot([4, 5], label="in"), "panel 2, in of 2 points"),
        (lambda a: a.axhline(2.5, label="result"), "panel 1, result at y = 2.5"),
        (lambda a: a.axvspan(2.5, 3.5), "panel 1, a value without a name at x = 2.5"),
        (
            lambda a: a.add_patch(in_band(a, (2.5, 0), (2.5, 1), (3, 1), (3, 0))),
            "panel 1, a value without a name at x = 2.5",
        ),
        (lambda a: (a.plot([7, 8], [1, 2]), a.set_yticks([])), "x from 7 to 8, y from 1 to 2"),
        (lambda a: a.add_collection(LineCollection([[(0, 0), (1, 3), (2, 2)]])), "of 3 points"),
    ],
)
def test_nothing_is_left_out_because_of_its_kind(draw: Callable[[Axes], object], said: str) -> None:
    figure = drawn_by(draw)
    if said == "a drawing":
        figure.axes[0].set_axis_on()
        said = "a Wedge"
    with pytest.raises(MissingCurves, match=re.escape(said)):
        header(figure, NOTHING)


def test_three_dimensions_are_not_read() -> None:
    figure = Figure()
    figure.add_subplot(projection="3d").plot([0, 1], [0, 1], [0, 1])
    with pytest.raises(MissingCurves, match="panel 1, 3d axes"):
        header(figure, NOTHING)


def test_guides_words_drawings_and_scales_of_colours_need_no_column() -> None:
    figure = Figure()
    plane, sketch, words = figure.subplots(1, 3)
    plane.axhline(0, label=GUIDE)
    plane.annotate("here", (0, 0), (1, 1), arrowprops={})
    x = np.arange(3.0)
    figure.colorbar(filled_contours(plane, x, x, np.outer(x, x)), ax=plane)
    sketch.plot([0, 1], [0, 1])
    sketch.axis("off")
    words.plot([0, 1], [1, 0], "o")
    words.set_xticks([0, 1], ["a", "b"])
    words.set_yticks([0, 1], ["c", "d"])
    grid = (each.ravel() for each in np.meshgrid(x, x))
    table = as_words({**dict(zip("xy", grid, strict=True)), "z": np.outer(x, x).ravel()})
    assert header(figure, table) == [
        "panel 1:",
        "  contours: x = x, y = y, value = z",
        "panel 2: a drawing, without axes",
        "panel 3: words both ways",
    ]


def test_a_level_has_a_column_of_nothing_else(tmp_path: Path) -> None:
    figure = drawn_by(lambda a: (a.axhline(2.5, label="bound"), a.axvspan(1, 3)))
    with pytest.raises(MissingCurves, match=re.escape("bound at y = 2.5")):
        header(figure, as_words({"run": [1, 2, 3], "other": [1, 2.5, 3]}))
    table = as_words({"bound_m": [2.5], "from_s": [1], "to_s": [3]})
    lines = header(figure, table)
    assert lines[1:] == ['  "bound": y = bound_m', '  "": x = from_s', '  "": x = to_s']
    write_table(tmp_path / "levels.csv", table, lines)
    assert [len(each.x) + len(each.y) for each in read_curves(tmp_path / "levels.csv")] == [1] * 3


def test_bands_of_one_name_are_the_rows_of_their_begins_and_ends() -> None:
    figure = drawn_by(lambda a: [a.axvspan(t, t + 1, label="rest") for t in (1, 4, 6)])
    lines = header(figure, as_words({"begin_s": [1, 4, 6], "end_s": [2, 5, 7]}))
    assert lines[1:] == ['  "rest": x = begin_s', '  "rest": x = end_s']


@pytest.mark.parametrize("step", [None, "pre", "post", "mid"])
def test_the_two_edges_of_what_is_filled_are_in_the_table(step: str | None) -> None:
    x, low, high = np.array([0, 1, 3, 4.5]), np.array([0, 1, 0, 2]), np.array([3, 4, 3, 5])
    figure = drawn_by(lambda a: a.fill_between(x, low, high, step=step, label="range"))
    lines = header(figure, as_words({"x": x, "low": low, "high": high}))
    assert lines[1:] == ['  "range": x = x, y = low', '  "range": x = x, y = high']


@pytest.mark.parametrize("off", [0, 1e-11, 1e-8, 1e-3])
def test_a_curve_is_its_column_to_the_digits_of_a_table(off: float) -> None:
    figure = drawn_by(lambda a: (a.plot([0, 1, 2], [1, 3 + off, 9]), a.set_ylim(0, 1e4)))
    table = as_words({"x": [0, 1, 2], "y": [1, 3, 9]})
    if off < 1e-9:
        assert header(figure, table)[1:] == ['  "": x = x, y = y']
    else:
        with pytest.raises(MissingCurves):
            header(figure, table)


def test_a_rounded_column_holds_one_of_two_curves_that_it_could_be() -> None:
    figure = drawn_by(lambda a: [a.plot([0, 1], [0.123456, y]) for y in (1.000001, 1.000002)])
    table = {"x": ["0", "1"], "first": ["0.12346", "1"]}
    with pytest.raises(MissingCurves, match=re.escape("y from 0.123456 to 1")):
        header(figure, table)
    assert len(header(figure, table | {"second": table["first"]})) == 3


def test_twins_are_told_apart_by_their_names() -> None:
    figure = drawn_by(lambda a: [a.plot([0, 1], [2, 3], label=name) for name in ("one", "two")])
    lines = header(figure, as_words({"x": [0, 1], "by two": [2, 3], "by one": [2, 3]}))
    assert lines[1:] == ['  "one": x = x, y = by one', '  "two": x = x, y = by two']


@pytest.mark.parametrize("name", ["x, y = 2", "#x", "a, where b", 'of "x"', "two\nlines", " x", ""])
def test_names_that_a_header_cannot_hold_are_refused(name: str) -> None:
    with pytest.raises(ValueError, match=r"(Names and keys of a table|Columns): expected"):
        header(Figure(), as_words({name: [1.0], "other": [2.0]}))


class Choice(NamedTuple):
    kind: str
    sizes: tuple[float, ...]


def test_parameters_have_their_values_again() -> None:
    values = {
        "scheme": SHORT,
        "kinds": [Choice("two  blanks", (1.0, float("inf"))), np.float64(2)],
        "way": plain,
        "sizes": {("a", 1): np.array([1.0, -np.inf])},
    }
    page: dict[str, Any] = {"Choice": Choice}
    lines = imports(values)
    assert "from driftlab import Scheme" in lines
    assert "from figure_variations import plain" in lines
    exec("\n".join(line for line in lines if "Choice" not in line), page)
    again = {name: eval(written(value), page) for name, value in values.items()}
    assert again == values | {"sizes": {("a", 1): [1.0, -np.inf]}}
    assert np.isnan(eval(written(np.nan)))
