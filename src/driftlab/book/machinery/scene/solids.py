"""Things to put on a stage: blocks, arrows, circles, a globe."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray
from driftlab.vectors import direction_from_angles

from .stage import Part

FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Corners of a box's faces, counter-clockwise from outside; corner 4 i + 2 j + k."""
EDGES = tuple((i, j) for i in range(8) for j in range(i) if (i ^ j) in (1, 2, 4))
"""Pairs of corners of a box's edges."""


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
    """Return the faces of a globe, row by row from the South pole, columns from -180° eastwards.

    Parameters
    ----------
    colours : list of list of str
        Colour of each face.
    style : str
    radius : float
    """
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
