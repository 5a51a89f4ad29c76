"""Other starts that may have been meant: other meanings of four numbers, or another heading."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from driftlab.checks import FloatArray
from driftlab.core import quaternion

from ._contradictions import Evidence, Expected

_UP = np.array([0.0, 0.0, 1.0])
_FRAMES = {
    "North, East, Down": np.array([1.0, 1.0, 0.0, 0.0]) / np.sqrt(2),
    "North, Up, East": np.array([0.5, 0.5, 0.5, 0.5]),
}
"""Other local axes, as quaternions from them to East, North, Up."""


def other_starts(start: FloatArray) -> Iterator[tuple[str, FloatArray]]:
    """Other meanings of four numbers; those that come to the same together."""
    rolled = np.roll(start, -1)
    meanings = {
        "scalar first": rolled,
        "from East, North, Up to the body": quaternion.conjugate(start),
        "scalar first, and from East, North, Up to the body": quaternion.conjugate(rolled),
    } | {f"body to {name}": quaternion.multiply(turn, start) for name, turn in _FRAMES.items()}
    known: list[tuple[list[str], FloatArray]] = []
    for name, other in meanings.items():
        if abs(float(start @ other)) > 1 - 1e-6:
            continue
        for names, one in known:
            if abs(float(one @ other)) > 1 - 1e-6:
                names.append(name)
                break
        else:
            known.append(([name], other))
    for names, other in known:
        yield f"start: {', or '.join(names)}", other


def levelled(start: FloatArray, shown: Evidence) -> FloatArray:
    """The start, turned so that the force of the first window points up."""
    force = quaternion.rotate(start, shown.force[0])
    axis = np.cross(force, _UP)
    across = float(np.linalg.norm(axis))
    angle = float(np.arctan2(across, force[2]))
    return quaternion.multiply(
        quaternion.from_rotation_vector(angle / max(across, 1e-12) * axis), start
    )


def headed(start: FloatArray, shown: Evidence, latitude: float, expected: Expected) -> FloatArray:
    """The start with the heading that fits best."""
    turns = quaternion.from_rotation_vector(
        np.radians(np.arange(-178, 181, 2))[:, np.newaxis] * _UP
    )
    starts = quaternion.multiply(turns, start)
    return starts[np.argmin(shown.misfit(starts[:, np.newaxis], latitude, expected))]
