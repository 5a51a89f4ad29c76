"""What the scenes of chapter 13 share: a box over a compass card, seen in East, North, Up."""

from __future__ import annotations

import numpy as np

from driftlab.book.machinery.scene.solids import circle
from driftlab.book.machinery.scene.stage import Part
from driftlab.checks import FloatArray
from driftlab.frames import FROM_EAST_NORTH_UP
from driftlab.quaternion import conjugate, rotate

HALF_SIZES = (0.5, 0.16, 0.32)
"""Of the box: forward, up, right."""
BOW = 0.8
"""How far the bow reaches."""
CARD = 1.25
"""Radius of the compass card."""
TO_SPACE = conjugate(FROM_EAST_NORTH_UP)
"""From North, Up, East to the axes of the views, whose third points up the page."""


def in_space(local: FloatArray) -> FloatArray:
    """Vectors (..., 3) in the axes of a view, from North, Up, East."""
    return rotate(TO_SPACE, local)


def level_direction(heading: FloatArray) -> FloatArray:
    """Unit vectors (n, 3) in a view from headings to West (n,), rad."""
    heading = np.atleast_1d(heading)
    return np.stack([-np.sin(heading), np.cos(heading), np.zeros_like(heading)], axis=-1)


def from_origin(tips: FloatArray) -> FloatArray:
    """Ends (n, 2, 3) of lines from the origin to tips (n, 3)."""
    return np.stack([np.zeros_like(tips), tips], axis=1)


def lettered_card(height: float) -> tuple[Part, ...]:
    """The rim of a card with the four directions and a mark each thirty degrees."""
    rim = circle((0, 0, 1), CARD, height)
    mark = np.array([[0.93], [1.0]])
    names = dict(zip("NWSE", level_direction(np.arange(4) * np.pi / 2), strict=True))
    # In short pieces, so that near ones hide what is behind.
    return (
        *(Part("line", rim[i : i + 4], "soft") for i in range(0, 72, 3)),
        *(Part("line", mark * rim[i], "soft") for i in range(0, 72, 6)),
        *(
            Part("label", np.array([0.84 * CARD * place + [0.0, 0.0, height]]), "soft", text=name)
            for name, place in names.items()
        ),
    )
