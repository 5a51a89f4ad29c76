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
    figure, panels = sheet.mosaic(
        "abc", (10.0, 2.7), (0.01, 0.01, 0.99, 0.88), spaces=(0.05, 0.2), column_height=5.4
    )
    for panel, frame in zip(panels.values(), frames, strict=True):
        plain_axes(panel, 1.3)
        panel.set_ylim(-0.5, 1.25)
        if sheet.on_paper:
            panel.set_xlim(-0.75, 1.2)
        panel.set_title(frame.title, loc="center", fontsize="medium" if sheet.on_paper else 12)
        _draw_arrows(panel, frame.arrows, sheet, color=BLACK)
        if frame.turned:
            _draw_arrows(panel, frame.turned, sheet, color=VERMILION, linestyle="--")
        for arc in frame.arcs:
            flat = project(arc.points)
            panel.plot(*flat[:-3].T, color=BLUE, linewidth=1.5)
            _arrow(panel, flat[-6], flat[-1], sheet, color=BLUE)
            x, y = 1.15 * flat[len(flat) // 2] + [0, 0.13 if sheet.on_paper else 0.05]
            side = "left" if x > 0 else "right"
            panel.text(x, y, arc.label, ha=side, va="center", fontsize=_letters(sheet))
    return figure


def _letters(sheet: Sheet) -> float | str:
    """Size of the names in the drawings."""
    return "medium" if sheet.on_paper else 10


def _draw_arrows(panel: Axes, arrows: Arrows, sheet: Sheet, **style: str) -> None:
    for label, tip in zip(arrows.labels, project(arrows.tips), strict=True):
        _arrow(panel, np.zeros(2), tip, sheet, **style)
        x, y = 1.13 * tip
        panel.text(x, y, label, ha="center", va="center", fontsize=_letters(sheet))


def _arrow(panel: Axes, tail: FloatArray, tip: FloatArray, sheet: Sheet, **style: str) -> None:
    size = 7 if sheet.on_paper else 12
    arrow = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0, "mutation_scale": size, **style}
    panel.annotate("", tuple(tip), tuple(tail), arrowprops=arrow)
