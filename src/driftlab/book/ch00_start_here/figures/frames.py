"""The frames of the papers, each with the sign of a positive angle."""

import numpy as np
from matplotlib.axes import Axes
from scipy.spatial.transform import Rotation

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, VERMILION, plain_axes, project
from driftlab.book.machinery.figure.sheet import Sheet
from driftlab.checks import FloatArray

EAST, NORTH, UP = np.eye(3)
APPARENT_ANGLE = 0.35
"""Angle from R to B as shown, rad; far larger than a real one."""


@from_table
def draw(drawing: Drawing) -> None:
    """One panel a frame: its axes, the apparent ones dashed, and arcs of positive angles."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "abc", (10.0, 2.7), (0.01, 0.01, 0.99, 0.88), spaces=(0.05, 0.2), column_height=5.4
    )
    titles = (
        "Larin: body R, apparent B",
        "Wu: 1 East, 2 North, 3 Up",
        "Plotnikov: 1 North, 2 Up, 3 East",
    )
    axes = (
        {"$i_1$": EAST, "$i_2$": NORTH, "$i_3$": UP},
        {"East": EAST, "North": NORTH, "Up": UP},
        {"North": NORTH, "Up": UP, "East": EAST},
    )
    pitch = _arc(EAST, NORTH, radius=0.75)
    arcs = (
        {r"$\lambda_e$": _arc(UP, EAST, APPARENT_ANGLE, 0.65)},
        {"about Up": _arc(UP, EAST), "about East": pitch},
        {"heading": _arc(UP, NORTH), "pitch": pitch},
    )
    for panel, title, tips in zip(panels.values(), titles, axes, strict=True):
        plain_axes(panel, 1.3)
        panel.set_ylim(-0.5, 1.25)
        if sheet.on_paper:
            panel.set_xlim(-0.75, 1.2)
        panel.set_title(title, loc="center", fontsize="medium" if sheet.on_paper else 12)
        _draw_arrows(panel, tips, sheet, color=BLACK)
    turned = _rotation(UP, APPARENT_ANGLE).apply(np.eye(3))
    apparent = dict(zip(("$1_B$", "$2_B$", ""), turned, strict=True))
    _draw_arrows(panels["a"], apparent, sheet, color=VERMILION, linestyle="--")
    for panel, drawn in zip(panels.values(), arcs, strict=True):
        for label, points in drawn.items():
            flat = project(points)
            panel.plot(*flat[:-3].T, color=BLUE, linewidth=1.5)
            _arrow(panel, flat[-6], flat[-1], sheet, color=BLUE)
            x, y = 1.15 * flat[len(flat) // 2] + [0, 0.13 if sheet.on_paper else 0.05]
            side = "left" if x > 0 else "right"
            panel.text(x, y, label, ha=side, va="center", fontsize=_letters(sheet))


def _rotation(axis: FloatArray, angle: float | FloatArray) -> Rotation:
    return Rotation.from_rotvec(np.multiply.outer(angle, axis))


def _arc(
    axis: FloatArray, start: FloatArray, angle: float = 1.2, radius: float = 0.5
) -> FloatArray:
    """Points (30, 3) of a positive rotation about an axis."""
    return radius * _rotation(axis, np.linspace(0, angle, 30)).apply(start)


def _letters(sheet: Sheet) -> float | str:
    """Size of the names in the drawings."""
    return "medium" if sheet.on_paper else 10


def _draw_arrows(panel: Axes, tips: dict[str, FloatArray], sheet: Sheet, **style: str) -> None:
    """Draw three arrows from the origin to tips in the coordinates East, North, Up."""
    for label, tip in zip(tips, project(np.array([*tips.values()])), strict=True):
        _arrow(panel, np.zeros(2), tip, sheet, **style)
        x, y = 1.13 * tip
        panel.text(x, y, label, ha="center", va="center", fontsize=_letters(sheet))


def _arrow(panel: Axes, tail: FloatArray, tip: FloatArray, sheet: Sheet, **style: str) -> None:
    size = 7 if sheet.on_paper else 12
    arrow = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0, "mutation_scale": size, **style}
    panel.annotate("", tuple(tip), tuple(tail), arrowprops=arrow)
