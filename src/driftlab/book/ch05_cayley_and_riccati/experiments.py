"""Cayley vectors of all rotations, and the Riccati equation integrated through whole turns."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from driftlab.attitude.cayley import cayley_vector, rotation_quaternion, shadow
from driftlab.attitude.riccati import SWITCH, RiccatiSolution, integrate_riccati, riccati_rate
from driftlab.book.scenarios import OBLIQUE_AXIS
from driftlab.checks import (
    FloatArray,
    finite_array,
    nonzero_vectors,
    positive_number,
    whole_number,
)
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

ANGLES: FloatArray = np.radians(np.arange(-359.5, 360.0, 1.0))
"""Angles of the curves, rad: every one a little away from the singular ones."""
EXAMPLE = 130.0
"""Angle of the rotation in the published figure, and when the panel opens, degrees."""
MOMENTS = 361  # of two turns
TURNS = 3
STEPS = 200
"""Steps a turn of the integrator with a fixed step."""
MISSES = (float(np.radians(3.0)), float(np.radians(0.1)))
"""How far from a whole turn the attitude passes at the end of the first turn, rad."""
TOLERANCES = (1e-5, 1e-7, 1e-9, 1e-11)
"""Of the integrator with a variable step."""


class CayleyMap(NamedTuple):
    """Cayley vectors of a rotation as their component along the axis; None where one is infinite.

    Attributes
    ----------
    angle : float
        phi, rad.
    axis : ndarray, shape (3,)
        Unit axis.
    along_3 : float or None
        -tan(phi/2), of the vector of dimension 3.
    along_4 : float or None
        -tan(phi/4), of the vector of dimension 4.
    shadow : float or None
        cot(phi/4), of the vector of dimension 4 of the quaternion with the other sign.
    distance_3, distance_4 : float
        To the nearest angle where the vector of dimension 3, or 4, is infinite, rad.
    turned : ndarray, shape (3, 3)
        The turned body axes in the reference frame, as rows.
    angles : ndarray, shape (m,)
        Angles of the curves, rad.
    curves : ndarray, shape (3, m)
        The three components over `angles`.
    """

    angle: float
    axis: FloatArray
    along_3: float | None
    along_4: float | None
    shadow: float | None
    distance_3: float
    distance_4: float
    turned: FloatArray
    angles: FloatArray
    curves: FloatArray


def cayley_map(
    angle: float = float(np.radians(EXAMPLE)), axis: ArrayLike = OBLIQUE_AXIS
) -> CayleyMap:
    """Both Cayley vectors of one rotation, and those of all angles; (1.2), (1.3).

    Parameters
    ----------
    angle : float
        rad, from -2 pi to 2 pi.
    axis : array_like, shape (3,)
        Only its direction counts.
    """
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
    """Cayley vectors of dimension 4 over two turns about an axis, and which of two is used.

    Attributes
    ----------
    angle : ndarray, shape (m,)
        phi, from 0 to 4 pi, rad.
    axis : ndarray, shape (3,)
    attitude : ndarray, shape (m, 4)
        Quaternion of phi: minus one after a turn, one again after two.
    heights : ndarray, shape (2, m)
        tan(phi/4) of the quaternion, and of the one with the other sign; NaN where infinite.
    used : ndarray of int, shape (m,)
        Row of `heights` in use: the other one as soon as it is longer than `switch`.
    switch : float
    """

    angle: FloatArray
    axis: FloatArray
    attitude: FloatArray
    heights: FloatArray
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

    Parameters
    ----------
    axis : array_like, shape (3,)
        Only its direction counts.
    switch : float
        Length at which a computer steps over to the shadow, at least 1; it may be infinite.
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


class RiccatiTurns(NamedTuple):
    """The Riccati equation over some turns; times in s, the body turns once a second.

    Attributes
    ----------
    miss : float
        How far the attitude passes from a whole turn, rad; the first of `misses`.
    ended : RiccatiSolution
        About a fixed axis, without the shadow switch.
    plain, switched : RiccatiSolution
        Past the singularity by `miss`, without the switch and with it.
    fixed_times : ndarray, shape (f,)
        Of the integrator with a fixed step, s.
    fixed_errors : ndarray, shape (2, f)
        Its error of attitude, without the switch and with it, rad.
    misses : ndarray, shape (n,)
        rad.
    evaluations : ndarray, shape (2, n, tolerance)
        Of the rate, by an integrator with a variable step, without the switch and with it.
    worst : ndarray, shape (2, n, tolerance)
        Its largest error of attitude, rad.
    turns, steps : int
        Whole turns, and steps a turn of the integrator with a fixed step.
    """

    miss: float
    ended: RiccatiSolution
    plain: RiccatiSolution
    switched: RiccatiSolution
    fixed_times: FloatArray
    fixed_errors: FloatArray
    misses: FloatArray
    evaluations: FloatArray
    worst: FloatArray
    turns: int
    steps: int


class _TwoSpins(NamedTuple):
    """Steady rotation about axis 3 of a body that is mounted on a slowly tumbling table.

    `spin` (3,) is in body axes, `tumble` (3,) in the reference frame, both in rad/s.
    """

    spin: FloatArray
    tumble: FloatArray

    def attitude(self, time: FloatArray) -> FloatArray:
        about = [from_rotation_vector(time[..., np.newaxis] * w) for w in (self.tumble, self.spin)]
        return multiply(*about)

    def rate(self, time: float) -> FloatArray:
        """spin + tumble in body axes; both are normal to each other."""
        angle = time * self.spin[2]
        cosine, sine = np.cos(angle), np.sin(angle)
        return self.spin + self.tumble[0] * np.array([cosine, -sine, 0.0])


def riccati_turns(
    misses: tuple[float, ...] = MISSES,
    turns: int = TURNS,
    steps: int = STEPS,
    tolerances: tuple[float, ...] = TOLERANCES,
) -> RiccatiTurns:
    """Integrate (1.10) through some turns that pass the singular attitude at some distances.

    With and without the shadow switch; with a fixed step, and with a variable one.

    Parameters
    ----------
    misses : tuple of float
        One or two: how far from a whole turn the attitude passes at the end of the first turn, rad.
    turns : int
        Whole turns.
    steps : int
        A turn, of the integrator with a fixed step.
    tolerances : tuple of float
        Of the integrator with a variable step.
    """
    distances = [positive_number(each, "misses") for each in misses]
    if len(distances) not in (1, 2):
        raise ValueError(f"misses: expected one or two distances, got {len(distances)}.")
    limits = [positive_number(each, "tolerances") for each in tolerances]
    if not limits:
        raise ValueError("tolerances: expected one at least, got none.")
    count, fixed_steps = whole_number(turns, "turns"), whole_number(steps, "steps")
    spin = np.array([0.0, 0.0, 2 * np.pi])
    times = np.linspace(0.0, count, 40 * count + 1)

    def motion(miss: float) -> _TwoSpins:
        # After one turn the table has tumbled by miss, and the attitude is that far from the turn.
        return _TwoSpins(spin, np.array([miss, 0.0, 0.0]))

    def solve(
        miss: float, switch: bool, tolerance: float = 1e-9, times: FloatArray = times
    ) -> RiccatiSolution:
        rate = motion(miss).rate
        return integrate_riccati(rate, times, shadow_switch=switch, tolerance=tolerance)

    # Few times, as they limit the step.
    few = times[::10]
    trials = [
        [[(m, solve(m, switch, tolerance, few)) for tolerance in limits] for m in distances]
        for switch in (False, True)
    ]
    miss = distances[0]
    moments = np.linspace(0.0, count, fixed_steps * count + 1)
    fixed = [
        _error(motion(miss), moments, _fixed_step(motion(miss), moments, switch))
        for switch in (False, True)
    ]
    return RiccatiTurns(
        miss,
        solve(0.0, False),
        solve(miss, False),
        solve(miss, True),
        moments,
        np.array(fixed),
        np.array(distances),
        np.array([[[float(a.evaluations) for _, a in row] for row in rows] for rows in trials]),
        np.array([
            [[_error(motion(m), a.time, a.attitude).max() for m, a in row] for row in rows]
            for rows in trials
        ]),
        count,
        fixed_steps,
    )  # fmt: skip


def _fixed_step(motion: _TwoSpins, times: FloatArray, switch: bool) -> FloatArray:
    """Attitude (m, 4) up to its sign, by the classical Runge-Kutta method."""
    k, h = np.zeros(3), times[1] - times[0]
    vectors = [k]
    for time in times[:-1]:
        middle = motion.rate(time + h / 2)
        first = riccati_rate(k, motion.rate(time))
        second = riccati_rate(k + h / 2 * first, middle)
        third = riccati_rate(k + h / 2 * second, middle)
        fourth = riccati_rate(k + h * third, motion.rate(time + h))
        k = k + h / 6 * (first + 2 * second + 2 * third + fourth)
        if switch and k @ k > SWITCH**2:
            k = shadow(k)
        vectors.append(k)
    return rotation_quaternion(vectors)


def _error(motion: _TwoSpins, times: FloatArray, attitude: FloatArray) -> FloatArray:
    return rotation_angle(multiply(conjugate(motion.attitude(times)), attitude))
