"""What the pictures of all chapters share: limits, legends, calls."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from driftlab.attitude import Algorithm
from driftlab.book.machinery.figure.picture import decades, legend_above, legend_below_all
from driftlab.book.machinery.figure.sheet import COLUMN, PAGE, Sheet
from driftlab.book.machinery.figure.written import written


@pytest.mark.parametrize("width", [COLUMN, PAGE])
def test_a_legend_below_all_panels_has_room_of_its_own_on_paper(width: float) -> None:
    figure, panels = Sheet(width).mosaic("ab", (9, 4), (0.1, 0.1, 0.9, 0.9))
    handles = [panels["a"].plot([0, 1], label=f"curve {i}")[0] for i in range(6)]
    legend_below_all(figure, Sheet(width), handles, ncols=6)
    FigureCanvasAgg(figure).draw()
    top = figure.legends[0].get_window_extent().y1
    assert all(panel.get_tightbbox().y0 > top for panel in panels.values())


def test_parameters_are_written_as_one_would_type_them() -> None:
    def mine(g: np.ndarray) -> np.ndarray:
        return g

    weights = Algorithm("own", 2, 0, {(0, 1): 0.6}, "tangent", 3)
    assert written({"mine": mine, "a": "memory-4", "b": np.ones(2)}) == (
        "{'mine': mine, 'a': 'memory-4', 'b': [1.0, 1.0]}"
    )
    assert eval(written({"own": weights})) == {"own": weights}


@pytest.mark.parametrize(
    ("values", "limits"),
    [
        ([0.5, 20], (0.3, 30)),
        ([0.02, 20], (0.01, 30)),
        ([[0.5], [301]], (0.3, 1000)),
        ([0.0, -1, np.nan], (0.3, 30)),  # what has no place on a log scale moves nothing
        ([], (0.3, 30)),
    ],
)
def test_logarithmic_limits_hold_what_leaves_them(values, limits) -> None:
    assert decades(values, 0.3, 30) == limits


@pytest.mark.parametrize("width", [None, COLUMN])
def test_a_legend_stands_above_on_a_screen_and_below_on_paper(width) -> None:
    figure, panels = Sheet(width).mosaic("a", (5.0, 3.0), (0.1, 0.2, 0.9, 0.8))
    panels["a"].plot([0, 1], label="a curve")
    panels["a"].set_xlabel("time, s")
    legend_above(panels["a"])
    FigureCanvasAgg(figure).draw()
    legend = panels["a"].get_legend().get_texts()[0].get_window_extent()
    box = panels["a"].bbox
    if width is None:
        assert legend.y0 >= box.y1 - 0.05 * box.height
    else:
        assert 0 <= legend.y0 < legend.y1 <= panels["a"].xaxis.label.get_window_extent().y0
