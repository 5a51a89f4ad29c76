"""The other half of the trade: vibration against the sample rate, rounding and noise."""

from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond, degree, hour

from driftlab.attitude.coning_algorithms import Algorithm, AnyAlgorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.integration import integrate
from driftlab.checks import FloatArray
from driftlab.quaternion import conjugate, multiply, to_rotation_vector

from .coning import BRACKET
from .four_samples import COMPARED
from .rounding import rounded

SAMPLES_A_ROUND: FloatArray = np.geomspace(1.05, 100, 240)
"""Abscissa of the band width, samples in one round of the cone."""
FLOOR_RATES: FloatArray = np.array([20.0, 30, 50, 75, 100, 150, 200, 300, 400])
"""Sample rates of the floors, Hz."""
FLOOR_SECONDS = 60.0
"""After which the floors are read, s."""
QUANTUM = 1.0 * arcsecond
"""Last digit of the gyros, rad."""
ANGLE_RANDOM_WALK = 0.003 * degree / np.sqrt(hour)
"""White noise of good gyros, rad/√s."""
RUNS = 12
"""Runs with other remainders at the start."""


class NoiseAndBand(NamedTuple):
    """Share of the coning that is missed, and errors after `FLOOR_SECONDS` on the bracket.

    Attributes
    ----------
    missed : dict of ndarray, shape (m,)
        By algorithm: `missed_part` at `SAMPLES_A_ROUND`, without sign.
    drifted : dict of ndarray, shape (n,)
        By algorithm: error from coning at `FLOOR_RATES`, rad.
    cut_off, carried : ndarray, shape (n,)
        Error of `two-step-4` from rounding alone: the remainder is lost, or it is carried over to
        the next increment. Root mean square of `RUNS` runs, about the axis of the cone, rad.
    """

    missed: dict[str, FloatArray]
    drifted: dict[str, FloatArray]
    cut_off: FloatArray
    carried: FloatArray


def missed_part(algorithm: Algorithm, samples_a_round: FloatArray) -> FloatArray:
    """Part of a narrow cone's coning that an algorithm misses.

    Parameters
    ----------
    algorithm : Algorithm
    samples_a_round : ndarray, shape (...)

    Returns
    -------
    ndarray, shape (...)
        Drift over the whole rate of coning, negative if too little is corrected.
    """
    x = 2 * np.pi / samples_a_round
    step = algorithm.samples * x
    found = sum(
        weight * 4 * np.sin(x / 2) ** 2 * np.sin((j - i) * x)
        for (i, j), weight in algorithm.coning.items()
    )
    return (found - (step - np.sin(step)) / 2) / (step / 2)


def rounding_error(
    algorithm: AnyAlgorithm,
    rate: float,
    *,
    carry: bool,
    seconds: float = FLOOR_SECONDS,
    runs: int = RUNS,
) -> FloatArray:
    """Errors about the axis of the bracket's cone that rounding by `QUANTUM` makes.

    Parameters
    ----------
    algorithm : str or Algorithm or FunctionalIteration or callable
        As for `driftlab.attitude.integrate`.
    rate : float
        Sample rate, Hz.
    carry : bool
        As in `rounded`.
    seconds : float
        After which the error is read, s.
    runs : int
        Each begins with another remainder in the counter. Without a carry all are alike.

    Returns
    -------
    ndarray, shape (runs,)
        rad.
    """
    start = np.random.default_rng(6).uniform(0, QUANTUM, (runs, 3))
    true, first = BRACKET.increments(1 / rate, int(rate * seconds)), BRACKET.attitude(0.0)
    exact = integrate(true, algorithm, start=first)[-1]
    counted = rounded(true, QUANTUM, start, carry=carry)
    found = integrate(counted, algorithm, start=first)[..., -1, :]
    return to_rotation_vector(multiply(found, conjugate(exact)))[..., 2]


def carried_floor(rate: FloatArray, quantum: float) -> FloatArray:
    """What rounding with a carry is expected to leave on the bracket after `FLOOR_SECONDS`, rad.

    Rounding stands in the sums at the start and at the end. Between, each sum is off by a part of
    the last digit, with a standard deviation of its twelfth's root; it counts by how far the
    cone's axis moves in the body in a sample, g. The motion repeats, and so does its rounding: each
    of n values comes back in each of R rounds, and in each once on the way there and once on the
    way back. So the errors add up as R√(2n), and not as the root of their number.

    Parameters
    ----------
    rate : ndarray, shape (...)
        Sample rate, Hz.
    quantum : float
        rad.

    Returns
    -------
    ndarray, shape (...)
    """
    samples = rate / BRACKET.frequency
    moved = 2 * np.sin(BRACKET.half_angle) * np.sin(np.pi / samples)
    rounds = BRACKET.frequency * FLOOR_SECONDS
    return quantum * np.sqrt((2 + 2 * samples * (rounds * moved) ** 2) / 12)


def noise_and_band() -> NoiseAndBand:
    """Compute the share of the coning that each algorithm misses, and the floors under it."""
    half_angle, frequency = BRACKET.half_angle, BRACKET.frequency
    shown = ("picard-1", "two-step-4", "rotation-vector-3", "four, spread")
    missed = {name: np.abs(missed_part(COMPARED[name], SAMPLES_A_ROUND)) for name in shown}
    drifted = {
        name: FLOOR_SECONDS
        * np.abs(coning_drift(COMPARED[name], half_angle, frequency, 1 / FLOOR_RATES))
        for name in shown
    }
    cut_off, carried = (
        [
            float(np.sqrt(np.mean(rounding_error("two-step-4", rate, carry=carry, runs=runs) ** 2)))
            for rate in FLOOR_RATES
        ]
        for carry, runs in ((False, 1), (True, RUNS))
    )
    return NoiseAndBand(missed, drifted, np.array(cut_off), np.array(carried))
