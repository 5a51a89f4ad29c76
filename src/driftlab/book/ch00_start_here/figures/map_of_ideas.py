"""From the bend to the heading on one page: what leads to what, and in which chapter."""

from textwrap import fill
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREEN, ORANGE, VERMILION
from driftlab.book.machinery.figure.sheet import Sheet
from driftlab.checks import FloatArray


class Idea(NamedTuple):
    """A box of the map: where its middle is, what it says, its chapters and its kind."""

    x: float
    y: float
    says: str
    chapters: str
    colour: str


IDEAS = {
    "bend": Idea(0.9, 2.0, "a bent triad\n$A = I + M$", "01", VERMILION),
    "sigma": Idea(2.9, 2.8, "not square\n$\\Sigma$", "03, 10", VERMILION),
    "kappa": Idea(2.9, 1.2, "turned as a whole\n$\\kappa$", "03, 10", VERMILION),
    "drift": Idea(4.9, 2.8, "drift, turn by turn\n$\\rho = n^T M n$", "02, 03", VERMILION),
    "start": Idea(4.9, 1.2, "an attitude that\nstarts wrong", "10", VERMILION),
    "attitude": Idea(6.9, 2.0, "wrong attitude\n$\\varphi$", "01", VERMILION),
    "heading": Idea(8.9, 2.0, "wrong horizon,\nwrong heading", "13, 14, 16", VERMILION),
    "turns": Idea(2.9, 4.1, "whole turns\nmeasure $\\Sigma$", "04", GREEN),
    "filter": Idea(4.9, 4.1, "a Kalman filter\nmeasures nearly all", "11", GREEN),
    "computer": Idea(6.9, 4.1, "a better computer:\nCayley, Picard", "06, 07", GREEN),
    "log": Idea(8.9, 4.1, "a log, damping,\na careful alignment", "14, 15", GREEN),
    "earth": Idea(6.9, 0.1, "the Earth turns\nand is round", "05, 13, 14", BLUE),
    "noise": Idea(8.9, 0.1, "gyro bias\nand noise", "11, 13", ORANGE),
}
LEADS_TO = (
    ("bend", "sigma"), ("bend", "kappa"), ("sigma", "drift"), ("kappa", "start"),
    ("drift", "attitude"), ("start", "attitude"), ("attitude", "heading"),
    ("turns", "sigma"), ("filter", "drift"), ("computer", "attitude"), ("log", "heading"),
    ("earth", "attitude"), ("noise", "heading"),
)  # fmt: skip
BOX = (1.56, 0.78)
"""Width and height of a box."""
IN_A_COLUMN = (0.85, 1.34)
"""Of one in a narrow column, where the map leads down the page."""
COLUMNS = ((0.1, 1.2, 2.8, 4.1), (3.0, 2.0, 1.0, 0.0))
"""There, what is drawn at these ordinates stands at these abscissae."""
LETTERS = 16
"""In a line of a box there."""


@from_table
def draw(drawing: Drawing) -> None:
    """Boxes and arrows: what helps on one side of the way, what comes on top of it on the other."""
    sheet = drawing.sheet
    width = sheet.width or 9.6
    drawing.figure = Figure(figsize=(width, 4.6 if sheet.narrow else 4.9 / 9.6 * width))
    axes = drawing.figure.add_axes((0, 0, 1, 1))
    if sheet.narrow:
        axes.set(xlim=(-0.5, 3.5), ylim=(-9.65, -0.15))
    else:
        axes.set(xlim=(0, 9.8), ylim=(-0.45, 4.65))
    axes.axis("off")
    size = np.array(IN_A_COLUMN if sheet.narrow else BOX)
    says = "small" if sheet.narrow else "medium"
    chapters = "small" if sheet.on_paper else 8
    for idea in IDEAS.values():
        middle = _middle(idea, sheet)
        axes.add_patch(
            FancyBboxPatch(
                tuple(middle - size / 2), size[0], size[1], boxstyle="round,pad=0.02",
                edgecolor=idea.colour, facecolor="white", linewidth=1.0 if sheet.on_paper else 1.6,
            )
        )  # fmt: skip
        lines = idea.says.splitlines()
        text = "\n".join(fill(line, LETTERS) for line in lines) if sheet.narrow else idea.says
        words: dict[str, Any] = {"ha": "center", "va": "center", "color": BLACK}
        axes.text(middle[0], middle[1] + 0.1 * size[1], text, fontsize=says, **words)
        axes.text(middle[0], middle[1] - 0.38 * size[1], idea.chapters, fontsize=chapters, **words)
    for cause, effect in LEADS_TO:
        start, end = (_middle(IDEAS[name], sheet) for name in (cause, effect))
        along = 1 if sheet.narrow else 0
        way = along if abs(end[along] - start[along]) > size[along] else 1 - along
        edge = np.zeros(2)
        edge[way] = np.sign(end[way] - start[way]) * size[way] / 2
        axes.add_patch(
            FancyArrowPatch(
                tuple(start + edge), tuple(end - edge), arrowstyle="-|>", color=IDEAS[cause].colour,
                mutation_scale=7 if sheet.on_paper else 11,
                shrinkA=1 if sheet.on_paper else 3, shrinkB=2 if sheet.on_paper else 4,
            )
        )  # fmt: skip


def _middle(idea: Idea, sheet: Sheet) -> FloatArray:
    """Where the middle (2,) of a box is; in a column the map is turned, and leads down."""
    return np.array([np.interp(idea.y, *COLUMNS), -idea.x] if sheet.narrow else [idea.x, idea.y])
