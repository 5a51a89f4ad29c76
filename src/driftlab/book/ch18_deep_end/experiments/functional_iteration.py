"""Functional iteration beside the algorithms with cross products: where it gains, where not."""

from collections.abc import Sequence
from math import lcm

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from driftlab.attitude.coning_algorithms import AnyAlgorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.functional_iteration import FunctionalIteration
from driftlab.attitude.integration import integrate
from driftlab.attitude.noise_amplification import NoiseGrowth
from driftlab.book.ch07_coning.experiments.algorithms import Algorithms, named_algorithms
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.core.functional_iteration import tables
from driftlab.motion.profiles import Coning
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    pure,
    rotate,
    rotation_angle,
    to_rotation_vector,
)
from driftlab.sampled_rates import increments_from_rates

WIDE_BRACKET = Coning(float(np.radians(10.0)), 5.0)
"""The bracket of the puzzle, tilted ten times as far."""
WIDE_BRACKET_RATE = 100.0
"""Sample rate on it, Hz."""
WINDOWS = (4, 8, 12, 20)
"""Increments in a window."""
BESIDE_WINDOWS = ("two-step-4", "rotation-vector-3")
"""Algorithms with cross products that stand beside them."""
WINDOW_SAMPLES_A_ROUND: FloatArray = np.geomspace(2.5, 40.0, 37)
"""Increments while the cone goes round once; not whole numbers all of them."""
ERROR_SIZES: FloatArray = np.geomspace(1e-8, 1e-3, 6)
"""Errors of an increment: standard deviations of white noise, rad."""
NOISY_COUNT = 480
"""Increments of a noisy run, about: they are a multiple of all windows."""


def window_errors(
    algorithms: Algorithms = BESIDE_WINDOWS,
    windows: Sequence[int] = WINDOWS,
    half_angle: float = WIDE_BRACKET.half_angle,
    frequency: float = WIDE_BRACKET.frequency,
    sample_rate: float = WIDE_BRACKET_RATE,
    runs: int = 16,
    seed: int = 6,
) -> DataTable:
    """Try windows of several widths: with few samples and many, and with noise.

    Numbers are NaN where an algorithm refuses.
    """
    chosen: dict[str, AnyAlgorithm] = {**named_algorithms(algorithms)}
    chosen |= {f"window of {n}": FunctionalIteration(f"window of {n}", n) for n in windows}
    cone = Coning(
        positive_number(half_angle, "half_angle"), positive_number(frequency, "frequency")
    )
    rate, many = positive_number(sample_rate, "sample_rate"), whole_number(runs, "runs")
    # Whole steps of all, and about as many whatever the windows are.
    whole = lcm(12, *windows)
    count = whole * max(round(NOISY_COUNT / whole), 1)
    drift = {
        name: np.array([drift_or_refused(one, each, cone) for each in WINDOW_SAMPLES_A_ROUND])
        for name, one in chosen.items()
    }
    rng = np.random.default_rng(seed)
    true = cone.increments(1 / rate, count)
    ends = cone.attitude([0.0, count / rate])
    noise = rng.standard_normal((many, *true.shape))
    error = {
        name: np.array([_error(one, true + size * noise, *ends) for size in ERROR_SIZES])
        for name, one in chosen.items()
    }
    added_up = ERROR_SIZES * np.sqrt(3 * count)
    return DataTable(
        {
            "samples_a_round": (WINDOW_SAMPLES_A_ROUND, "", "increments while the cone goes round"),
            "drift": (drift, "deg_per_h", "size of the drift on the cone"),
            "noise": (ERROR_SIZES, "arcsec", "standard deviation of an increment"),
            "error": (error, "arcsec", "of the attitude after the noisy runs, root mean square"),
            "noise_added_up": (added_up, "arcsec", "what this adds up to on the average"),
        },
        {
            "half_angle": (cone.half_angle, "deg", "half angle of the cone"),
            "frequency": (cone.frequency, "Hz", "frequency of the cone"),
            "rate": (rate, "Hz", "sample rate of the noisy runs"),
            "seconds": (count / rate, "s", "duration of a noisy run"),
            "runs": (many, "", "noisy runs"),
        },
    )


def turned_by_fit(window: FloatArray) -> float:
    """Angle by which the polynomial through a window of increments (N, 3) turns in all, rad.

    To and fro count in full.
    """
    rate = tables(len(window)).rate @ window
    _, weights = np.polynomial.legendre.leggauss(len(rate))
    return float(weights @ np.linalg.norm(rate, axis=-1))


