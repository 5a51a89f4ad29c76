"""The frames of the book, each with the sign of a positive angle."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from scipy.spatial.transform import Rotation

from driftlab.book.machinery.picture import (
    BLACK,
    BLUE,
    VERMILION,
    Picture,
    plain_axes,
    project,
)
from driftlab.checks import FloatArray

APPARENT_ANGLE = 0.35
"""Angle from R to B in the drawing, rad; far larger than a real one."""


class Arrows(NamedTuple):
    """Three arrows from the origin."""

    labels: tuple[str, str, str]
    tips: FloatArray  # (3, 3), rows in drawing coordinates East, North, Up


class Arc(NamedTuple):
    """A positive rotation."""

    label: str
    points: FloatArray  # (m, 3)


class Frame(NamedTuple):
    """One panel: arrows, a second dashed set if there is one, and arcs."""

    title: str
    arrows: Arrows
    turned: Arrows | None
    arcs: list[Arc]


def compute() -> list[Frame]:
    """Larin's R and B; Wu's East-North-Up; Plotnikov's North-Up-East."""
    east, north, up = np.eye(3)
    apparent = _rotation(up, APPARENT_ANGLE).apply(np.eye(3))
    return [
        Frame(
            "Larin: body R, apparent B",
            Arrows(("$i_1$", "$i_2$", "$i_3$"), np.eye(3)),
            Arrows(("$1_B$", "$2_B$", ""), apparent),
            [Arc(r"$\lambda_e$", _arc(up, east, APPARENT_ANGLE, 0.65))],
        ),
        Frame(
            "Wu: 1 East, 2 North, 3 Up",
            Arrows(("East", "North", "Up"), np.eye(3)),
            None,
            [Arc("about Up", _arc(up, east)), Arc("about East", _arc(east, north, radius=0.75))],
        ),
        Frame(
            "Plotnikov: 1 North, 2 Up, 3 East",
            Arrows(("North", "Up", "East"), np.array([north, up, east])),
            None,
            [Arc("heading", _arc(up, north)), Arc("pitch", _arc(east, north, radius=0.75))],
        ),
    ]


def _rotation(axis: FloatArray, angle: float | FloatArray) -> Rotation:
    return Rotation.from_rotvec(np.multiply.outer(angle, axis))


def _arc(
    axis: FloatArray, start: FloatArray, angle: float = 1.2, radius: float = 0.5
) -> FloatArray:
    return radius * _rotation(axis, np.linspace(0, angle, 30)).apply(start)


class FramesPicture(Picture[list[Frame]]):
    """One panel a frame; drawn once, for the page only."""

    size = (10.0, 2.7)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.01, 0.01, 0.99, 0.88, wspace=0.05)
        for panel in self.panels:
            plain_axes(panel, 1.3)
            panel.set_ylim(-0.5, 1.25)

    def update(self, data: list[Frame]) -> None:
        for panel, frame in zip(self.panels, data, strict=True):
            panel.set_title(frame.title)
            draw_arrows(panel, frame.arrows, color=BLACK)
            if frame.turned:
                draw_arrows(panel, frame.turned, color=VERMILION, linestyle="--")
            for arc in frame.arcs:
                flat = project(arc.points)
                panel.plot(*flat[:-3].T, color=BLUE)
                _arrow(panel, flat[-6], flat[-1], color=BLUE)
                x, y = 1.15 * flat[len(flat) // 2] + [0, 0.05]
                side = "left" if x > 0 else "right"
                panel.text(x, y, arc.label, ha=side, va="center")


def draw_arrows(panel: Axes, arrows: Arrows, **style: str) -> None:
    """Draw three labelled arrows in a projected panel."""
    for label, tip in zip(arrows.labels, project(arrows.tips), strict=True):
        _arrow(panel, np.zeros(2), tip, **style)
        panel.text(1.13 * tip[0], 1.13 * tip[1], label, ha="center", va="center")


def _arrow(panel: Axes, tail: FloatArray, tip: FloatArray, **style: str) -> None:
    arrow = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0, "mutation_scale": 12, **style}
    panel.annotate("", tuple(tip), tuple(tail), arrowprops=arrow)
