"""What the pictures of all chapters share: tables of curves, legends, calls."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from driftlab.attitude import Algorithm
from driftlab.book.machinery.picture import long_table, shared_legend
from driftlab.book.machinery.publish import written
from driftlab.book.machinery.sheet import COLUMN, PAGE, Sheet


def test_long_table_keeps_every_curve() -> None:
    table = long_table({"a": ([1, 2], [3, 4]), "b": ([5], 6.0)})
    assert table["curve"] == ["a", "a", "b"]
    np.testing.assert_array_equal(table["x"], [1, 2, 5])
    np.testing.assert_array_equal(table["y"], [3, 4, 6])


@pytest.mark.parametrize("width", [COLUMN, PAGE])
def test_a_shared_legend_has_room_of_its_own_on_paper(width: float) -> None:
    figure, panels = Sheet(width).mosaic("ab", (9, 4), (0.1, 0.1, 0.9, 0.9))
    handles = [panels["a"].plot([0, 1], label=f"curve {i}")[0] for i in range(6)]
    shared_legend(figure, Sheet(width), handles, ncols=6)
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
