"""Cayley vectors of all rotations, and the shadow that a computer steps over to."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from driftlab.attitude.cayley import cayley_vector
from driftlab.attitude.riccati import SWITCH
from driftlab.book.scenarios import OBLIQUE_AXIS
from driftlab.checks import (
    FloatArray,
    finite_array,
    nonzero_vectors,
)
from driftlab.quaternion import from_rotation_vector

ANGLES: FloatArray = np.radians(np.arange(-359.5, 360.0, 1.0))
"""Angles of the curves, rad: every one a little away from the singular ones."""
EXAMPLE = 130.0
"""Angle of the rotation in the published figure, and when the panel opens, degrees."""
MOMENTS = 361  # of two turns


class CayleyMap(NamedTuple):
    """Cayley vectors of a rotation as components along its axis; None where one is infinite."""

    angle: float  # phi, rad
    axis: FloatArray  # (3,), unit axis
    along_3: float | None  # -tan(phi/2), of the vector of dimension 3
    along_4: float | None  # -tan(phi/4), of the vector of dimension 4
    # cot(phi/4), of the vector of dimension 4 of the quaternion with the other sign
    shadow: float | None
    distance_3: float  # to the nearest angle where the vector of dimension 3 is infinite, rad
    distance_4: float  # the same of dimension 4
    turned: FloatArray  # (3, 3), the turned body axes in the reference frame, as rows
    angles: FloatArray  # (m,), angles of the curves, rad
    curves: FloatArray  # (3, m), the three components over `angles`


def cayley_map(
    angle: float = float(np.radians(EXAMPLE)), axis: ArrayLike = OBLIQUE_AXIS
) -> CayleyMap:
    """Both Cayley vectors of one rotation, and those of all angles; (1.2), (1.3)."""
    direction, _ = nonzero_vectors(axis, "axis")
    phi = float(finite_array(angle, "angle"))
    if abs(phi) > 2 * np.pi:
        raise ValueError(f"angle: expected at most a whole turn either way, got {angle!r} rad.")
    # In the middle of rounding errors, a singular angle is the singular angle.
    distance_3 = abs(abs(phi) - np.pi)
    distance_4 = 2 * np.pi - abs(phi)
    quaternion = from_rotation_vector(phi * direction)
    return CayleyMap(
        phi,
        direction,
        _along(quaternion, direction, 3) if distance_3 > 1e-9 else None,
        _along(quaternion, direction, 4) if distance_4 > 1e-9 else None,
        _along(-quaternion, direction, 4) if abs(phi) > 1e-9 else None,
        distance_3,
        distance_4,
        Rotation.from_rotvec(phi * direction).as_matrix().T,
        ANGLES,
        cayley_curves(),
    )


def _along(quaternion: FloatArray, direction: FloatArray, dimension: int) -> float:
    return float(cayley_vector(quaternion, dimension) @ direction)


def cayley_curves() -> FloatArray:
    """Components (3, m) along the axis over `ANGLES`: dimension 3, dimension 4, its shadow."""
    axis = np.array([0.0, 0.0, 1.0])
    quaternions = from_rotation_vector(ANGLES[:, np.newaxis] * axis)
    return np.stack(
        [
            cayley_vector(quaternions, 3) @ axis,
            cayley_vector(quaternions, 4) @ axis,
            cayley_vector(-quaternions, 4) @ axis,
        ]
    )


class ShadowSteps(NamedTuple):
    """Cayley vectors of dimension 4 over two turns about an axis, and which of two is used."""

    angle: FloatArray  # (m,), phi, from 0 to 4 pi, rad
    axis: FloatArray  # (3,)
    attitude: FloatArray  # (m, 4), quaternion of phi: minus one after a turn, one again after two
    # (2, m), tan(phi/4) of the quaternion, and of the one with the other sign; NaN where infinite
    heights: FloatArray
    # (m,), row of `heights` in use: the other one as soon as it is longer than `switch`
    used: NDArray[np.integer]
    switch: float

    @property
    def vectors(self) -> FloatArray:
        """Cayley vectors (2, m, 3); NaN where infinite."""
        return -self.heights[..., np.newaxis] * self.axis

    @property
    def in_use(self) -> FloatArray:
        """Length (m,) of the vector that is used; NaN where infinite."""
        return np.abs(self.heights[self.used, np.arange(len(self.used))])

    @property
    def steps(self) -> FloatArray:
        """Angles (s,) at which the computer steps over, rad: once a turn, if it does."""
        turns = [0, 1] if np.isfinite(self.switch) else []
        return 4 * np.arctan(self.switch) + 2 * np.pi * np.array(turns, float)


def shadow_steps(axis: ArrayLike, switch: float = SWITCH) -> ShadowSteps:
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
    used = np.zeros(len(angle), int)
    for moment, lengths in enumerate(np.abs(heights).T if np.isfinite(switch) else ()):
        now = used[moment - 1] if moment else 0
        used[moment] = now if lengths[now] <= switch else 1 - now
    return ShadowSteps(angle, direction, attitude, heights, used, switch)
