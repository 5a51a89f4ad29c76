"""Coning as an area: the increments add up to zero, but on their way they go round something."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    SERIES,
    VERMILION,
    plain_axes,
    project,
)
from driftlab.checks import FloatArray


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the cone, the circle with the polygon, and one pair of samples."""
    panels = drawing.mosaic(
        "abc", (10.5, 4.0), (0.01, 0.05, 0.985, 0.9), spaces=(0.15, 0.2), column="a;b;c",
        width_ratios=[0.8, 1, 1], column_heights=[0.8, 1, 1],
    )  # fmt: skip
    titles = "the third axis runs round", "sum of the increments in a round", "one pair of samples"
    for panel, title in zip(panels.values(), titles, strict=True):
        panel.set_title(title)
        panel.set_aspect("equal")
        panel.axis("off")
    table = drawing.table
    circle, corners = table.circle.T, table.corners.T
    _draw_cone(panels["a"], table.third_axis.T)
    _draw_round(panels["b"], circle, corners, table.radius)
    arc = circle[: 2 * (len(circle) - 1) // table.samples + 1]
    _draw_pair(panels["c"], arc, corners[:3])


def _draw_cone(panel: Axes, third_axis: FloatArray) -> None:
    plain_axes(panel, 1.2)
    panel.set_ylim(-0.35, 1.45)
    up = project(np.array([0.0, 0.0, 1.25]))
    panel.plot([0, up[0]], [0, up[1]], color=BLACK, linewidth=0.9, linestyle="-.")
    panel.plot(*project(third_axis).T, **SERIES[0])
    # The last point of the round is its first again.
    for tip in project(third_axis[: -1 : len(third_axis) // 8]):
        panel.plot([0, tip[0]], [0, tip[1]], color=GREY, linewidth=0.9)


def _draw_round(panel: Axes, circle: FloatArray, corners: FloatArray, radius: float) -> None:
    panel.add_patch(Polygon(circle, closed=True, color=ORANGE, alpha=0.6, linewidth=0))
    panel.add_patch(Polygon(corners, closed=True, color="white", linewidth=0))
    panel.plot(*circle.T, **SERIES[0], label="true")
    panel.plot(*corners.T, color=VERMILION, marker="o", markersize=4, label="from samples")
    panel.legend(loc="center")
    reach = 1.1 * radius
    panel.set(xlim=(-reach - radius, reach - radius), ylim=(-reach, reach))


def _draw_pair(panel: Axes, arc: FloatArray, corners: FloatArray) -> None:
    first, middle, last = corners
    panel.add_patch(Polygon(arc, closed=True, color=ORANGE, alpha=0.6, linewidth=0))
    panel.add_patch(Polygon(corners, closed=True, facecolor="none", edgecolor=BLUE, hatch="///"))
    panel.plot(*arc.T, **SERIES[0])
    panel.plot(*np.stack([first, last]).T, color=VERMILION, marker="o", markersize=5)
    panel.plot(*corners.T, color=BLACK, marker="o", markersize=5, linewidth=1.2)
    low, high = arc.min(axis=0), arc.max(axis=0)
    margin = 0.25 * (high - low).max()
    panel.set_xlim(low[0] - margin, high[0] + margin)
    panel.set_ylim(low[1] - margin, high[1] + margin)
    centre = corners.mean(axis=0)
    for text, a, b in (
        (r"$\gamma_1$", first, middle), (r"$\gamma_2$", middle, last), (r"$\gamma$", first, last)
    ):  # fmt: skip
        # Beside the middle of its side, on the far side of the triangle, clear of the arc.
        normal = np.array([b[1] - a[1], a[0] - b[0]]) / np.linalg.norm(b - a)
        outwards = normal * np.sign(normal @ (a - centre))
        place = (a + b) / 2 + 0.75 * margin * outwards
        panel.annotate(text, tuple(place), ha="center", va="center", fontsize="x-large")
