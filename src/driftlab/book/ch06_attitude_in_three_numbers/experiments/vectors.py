"""Cayley vectors of all rotations, and the shadow that a computer steps over to."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from driftlab.attitude.cayley import cayley_vector
from driftlab.attitude.riccati import SWITCH
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import OBLIQUE_AXIS
from driftlab.checks import FloatArray, finite_array, nonzero_vectors
from driftlab.quaternion import from_rotation_vector

ANGLES: FloatArray = np.radians(np.arange(-359.5, 360.0, 1.0))
"""Angles of the curves, rad: every one a little away from the singular ones."""
EXAMPLE = 130.0
"""Angle of the rotation in the published figure, and when the panel opens, degrees."""
REACH = 4.0
"""Longest vector that the picture shows."""
VECTORS = {"dimension 3": (1, 3), "dimension 4": (1, 4), "shadow": (-1, 4)}
"""Each is that of the quaternion times a sign, and of a dimension."""
MOMENTS = 361  # of two turns


def cayley_map(
    angle: float = float(np.radians(EXAMPLE)), axis: ArrayLike = OBLIQUE_AXIS
) -> DataTable:
    """Both Cayley vectors of one rotation, and those of all angles; (1.2), (1.3)."""
    direction, _ = nonzero_vectors(axis, "axis")
    phi = float(finite_array(angle, "angle"))
    if abs(phi) > 2 * np.pi:
        raise ValueError(f"angle: expected at most a whole turn either way, got {angle!r} rad.")
    away = np.array([abs(abs(phi) - np.pi), 2 * np.pi - abs(phi), abs(phi)])
    # In the middle of rounding errors, a singular angle is the singular angle.
    marks = [
        _along(name, np.array([phi]), direction) if distance > 1e-9 else [np.nan]
        for name, distance in zip(VECTORS, away, strict=True)
    ]
    curves = np.stack([_along(name, ANGLES, np.array([0.0, 0.0, 1.0])) for name in VECTORS])
    # Gaps where they are far outside the picture, on their way through infinity.
    curves = np.where(np.abs(curves) < 2 * REACH, curves, np.nan)
    names = [*VECTORS]
    return DataTable(
        {
            "angles": (ANGLES, "deg", "angle of a rotation"),
            "component": (curves, "", "component of its vector along the axis", names),
            "mark_angle": ([phi], "deg", "angle of one rotation"),
            "mark": (np.array(marks), "", "component of its vector; none if it is infinite", names),
        },
        {
            "angle": (phi, "deg", "angle of the marks"),
            "axis": (direction, "", "unit axis"),
            "away": (away, "deg", "to the nearest angle where each vector is infinite"),
            "turned": (
                Rotation.from_rotvec(phi * direction).as_matrix().T, "",
                "turned body axes in the reference frame, as rows",
            ),
        },
    )  # fmt: skip


def _along(name: str, angles: FloatArray, axis: FloatArray) -> FloatArray:
    """Component (m,) along the unit axis of one of the `VECTORS` of rotations by some angles."""
    sign, dimension = VECTORS[name]
    rotations = from_rotation_vector(angles[:, np.newaxis] * axis)
    return cayley_vector(sign * rotations, dimension) @ axis


def shadow_steps(axis: ArrayLike, switch: float = SWITCH) -> DataTable:
    """Follow a Cayley vector and its shadow through two turns; (1.3), (1.9).

    The switch is the length at which a computer changes to the shadow, at least 1; it may be
    infinite.
    """
    if not switch >= 1:
        raise ValueError(f"switch: expected a length of at least 1, got {switch!r}.")
    direction, _ = nonzero_vectors(axis, "axis")
    angle = np.linspace(0.0, 4 * np.pi, MOMENTS)
    attitude = from_rotation_vector(angle[:, np.newaxis] * direction)
    heights = np.full((2, len(angle)), np.nan)
    for row, quaternion in zip(heights, (attitude, -attitude), strict=True):
        finite = 1 + quaternion[:, 3] > 1e-9
        row[finite] = -cayley_vector(quaternion[finite]) @ direction
    lengths, switches = np.abs(heights), np.isfinite(switch)
    used = np.zeros(len(angle), int)
    for moment, both in enumerate(lengths.T if switches else ()):
        now = used[moment - 1] if moment else 0
        used[moment] = now if both[now] <= switch else 1 - now
    steps = 4 * np.arctan(switch) + 2 * np.pi * np.arange(2 if switches else 0)
    return DataTable(
        {
            "angle": (angle, "deg", "phi, through two turns"),
            # NaN where infinite
            "heights": (heights, "", "tan(phi/4) of the quaternion and of that with the other sign",
                        ("vector", "shadow")),
            "in_use": (lengths[used, np.arange(len(used))], "", "length of the vector in use"),
        },
        {
            "axis": (direction, "", "unit axis"),
            "attitude": (attitude, "", "quaternion: minus one after a turn, one again after two"),
            "used": (used, "", "row of the heights in use: the other as soon as it is too long"),
            "switch": (switch, "", "longest length in use"),
            "steps": (steps, "deg", "angles at which the computer steps over, once a turn"),
        },
    )  # fmt: skip
