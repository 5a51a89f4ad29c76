"""Drawings of a table: each way of drawing says what it has drawn, and nothing is drawn past it."""

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import GUIDE, Drawing, MissingCurves
from driftlab.book.machinery.figure.picture import Picture
from driftlab.checks import FloatArray

TABLE = DataTable(
    {
        "time": (np.array([0.0, 60.0, 120.0, 180.0]), "min", ""),
        "error": (np.radians([1.0, 2.0, 4.0, 8.0]), "deg", ""),
        "low": (np.radians([0.5, 1.0, 3.0, 7.0]), "deg", ""),
        "high": (np.radians([2.0, 4.0, 8.0, 9.0]), "deg", ""),
        "axis": (["x", "y", "x", "y"], "", ""),
        "bound": ([2.5], "m", ""),
        "begin": (np.array([1.0, 3.0]), "s", ""),
        "end": (np.array([2.0, 5.0]), "s", ""),
        "across": (np.tile([0.0, 1.0, 2.0], 2), "", ""),
        "up": (np.repeat([0.0, 1.0], 3), "", ""),
        "height": (np.arange(6.0), "", ""),
    },
    {"often": (2, "", "rows of a turn")},
)


def drawn_by(draw: Callable[[Drawing, Axes], object], table: DataTable = TABLE) -> Drawing:
    """A drawing of one panel."""
    drawing = Drawing(table)
    draw(drawing, drawing.mosaic("a", (4.0, 3.0), (0.1, 0.1, 0.9, 0.9))["a"])
    return drawing


@pytest.mark.parametrize(
    ("draw", "lines"),
    [
        (
            lambda d, a: d.curve(a, "time", "error", label="exact"),
            ['"exact": x = time_min, y = error_deg'],
        ),
        (
            lambda d, a: d.curve(a, "time", "-error", every="often", method="scatter"),
            ['"": x = time_min, y = -error_deg, every 2 rows from row 0'],
        ),
        (
            lambda d, a: d.curve(a, "time", "error", where={"axis": "y"}),
            ['"": x = time_min, y = error_deg, where axis = y'],
        ),
        (
            lambda d, a: d.error_bars(a, "time", "error", "low", "high", label="runs"),
            [f'"runs": x = time_min, y = {y}_deg' for y in ("error", "low", "high")],
        ),
        (
            lambda d, a: d.error_bars(a, "error", "time", "low", "high", across=True),
            [f'"": x = {x}_deg, y = time_min' for x in ("error", "low", "high")],
        ),
        (
            lambda d, a: d.band(a, "time", "low", "high", label="range"),
            [f'"range": x = time_min, y = {y}_deg' for y in ("low", "high")],
        ),
        (
            lambda d, a: d.bar_chart(a, "time", "high", begin="low"),
            [f'"": x = time_min, y = {y}_deg' for y in ("low", "high")],
        ),
        (
            lambda d, a: (
                d.bar_chart(a, np.arange(4), "error", across=True),
                a.set_yticks(range(4), list("abcd")),
            ),
            ['"": x = error_deg'],
        ),
        (lambda d, a: d.level(a, y="bound", label="bound"), ['"bound": y = bound_m']),
        (
            lambda d, a: d.spans(a, "begin", "end", label="rest"),
            ['"rest": x = begin_s', '"rest": x = end_s'],
        ),
        (lambda d, a: d.distribution(a, "error"), ['"": x = error_deg, y = rank / number']),
        (
            lambda d, a: d.contours(a, "across", "up", "height"),
            ["contours: x = across, y = up, value = height"],
        ),
    ],
)
def test_the_header_says_what_is_drawn(
    draw: Callable[[Drawing, Axes], object], lines: list[str]
) -> None:
    assert drawn_by(draw).header() == ["panel 1:", *(f"  {line}" for line in lines)]


def test_what_is_drawn_is_what_the_columns_say() -> None:
    drawing = drawn_by(
        lambda d, a: (
            d.curve(a, "time", "-error", every=3),
            d.curve(a, "time", "error", where={"axis": "x"}),
            d.error_bars(a, "time", "error", "low", "high"),
            d.bar_chart(a, "time", "high", begin="low"),
            d.distribution(a, "error"),
        )
    )
    (axes,) = drawing.figure.axes
    thinned, chosen, points, shares = (line.get_xydata() for line in axes.lines)
    np.testing.assert_allclose(thinned, [[0, -1], [3, -8]], rtol=1e-15)
    np.testing.assert_allclose(chosen, [[0, 1], [2, 4]], rtol=1e-15)
    np.testing.assert_allclose(points[:, 1], [1, 2, 4, 8], rtol=1e-15)
    ends = np.array(axes.collections[0].get_segments())[..., 1]
    np.testing.assert_allclose(ends, [[0.5, 2], [1, 4], [3, 8], [7, 9]], rtol=1e-15)
    bars = [(bar.get_y(), bar.get_y() + bar.get_height()) for bar in axes.patches]
    np.testing.assert_allclose(bars, ends, rtol=1e-15)
    np.testing.assert_allclose(shares, [[1, 0.25], [2, 0.5], [4, 0.75], [8, 1]], rtol=1e-15)


