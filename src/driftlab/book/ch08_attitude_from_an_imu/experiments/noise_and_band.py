"""The other half of the trade: vibration against the sample rate, rounding and noise."""

import numpy as np
from scipy.constants import arcsecond, degree, hour
from scipy.special import factorial, factorial2

from driftlab.attitude.coning_algorithms import Algorithm, AnyAlgorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.integration import integrate
from driftlab.book.ch07_coning.experiments import BRACKET
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.motion.profiles import Coning
from driftlab.quaternion import conjugate, multiply, to_rotation_vector

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
FINE_RATES: FloatArray = np.geomspace(18, 450, 120)
"""Sample rates of the curves, Hz."""
SHOWN = ("picard-1", "two-step-4", "rotation-vector-3", "four, spread")
"""Of `COMPARED`, the best of one, two, three and four samples."""
RUNS = 12
"""Runs with other remainders at the start."""


def missed_part(algorithm: Algorithm, samples_a_round: FloatArray) -> FloatArray:
    """Part of a narrow cone's coning rate left as drift, negative if too little is corrected."""
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
    cone: Coning = BRACKET,
    quantum: float = QUANTUM,
    seconds: float = FLOOR_SECONDS,
    runs: int = RUNS,
    seed: int = 6,
) -> FloatArray:
    """Errors (runs,) about the axis of a cone that rounding of the increments makes, rad.

    With a carry each run begins with another remainder in the counter; without it all are alike.
    """
    start = np.random.default_rng(seed).uniform(0, quantum, (runs, 3))
    # An even number, for steps of two samples.
    true, first = cone.increments(1 / rate, 2 * int(rate * seconds / 2)), cone.attitude(0.0)
    exact = integrate(true, algorithm, start=first)[-1]
    counted = rounded(true, quantum, start, carry=carry)
    found = integrate(counted, algorithm, start=first)[..., -1, :]
    return to_rotation_vector(multiply(found, conjugate(exact)))[..., 2]


def carried_floor(
    rate: FloatArray, quantum: float, cone: Coning = BRACKET, seconds: float = FLOOR_SECONDS
) -> FloatArray:
    """What rounding with a carry is expected to leave on a cone after some time, rad.

    Rounding stands in the sums at the start and at the end. Between, each sum is off by a part of
    the last digit, with a standard deviation of its twelfth's root; it counts by how far the cone's
    axis moves in the body in a sample, g. The motion repeats, and so does its rounding: each of n
    values comes back in each of R rounds, and in each once on the way there and once on the way
    back. So the errors add up as R√(2n), and not as the root of their number.
    """
    samples = rate / cone.frequency
    moved = 2 * np.sin(cone.half_angle) * np.sin(np.pi / samples)
    rounds = cone.frequency * seconds
    return quantum * np.sqrt((2 + 2 * samples * (rounds * moved) ** 2) / 12)


def noise_and_band(
    half_angle: float = BRACKET.half_angle,
    frequency: float = BRACKET.frequency,
    quantum: float = QUANTUM,
    angle_random_walk: float = ANGLE_RANDOM_WALK,
    seconds: float = FLOOR_SECONDS,
    runs: int = RUNS,
    seed: int = 6,
) -> DataTable:
    """Compute the share of the coning that each algorithm misses, and the floors under it."""
    cone = Coning(
        positive_number(half_angle, "half_angle"), positive_number(frequency, "frequency")
    )
    digit, time = positive_number(quantum, "quantum"), positive_number(seconds, "seconds")
    walk = positive_number(angle_random_walk, "angle_random_walk")
    count = whole_number(runs, "runs")
    shown = {name: COMPARED[name] for name in SHOWN}
    x, missed = 2 * np.pi / SAMPLES_A_ROUND, {}
    for name, one in shown.items():
        missed[name] = np.abs(missed_part(one, SAMPLES_A_ROUND))
        missed[f"{name}, first term"] = first_term(one.samples, x)

    def drift(rates: FloatArray) -> dict[str, FloatArray]:
        return {
            name: np.abs(coning_drift(one, cone.half_angle, cone.frequency, 1 / rates))
            for name, one in shown.items()
        }

    def rounding(carry: bool) -> FloatArray:
        """Root mean square of all runs as a drift, by sample rate, rad/s."""
        errors = [
            rounding_error(
                "two-step-4", rate, carry=carry, cone=cone, quantum=digit, seconds=time,
                runs=count if carry else 1, seed=seed,
            )
            for rate in FLOOR_RATES
        ]  # fmt: skip
        return np.sqrt(np.mean(np.square(errors), axis=-1)) / time

    expected = carried_floor(FINE_RATES, digit, cone, time) / time
    white = np.full(len(FINE_RATES), walk / np.sqrt(time))
    return DataTable(
        {
            "samples_a_round": (SAMPLES_A_ROUND, "", "samples in one round of a narrow cone"),
            "missed": (missed, "", "part of its coning, and the first term of the series"),
            "rate": (FLOOR_RATES, "Hz", "sample rate"),
            "rounding_lost": (rounding(False), "deg_per_h", "if the remainder is lost"),
            "rounding_carried": (rounding(True), "deg_per_h", "if it is carried over"),
            "curve_rate": (FINE_RATES, "Hz", "sample rate of the curves"),
            "rounding_carried_expected": (expected, "deg_per_h", "by the closed formula"),
            "white_noise": (white, "deg_per_h", "one standard deviation"),
            "drift": (drift(FINE_RATES), "deg_per_h", "size of the drift on the cone"),
        },
        {
            "half_angle": (cone.half_angle, "deg", "half angle of the cone"),
            "frequency": (cone.frequency, "Hz", "frequency of the cone"),
            "quantum": (digit, "arcsec", "last digit of the gyros"),
            "angle_random_walk": (walk, "deg_per_sqrt_h", "angle random walk of the gyros"),
            "seconds": (time, "s", "time after which errors are read"),
            "drift_at_rates": (drift(FLOOR_RATES), "deg_per_h", "at the rates of the marks"),
        },
    )


def first_term(samples: int, x: FloatArray) -> FloatArray:
    """First term of the part that is missed with so many samples a step, Ignagni's.

    The cone goes round by x (rad) in a sample.
    """
    m = samples
    return np.asarray(factorial(m) / (2.0**m * factorial2(2 * m + 1)) * x ** (2 * m))
