"""The Riccati equation integrated through whole turns, with and without the shadow switch."""

from typing import NamedTuple

import numpy as np

from driftlab.attitude.cayley import rotation_quaternion, shadow
from driftlab.attitude.riccati import SWITCH, RiccatiSolution, integrate_riccati, riccati_rate
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

TURNS = 3
STEPS = 200
"""Steps a turn of the integrator with a fixed step."""
MISSES = (float(np.radians(3.0)), float(np.radians(0.1)))
"""How far from a whole turn the attitude passes at the end of the first turn, rad."""
TOLERANCES = (1e-5, 1e-7, 1e-9, 1e-11)
"""Of the integrator with a variable step."""
WAYS = ("fixed axis, no switch", "near miss, no switch", "near miss, with switch")
"""Of integrating."""


SPIN: FloatArray = np.array([0.0, 0.0, 2 * np.pi])
"""Of the body, in its own axes, rad/s."""


class _TwoSpins(NamedTuple):
    """Steady rotation about axis 3 of a body that is mounted on a slowly tumbling table.

    After one turn the table has tumbled by `miss`, and the attitude is that far from the turn.
    """

    miss: float  # rate of the table about axis 1 of the reference frame, rad/s

    def attitude(self, time: FloatArray) -> FloatArray:
        tumble = np.array([self.miss, 0.0, 0.0])
        about = [from_rotation_vector(time[..., np.newaxis] * w) for w in (tumble, SPIN)]
        return multiply(*about)

    def rate(self, time: float) -> FloatArray:
        """Spin and tumble in body axes; both are normal to each other."""
        angle = time * SPIN[2]
        return SPIN + self.miss * np.array([np.cos(angle), -np.sin(angle), 0.0])


def riccati_turns(
    misses: tuple[float, ...] = MISSES,
    turns: int = TURNS,
    steps: int = STEPS,
    tolerances: tuple[float, ...] = TOLERANCES,
) -> DataTable:
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
    times = np.linspace(0.0, count, 40 * count + 1)

    def solve(
        miss: float, switch: bool, tolerance: float = 1e-9, times: FloatArray = times
    ) -> RiccatiSolution:
        rate = _TwoSpins(miss).rate
        return integrate_riccati(rate, times, shadow_switch=switch, tolerance=tolerance)

    # Few times, as they limit the step.
    few = times[::10]
    work, worst = np.empty((2, 2, len(distances), len(limits)))
    for i, j, k in np.ndindex(work.shape):
        found = solve(distances[j], bool(i), limits[k], few)
        work[i, j, k] = found.evaluations
        worst[i, j, k] = _error(_TwoSpins(distances[j]), found.time, found.attitude).max()
    miss, motion = distances[0], _TwoSpins(distances[0])
    moments = np.linspace(0.0, count, fixed_steps * count + 1)
    by_steps = [_fixed_step(motion, moments, switch) for switch in (False, True)]
    fixed = np.array([_error(motion, moments, attitude) for attitude in by_steps])
    answers = (solve(0.0, False), solve(miss, False), solve(miss, True))
    lengths = [(each.time, np.linalg.norm(each.vector, axis=-1)) for each in answers]
    given_up, longest = (each[-1] for each in lengths[0])
    curves = {f"|k| {way}, over turns": each for way, each in zip(WAYS, lengths, strict=True)}
    curves["|k| given up, over turns"] = np.array([given_up]), np.array([longest])
    for way, error in zip(WAYS[1:], fixed, strict=True):
        curves[f"fixed step, {way}, rad over turns"] = moments[1:], error[1:]
    for i, name in enumerate(("no switch", "with switch")):
        for j, m in enumerate(distances):
            title = f"variable step, {np.degrees(m):.3g}°, {name}, rad over evaluations"
            curves[title] = work[i, j], worst[i, j]
    x, y = (np.concatenate(each) for each in zip(*curves.values(), strict=True))
    return DataTable(
        {
            "curve": ([name for name, (each, _) in curves.items() for _ in each], "", "what y is"),
            "x": (x, "", "turns, or evaluations of the rate"),
            "y": (y, "", "length of the vector k, or error of the attitude in rad"),
        },
        {
            "miss": (miss, "deg", "passes the singular attitude at"),
            "given_up": (given_up, "", "turns about a fixed axis, without the switch"),
            "longest": (longest, "", "length of k then"),
            # (2, f), without the switch and with it
            "fixed_errors": (fixed, "rad", "errors of attitude with a fixed step"),
            "misses": (np.array(distances), "deg", "all distances"),
            # (2, distance, tolerance), likewise
            "evaluations": (work, "", "of the rate, with a variable step"),
            "worst": (worst, "rad", "largest errors of attitude with a variable step"),
            "turns": (count, "", "turns"),
            "steps": (fixed_steps, "", "fixed steps per turn"),
        },
    )


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
