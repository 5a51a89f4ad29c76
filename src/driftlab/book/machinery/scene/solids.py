"""Things to put on a stage: blocks, arrows, circles, a globe, a ship on the sea."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray
from driftlab.vectors import direction_from_angles

from .stage import GROUND, Part

FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Corners of a box's faces, counter-clockwise from outside; corner 4 i + 2 j + k."""
EDGES = tuple((i, j) for i in range(8) for j in range(i) if (i ^ j) in (1, 2, 4))
"""Pairs of corners of a box's edges."""

ABOVE = {"azimuth": -90.0, "elevation": 90.0}
"""From where a plane is seen with its first axis to the right and its second one up."""


def in_plane(points: FloatArray) -> FloatArray:
    """Points (..., 3) in space from points (..., 2) in the plane of the first two axes."""
    return np.concatenate([points, np.zeros((*points.shape[:-1], 1))], axis=-1)


def box_corners(half_sizes: ArrayLike) -> FloatArray:
    """Corners (8, 3) of a box about the origin with half sizes (3,)."""
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1], indexing="ij")).reshape(3, -1).T
    return signs * np.asarray(half_sizes, float)


def box(half_sizes: ArrayLike, style: str, track: str = "") -> tuple[Part, ...]:
    """Return a solid box: six faces, of which the reader sees those that look at them."""
    corners = box_corners(half_sizes)
    return tuple(Part("face", corners[list(face)], style, track) for face in FACES)


def frame_of_box(half_sizes: ArrayLike, style: str, track: str = "") -> tuple[Part, ...]:
    """Return the twelve edges of a box, which can be looked through."""
    corners = box_corners(half_sizes)
    return tuple(Part("line", corners[list(edge)], style, track) for edge in EDGES)


def arrow(tip: ArrayLike, style: str, track: str = "", text: str = "") -> tuple[Part, ...]:
    """Return an arrow from the origin, with its name behind its tip if there is one."""
    tip = np.asarray(tip, float)
    parts = (Part("arrow", np.stack([np.zeros_like(tip), tip], axis=-2), style, track),)
    if not text:
        return parts
    return (*parts, Part("label", 1.12 * tip[..., np.newaxis, :], style, track, text=text))


def pin(
    tip: ArrayLike, style: str, track: str = "", text: str = "", handle: str = ""
) -> tuple[Part, ...]:
    """Return a line from the origin (3,) that ends in a dot, which can be a handle."""
    tip = np.asarray(tip, float)
    parts = (
        Part("line", np.stack([np.zeros(3), tip]), style, track),
        Part("dot", tip[np.newaxis], style, track, handle=handle),
    )
    if not text:
        return parts
    return (*parts, Part("label", 1.14 * tip[np.newaxis], style, track, text=text))


def circle(normal: ArrayLike, radius: float = 1.0, height: float = 0.0) -> FloatArray:
    """Points (73, 3) of a circle about the axis `normal` (3,), at a height along it, closed."""
    n = np.asarray(normal, float)
    n = n / np.linalg.norm(n)
    first = np.cross(n, np.eye(3)[np.abs(n).argmin()])
    first /= np.linalg.norm(first)
    angle = np.linspace(0, 2 * np.pi, 73)[:, np.newaxis]
    around = np.cos(angle) * first + np.sin(angle) * np.cross(n, first)
    return radius * around + height * n


def globe(colours: list[list[str]], style: str = "globe", radius: float = 1.0) -> tuple[Part, ...]:
    """Return the faces of a globe, row by row from the South pole, columns from -180° eastwards."""
    rows, columns = len(colours), len(colours[0])
    elevation = np.linspace(-np.pi / 2, np.pi / 2, rows + 1)
    azimuth = np.linspace(-np.pi, np.pi, columns + 1)
    corner = radius * direction_from_angles(*np.meshgrid(azimuth, elevation))
    return tuple(
        Part(
            "face",
            np.array([corner[i, j], corner[i, j + 1], corner[i + 1, j + 1], corner[i + 1, j]]),
            style,
            fill=colours[i][j],
        )
        for i in range(rows)
        for j in range(columns)
    )


HULL = np.array([[-0.15, -0.5], [0.15, -0.5], [0.17, 0.12], [0.0, 0.62], [-0.17, 0.12]])
"""Outline (5, 2) of a ship's deck, to the right and forward, counter-clockwise from above."""


def ship(track: str = "") -> tuple[Part, ...]:
    """Return a ship that floats on the plane z = 0, its bow along y: hull, bridge and mast.

    The bridge stands in the middle, so that what is nearer to the reader is drawn later from
    wherever he looks.
    """
    deck, line = np.full((5, 1), 0.16), np.zeros((5, 1))
    above, below = np.hstack([HULL, deck]), np.hstack([0.85 * HULL, line])
    sides = [
        Part("face", np.array([below[i - 1], below[i], above[i], above[i - 1]]), "hull", track)
        for i in range(5)
    ]
    bridge = box_corners((0.09, 0.14, 0.08)) + np.array([0.0, 0.0, 0.24])
    return (
        *sides,
        Part("face", above, "hull", track),
        *(Part("face", bridge[list(face)], "hull", track) for face in FACES),
        Part("line", np.array([[0.0, 0.0, 0.32], [0.0, 0.0, 0.8]]), "hull", track),
    )


def compass_card(radius: float, style: str, track: str = "") -> tuple[Part, ...]:
    """Return a ring with marks all 30 degrees, its North along y; a longer one at each quarter."""
    marks = []
    for i in range(12):
        outward = direction_from_angles(np.radians(30.0 * i), 0.0)
        inner = (0.88 if i % 3 == 0 else 0.94) * radius
        marks.append(Part("line", np.stack([inner * outward, radius * outward]), style, track))
    return (Part("line", circle([0.0, 0.0, 1.0], radius), style, track), *marks)


def sea(radius: float) -> tuple[Part, ...]:
    """Return a disc of water on the plane z = 0, with East along x and North along y."""
    letters = {"N": (0.0, 1.0), "E": (1.0, 0.0), "S": (0.0, -1.0), "W": (-1.0, 0.0)}
    return (
        Part("face", circle([0.0, 0.0, 1.0], radius)[:-1], "sea", lift=GROUND),
        *(
            Part("label", 1.07 * radius * np.array([[*place, 0.0]]), "letter", text=letter)
            for letter, place in letters.items()
        ),
    )


def raised(parts: Iterable[Part], height: float) -> tuple[Part, ...]:
    """Return parts higher by `height`; what turns about another axis than Up must not be raised."""
    return tuple(replace(part, points=part.points + np.array([0, 0, height])) for part in parts)
