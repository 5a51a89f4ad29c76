"""The frames of the papers, each with the sign of a positive angle."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import (
    BLACK,
    BLUE,
    VERMILION,
    in_style,
    plain_axes,
    project,
)
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import Arrows, Frame


@in_style
def draw(frames: list[Frame], sheet: Sheet) -> Figure:
    """One panel a frame: its axes, a second frame dashed if there is one, and the arcs."""
    figure = Figure(figsize=(10.0, 2.7))
    panels = figure.subplots(1, 3)
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.88, wspace=0.05)
    for panel, frame in zip(panels, frames, strict=True):
        plain_axes(panel, 1.3)
        panel.set_ylim(-0.5, 1.25)
        panel.set_title(frame.title, loc="center", fontsize=12)
        _draw_arrows(panel, frame.arrows, color=BLACK)
        if frame.turned:
            _draw_arrows(panel, frame.turned, color=VERMILION, linestyle="--")
        for arc in frame.arcs:
            flat = project(arc.points)
            panel.plot(*flat[:-3].T, color=BLUE, linewidth=1.5)
            _arrow(panel, flat[-6], flat[-1], color=BLUE)
            x, y = 1.15 * flat[len(flat) // 2] + [0, 0.05]
            side = "left" if x > 0 else "right"
            panel.text(x, y, arc.label, ha=side, va="center", fontsize=10)
    return figure


def _draw_arrows(panel: Axes, arrows: Arrows, **style: str) -> None:
    for label, tip in zip(arrows.labels, project(arrows.tips), strict=True):
        _arrow(panel, np.zeros(2), tip, **style)
        x, y = 1.13 * tip
        panel.text(x, y, label, ha="center", va="center", fontsize=10)


def _arrow(panel: Axes, tail: FloatArray, tip: FloatArray, **style: str) -> None:
    arrow = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0, "mutation_scale": 12, **style}
    panel.annotate("", tuple(tip), tuple(tail), arrowprops=arrow)
