"""The frames of the four papers as arrows and arcs in one set of coordinates."""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.checks import FloatArray

APPARENT_ANGLE = 0.35
"""Angle from R to B as shown, rad; far larger than a real one."""


class Arrows(NamedTuple):
    """Three arrows from the origin."""

    labels: tuple[str, str, str]
    tips: FloatArray  # (3, 3), rows in the coordinates East, North, Up


class Arc(NamedTuple):
    """A positive rotation."""

    label: str
    # (m, 3), from the start of the rotation to its end, in the coordinates East, North, Up
    points: FloatArray


class Frame(NamedTuple):
    """One frame of reference, or a pair of them."""

    title: str
    arrows: Arrows  # the axes
    turned: Arrows | None  # the axes of a second frame that is turned from the first
    arcs: list[Arc]  # the sign of a positive angle


def paper_frames() -> list[Frame]:
    """Return Larin's R and B, Wu's East-North-Up, and Plotnikov's North-Up-East."""
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