def window_noise_growth(window: int, sample_angle: float) -> NoiseGrowth:
    """Growth of the variance across a steady turn, as of `driftlab.attitude.noise_growth`."""
    size, count = 1e-6, 4 * window
    rows = np.tile([0.0, 0.0, sample_angle], (count, 1))
    shifted = rows + size * np.eye(count)[..., np.newaxis] * [1.0, 0.0, 0.0]
    algorithm = FunctionalIteration("own", window)
    end, found = integrate(rows, algorithm)[-1], integrate(shifted, algorithm)[:, -1]
    moved = to_rotation_vector(multiply(found, conjugate(end))) / size
    gains = moved[:, 0] + 1j * moved[:, 1]
    inner = np.s_[window : 3 * window]  # whole windows, with neighbours
    white, carried = (np.mean(np.abs(g[inner]) ** 2) for g in (gains, np.diff(gains)))
    return NoiseGrowth(white, carried)


def drift_or_refused(algorithm: AnyAlgorithm, samples: float, cone: Coning = WIDE_BRACKET) -> float:
    """Size of the drift on a cone at so many samples a round, rad/s; NaN if refused."""
    try:
        drift = coning_drift(
            algorithm, cone.half_angle, cone.frequency, 1 / cone.frequency / samples
        )
    except ValueError:
        return float("nan")
    return abs(float(drift))


def _error(
    algorithm: AnyAlgorithm, increments: FloatArray, start: FloatArray, end: FloatArray
) -> float:
    """Root mean square, over runs, of an algorithm's error at the end, rad; NaN if refused."""
    try:
        found = integrate(increments, algorithm, start=start)[..., -1, :]
    except ValueError:
        return float("nan")
    angles = rotation_angle(multiply(conjugate(end), found))
    return float(np.sqrt(np.mean(angles**2)))


PRECESSION_SECONDS = 1e4
"""Duration of `precession`: a hundred rounds of the orbit, ten of its plane, s."""


def precession(times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Attitude (m, 4) and reference rate (m, 3), rad/s, of an orbit that precesses and nods.

    It is the motion of numpy-quaternion's own test of its `integrate_angular_velocity`, up to
    `PRECESSION_SECONDS`.
    """
    orbit, slow = 2 * np.pi * np.array([100, 10]) / PRECESSION_SECONDS
    opening, nodding = np.pi / 8, np.pi / 40
    widening = 2 * opening / PRECESSION_SECONDS
    # One turn after the other, each about an axis (0, 1, 2): its angle, and the rate of that.
    turns = (
        (0, -1.1 * opening, 0.0),
        (2, slow * times, slow),
        (0, opening + widening * times, widening),
        (2, (orbit - slow) * times, orbit - slow),
        (1, nodding * np.cos(slow * times), -nodding * slow * np.sin(slow * times)),
    )
    attitude, rate = np.tile([0.0, 0.0, 0.0, 1.0], (len(times), 1)), np.zeros((len(times), 3))
    for axis, angle, angle_rate in turns:
        rate += rotate(attitude, np.multiply.outer(angle_rate + 0 * times, np.eye(3)[axis]))
        turn = from_rotation_vector(np.multiply.outer(angle + 0 * times, np.eye(3)[axis]))
        attitude = multiply(attitude, turn)
    return attitude, rate


def precession_error(count: int, degree: int) -> float:
    """Largest error on `precession` from so many sampled rates, by functional iteration, rad.

    A spline of the given degree makes increments of the rates.
    """
    times = np.linspace(0.0, PRECESSION_SECONDS, count + 1)
    attitude, rate = precession(times)
    # Rates in reference axes are, with the other sign, body rates of the inverse rotation.
    rows = increments_from_rates(-rate, PRECESSION_SECONDS / count, degree=degree)
    found = conjugate(integrate(rows, "functional-iteration", start=conjugate(attitude[0])))
    return float(rotation_angle(multiply(conjugate(attitude[1:]), found)).max())


def precession_error_of_peer(count: int) -> float:
    """Do the same as numpy-quaternion does it: a cubic spline of the rates, and an integrator."""
    times = np.linspace(0.0, PRECESSION_SECONDS, count + 1)
    attitude, rate = precession(times)
    spline = CubicSpline(times, rate)
    solution = solve_ivp(
        lambda time, quaternion: multiply(pure(spline(time) / 2), quaternion),
        (0.0, PRECESSION_SECONDS),
        attitude[0],
        t_eval=times,
        method="DOP853",
        rtol=1e-11,
        atol=1e-12,
    )
    return float(rotation_angle(multiply(conjugate(attitude), solution.y.T)).max())
