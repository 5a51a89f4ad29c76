"""From the bend to the heading on one page: what leads to what, and in which chapter."""

from typing import NamedTuple

from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

from driftlab.book.machinery.picture import BLACK, BLUE, GREEN, ORANGE, VERMILION, in_style
from driftlab.book.machinery.sheet import Sheet


class Idea(NamedTuple):
    """A box of the map: where its middle is, what it says, its chapters and its kind."""

    x: float
    y: float
    says: str
    chapters: str
    colour: str


IDEAS = {
    "bend": Idea(0.9, 2.0, "a bent triad\n$A = I + M$", "01", VERMILION),
    "sigma": Idea(2.9, 2.8, "not square\n$\\Sigma$", "03, 07", VERMILION),
    "kappa": Idea(2.9, 1.2, "turned as a whole\n$\\kappa$", "03, 07", VERMILION),
    "drift": Idea(4.9, 2.8, "drift, turn by turn\n$\\rho = n^T M n$", "02, 03", VERMILION),
    "start": Idea(4.9, 1.2, "an attitude that\nstarts wrong", "07", VERMILION),
    "attitude": Idea(6.9, 2.0, "wrong attitude\n$\\varphi$", "01", VERMILION),
    "heading": Idea(8.9, 2.0, "wrong horizon,\nwrong heading", "09, 10, 11", VERMILION),
    "turns": Idea(2.9, 4.1, "whole turns\nmeasure $\\Sigma$", "04", GREEN),
    "filter": Idea(4.9, 4.1, "a Kalman filter\nmeasures nearly all", "08", GREEN),
    "computer": Idea(6.9, 4.1, "a better computer:\nCayley, Picard", "05, 06", GREEN),
    "log": Idea(8.9, 4.1, "a log, damping,\na careful alignment", "09, 10", GREEN),
    "earth": Idea(6.9, 0.1, "the Earth turns\nand is round", "04, 09, 10", BLUE),
    "noise": Idea(8.9, 0.1, "gyro bias\nand noise", "08, 09", ORANGE),
}
LEADS_TO = (
    ("bend", "sigma"), ("bend", "kappa"), ("sigma", "drift"), ("kappa", "start"),
    ("drift", "attitude"), ("start", "attitude"), ("attitude", "heading"),
    ("turns", "sigma"), ("filter", "drift"), ("computer", "attitude"), ("log", "heading"),
    ("earth", "attitude"), ("noise", "heading"),
)  # fmt: skip
WIDTH, HEIGHT = 1.56, 0.78
"""Of a box."""


@in_style
def draw(_: object, sheet: Sheet) -> Figure:
    """Boxes and arrows; red is what goes wrong, green what helps."""
    figure = Figure(figsize=(9.6, 4.9))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, 9.8), ylim=(-0.45, 4.65))
    axes.axis("off")
    for idea in IDEAS.values():
        corner = (idea.x - WIDTH / 2, idea.y - HEIGHT / 2)
        axes.add_patch(
            FancyBboxPatch(
                corner, WIDTH, HEIGHT, boxstyle="round,pad=0.02", linewidth=1.6,
                facecolor="white", edgecolor=idea.colour,
            )
        )  # fmt: skip
        axes.text(idea.x, idea.y + 0.08, idea.says, ha="center", va="center", color=BLACK)
        axes.text(idea.x, idea.y - 0.3, idea.chapters, ha="center", va="center", fontsize=8)
    for cause, effect in LEADS_TO:
        start, end = IDEAS[cause], IDEAS[effect]
        if start.x == end.x:
            side = 1 if end.y > start.y else -1
            ends = ((start.x, start.y + side * HEIGHT / 2), (end.x, end.y - side * HEIGHT / 2))
        else:
            ends = ((start.x + WIDTH / 2, start.y), (end.x - WIDTH / 2, end.y))
        axes.add_patch(
            FancyArrowPatch(
                *ends, arrowstyle="-|>", mutation_scale=11, color=start.colour, shrinkA=3, shrinkB=4
            )
        )
    return figure
