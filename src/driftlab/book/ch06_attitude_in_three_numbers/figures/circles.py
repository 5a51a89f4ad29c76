"""The circles on which the Cayley vector runs while the body turns steadily."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES, VERMILION, project

SEEN_FROM = -66.0, 26.0
REACH = 1.7
"""Of the axis that is drawn."""
EVERY = 15
"""Moments from dot to dot: an eighth of a turn."""


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the axis, the ball of vectors no longer than one, the circles, and one more boldly."""
    table = drawing.table
    panel = drawing.mosaic("a", (6.4, 4.4), (0.01, 0.01, 0.99, 0.92), column_height=3.2)["a"]
    panel.set_title("paths of k while the body turns steadily")
    panel.set_aspect("equal")
    panel.axis("off")
    around = np.linspace(0, 2 * np.pi, 181)
    panel.fill(np.cos(around), np.sin(around), color=GREY, alpha=0.12, linewidth=0)
    axis = project(np.array([[0.0, 0.0, -REACH], [0.0, 0.0, REACH]]), *SEEN_FROM)
    panel.plot(*axis.T, color=BLACK, linestyle="-.", linewidth=1.2)
    end = axis[1, 0] + 0.06, axis[1, 1] - 0.05
    panel.annotate("from zero: a line", end, ha="left", va="center")
    first, *others = (project(path.T, *SEEN_FROM) for path in table.path)
    for path in others:
        panel.plot(*path.T, color=GREY, linewidth=0.9)
    panel.plot(*first.T, **SERIES[0], linewidth=2.2)
    panel.plot(*first[::EVERY].T, color=SERIES[0]["color"], linestyle="none", marker="o", ms=4)
    pair = project(np.stack([table.path[0][:, 0], table.shadow]), *SEEN_FROM)
    panel.plot(*pair.T, color=VERMILION, linestyle="--", linewidth=1.2)
    panel.plot(*pair.T, color=VERMILION, linestyle="none", marker="o", ms=7)
    for name, place, side in (("k", pair[0], 0.12), ("its shadow", pair[1], -0.12)):
        ha = "left" if side > 0 else "right"
        panel.annotate(name, (place[0] + side, place[1]), ha=ha, va="center", color=BLACK)
    panel.set(xlim=(-2.8, 2.1), ylim=(-1.75, 1.75))