def test_panels_have_titles_and_insets_and_drawings_have_no_curves() -> None:
    def draw(drawing: Drawing) -> None:
        panels = drawing.mosaic("ab", (6.0, 3.0), (0.1, 0.1, 0.9, 0.9))
        panels["a"].set(title="two\nlines", xlabel="time, min", ylabel="error, °")
        drawing.curve(panels["a"].inset_axes((0, 0, 1, 1)), "time", "error")
        panels["b"].plot([0, 1], [0, 1])
        panels["b"].axis("off")

    drawing = Drawing(TABLE)
    draw(drawing)
    assert drawing.header() == [
        'panel 1, "two lines": x is "time, min", y is "error, °"',
        "panel 2:",
        '  "": x = time_min, y = error_deg',
        "panel 3: a drawing, without axes",
    ]


@pytest.mark.parametrize(
    "draw",
    [
        lambda a: a.plot([0, 1], [2, 3]),
        lambda a: a.axhline(2.0),
        lambda a: a.bar([0, 1], [2, 3]),
        lambda a: a.scatter([0], [1]),
        lambda a: a.fill_between([0, 1], [0, 1]),
        lambda a: a.add_patch(Circle((0, 0), 1)),
        lambda a: a.contourf(np.outer([1, 2], [1, 2])),
        lambda a: a.errorbar([0], [1], [1]),
        lambda a: a.pcolormesh(np.eye(2)),
        lambda a: a.imshow(np.eye(2)),
        lambda a: a.inset_axes((0, 0, 1, 1)).plot([0, 1]),
        lambda a: a.twinx().plot([0, 1]),
        lambda a: a.figure.add_artist(Line2D([0, 1], [0, 1])),
    ],
)
def test_what_is_drawn_past_the_table_is_refused(draw: Callable[[Axes], object]) -> None:
    with pytest.raises(MissingCurves, match="expected all curves drawn from the table, got"):
        drawn_by(lambda _, axes: draw(axes)).header()


@pytest.mark.parametrize("change", [lambda e: e.set_data([0, 1], [2, 3]), lambda e: e.remove()])
def test_a_curve_stays_as_it_was_drawn(change: Callable[[Line2D], object]) -> None:
    drawing = drawn_by(lambda d, a: change(d.curve(a, "time", "error", label="e")))
    with pytest.raises(MissingCurves, match='"e": expected the columns that were drawn'):
        drawing.header()


@pytest.mark.parametrize("every", [0, -2])
def test_rows_are_thinned_forwards(every: int) -> None:
    with pytest.raises(ValueError, match=f"every: expected at least 1, got {every}"):
        drawn_by(lambda d, a: d.curve(a, "time", "error", every=every))


def test_guides_words_and_samples_of_a_legend_need_no_column() -> None:
    def draw(drawing: Drawing, axes: Axes) -> None:
        drawing.curve(axes, "time", "error", label="_hidden")
        axes.axhline(0, label=GUIDE)
        axes.plot([], [], label="in the legend")
        axes.annotate("here", (0, 0), (1, 1), arrowprops={})
        axes.legend()

    assert drawn_by(draw).header()[1:] == ['  "": x = time_min, y = error_deg']


def test_places_are_for_axes_that_count_words() -> None:
    drawing = drawn_by(lambda d, a: d.curve(a, np.arange(4.0), "error", label="e"))
    with pytest.raises(MissingCurves, match='"e": expected a column along x, got places'):
        drawing.header()


class ErrorPicture(Picture):
    """A curve that moves."""

    def build(self) -> None:
        self.figure = Figure()
        self.curve(self.figure.subplots(), "time", "error", every="often", label="error")


def test_a_picture_draws_what_it_can_move() -> None:
    with pytest.raises(ValueError, match=r"expected one that draws a line, .* got 'scatter'"):
        Picture.curve(ErrorPicture(), Figure().subplots(), "time", "error", method="scatter")


def test_a_picture_moves_with_its_table() -> None:
    picture = ErrorPicture.draw(TABLE)
    (line,) = picture.moving
    np.testing.assert_allclose(line.get_xydata(), [[0, 1], [2, 4]], rtol=1e-15)
    half: FloatArray = TABLE.error / 2
    picture.update(
        DataTable({"time": (TABLE.time, "min"), "error": (half, "deg")}, {"often": (3, "", "")})
    )
    np.testing.assert_allclose(line.get_xydata(), [[0, 0.5], [3, 4]], rtol=1e-15)
    assert picture.header()[1:] == [
        '  "error": x = time_min, y = error_deg, every 3 rows from row 0'
    ]
