"""The Riccati equation integrated through whole turns, with and without the shadow switch."""

from typing import NamedTuple

import numpy as np

from driftlab.attitude.cayley import rotation_quaternion, shadow
from driftlab.attitude.riccati import SWITCH, RiccatiSolution, integrate_riccati, riccati_rate
from driftlab.checks import (
    FloatArray,
    positive_number,
    whole_number,
)
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

TURNS = 3
STEPS = 200
"""Steps a turn of the integrator with a fixed step."""
MISSES = (float(np.radians(3.0)), float(np.radians(0.1)))
"""How far from a whole turn the attitude passes at the end of the first turn, rad."""
TOLERANCES = (1e-5, 1e-7, 1e-9, 1e-11)
"""Of the integrator with a variable step."""


class RiccatiTurns(NamedTuple):
    """The Riccati equation over some turns; times in s, the body turns once a second."""

    miss: float  # how far the attitude passes from a whole turn, rad; the first of `misses`
    ended: RiccatiSolution  # about a fixed axis, without the shadow switch
    plain: RiccatiSolution  # past the singularity by `miss`, without the switch
    switched: RiccatiSolution  # the same with the switch
    fixed_times: FloatArray  # (f,), of the integrator with a fixed step, s
    fixed_errors: FloatArray  # (2, f), its error of attitude, without the switch and with it, rad
    misses: FloatArray  # (n,), rad
    # (2, n, tolerance), of the rate, by an integrator with a variable step, without the switch and
    # with it
    evaluations: FloatArray
    worst: FloatArray  # (2, n, tolerance), its largest error of attitude, rad
    turns: int
    steps: int  # a turn, of the integrator with a fixed step


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

    With and without the shadow switch; with a fixed step, and with a variable one. There are one or
    two distances.
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
