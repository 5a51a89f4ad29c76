"""How long to average before an alignment, and the heading error that is left.

Beside white noise there is a slow part, or, as the rival has it, the rounding of an angle.
"""

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.constants import degree, hour

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    positive_number,
    whole_number,
)
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.motion.vehicle import static_imu

DEGREE_PER_HOUR = degree / hour
WHITE = (0.06, 0.5)
"""White noise of a sample, deg/h: the ends of the paper's range."""
SLOW = 0.01
"""Deviation of the slow part of the noise, deg/h."""
MOVING_AVERAGE = 625
"""Samples of the paper's moving average, as reconstructed.

The paper says that 0.06 to 0.5 deg/h become 0.01 to 0.02. White noise and one window cannot do
both: the ratios are 6 and 25. A window of 625 samples takes 0.5 to 0.02; then 0.06 becomes 0.01
only because something slower than the window is left.
"""
RIVAL_WINDOW = 36
"""Samples of the moving average if the noisy gyros differ from the quiet ones by rounding alone.

Rounding of the angle falls with the window itself. White noise of 0.06 deg/h in all gyros then
becomes 0.01, and with a rounding that makes 0.5 of it, 0.02. From 23 to 42 samples do it.
"""


class AveragingWindow(NamedTuple):
    """Standard deviation of the heading over many alignments, by window and white noise."""

    white: FloatArray  # (2,), white noise of a sample, rad/s
    slow: float  # deviation of the slow part, rad/s
    windows: FloatArray  # (n,), lengths of the mean, samples
    simulated: FloatArray  # (2, n), rad; a row for each white noise
    formula: FloatArray  # (2, n), likewise
    white_alone: FloatArray  # (2, n), the formula without a slow part, rad
    rival_simulated: FloatArray  # (2, n), with the noise of `rival_noise`, rad
    rival_formula: FloatArray  # (2, n), likewise
    moving_average: int  # window that is marked, samples
    rival_window: int  # likewise
    averaged: FloatArray  # (2,), what `moving_average` leaves of the noise, rad/s
    rival_averaged: FloatArray  # (2,), what `rival_window` leaves of it, rad/s
    runs: int  # number of simulated alignments


def gyro_noise(white: float, slow: float = SLOW) -> GyroNoise:
    """Return the noise of a gyro from the deviations of its white and its slow part, deg/h."""
    return GyroNoise(white * degree / hour, slow * degree / hour)


def rival_noise(total: float, quiet: float = WHITE[0]) -> GyroNoise:
    """Return noise of some deviation in a sample, deg/h: a quiet part white, the rest rounding."""
    white = gyro_noise(quiet, 0.0)
    rest = np.sqrt(total**2 - quiet**2) * degree / hour
    return replace(white, quantisation=float(rest * white.interval / np.sqrt(2)))


def heading_spread_by_window(
    white: ArrayLike = (WHITE[0] * DEGREE_PER_HOUR, WHITE[1] * DEGREE_PER_HOUR),
    slow: float = SLOW * DEGREE_PER_HOUR,
    moving_average: int = MOVING_AVERAGE,
    rival_window: int = RIVAL_WINDOW,
    latitude: float = SARATOV_LATITUDE,
    runs: int = 200,
    seed: int = 12,
) -> AveragingWindow:
    """Align many times with means of the gyros over windows of several lengths.

    With the rival the white noise is that of the quiet gyro, and the rest is rounding.
    """
    quiet, noisy = (float(value) for value in finite_array(white, "white", 2) / DEGREE_PER_HOUR)
    if not 0 < quiet <= noisy:
        raise ValueError(f"white: expected a quiet gyro and a noisier one, got {white!r}.")
    part = positive_number(slow, "slow") / DEGREE_PER_HOUR
    marked = (
        whole_number(moving_average, "moving_average"),
        whole_number(rival_window, "rival_window"),
    )
    count, place = whole_number(runs, "runs", least=2), finite_number(latitude, "latitude")
    windows = np.array(sorted({1, 3, 10, 100, 300, 2000, 6000, 20000, *marked}))
    level = EARTH_RATE * np.cos(place)

    def means(noises: list[GyroNoise], windows: Iterable[int]) -> FloatArray:
        return np.array([[n.deviation_of_mean(int(w)) for w in windows] for n in noises])

    kinds = [gyro_noise(value, part) for value in (quiet, noisy)]
    rival = [rival_noise(value, quiet) for value in (quiet, noisy)]
    alone = [gyro_noise(value, 0.0) for value in (quiet, noisy)]
    return AveragingWindow(
        np.array([quiet, noisy]) * DEGREE_PER_HOUR,
        part * DEGREE_PER_HOUR,
        windows.astype(float),
        _simulated(kinds, windows, count, place, np.random.default_rng(seed)),
        means(kinds, windows) / level,
        means(alone, windows) / level,
        _simulated(rival, windows, count, place, np.random.default_rng(seed + 1)),
        means(rival, windows) / level,
        *marked,
        means(kinds, marked[:1])[:, 0],
        means(rival, marked[1:])[:, 0],
        count,
    )


def _simulated(
    noises: list[GyroNoise], windows: NDArray[np.int_], runs: int, latitude: float,
    rng: np.random.Generator,
) -> FloatArray:  # fmt: skip
    """Deviations of the heading over many alignments, a row for each noise, rad."""
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], latitude)
    found = np.empty((len(noises), len(windows)))
    for i, noise in enumerate(noises):
        sums = np.cumsum(noise.samples(windows[-1], rng, runs, 3), axis=-1)
        for j, window in enumerate(windows):
            means = sums[..., window - 1] / window
            found[i, j] = np.std(align(rate + means, force, heading_tolerance=np.inf).heading)
    return found
