"""How long to average before an alignment, and the heading error that is left.

Beside white noise there is a slow part, or, as the rival has it, the rounding of an angle.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.constants import degree, hour

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.motion.vehicle import static_imu

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
    """Standard deviation of the heading over many alignments, by window and white noise.

    Attributes
    ----------
    windows : ndarray, shape (n,)
        Lengths of the mean, samples.
    simulated, formula : ndarray, shape (2, n)
        rad; a row for each entry of `WHITE`.
    white_alone : ndarray, shape (2, n)
        The formula without a slow part, rad.
    rival_simulated, rival_formula : ndarray, shape (2, n)
        With the noise of `rival_noise`, rad.
    runs : int
        Number of simulated alignments.
    """

    windows: FloatArray
    simulated: FloatArray
    formula: FloatArray
    white_alone: FloatArray
    rival_simulated: FloatArray
    rival_formula: FloatArray
    runs: int


def gyro_noise(white: float, slow: float = SLOW) -> GyroNoise:
    """Return the noise of a gyro from the deviations of its white and its slow part, deg/h."""
    return GyroNoise(white * degree / hour, slow * degree / hour)


def rival_noise(total: float) -> GyroNoise:
    """Return noise of some deviation in a sample, deg/h: the least white, the rest by rounding."""
    white = gyro_noise(WHITE[0], 0.0)
    rest = np.sqrt(total**2 - WHITE[0] ** 2) * degree / hour
    return replace(white, quantisation=float(rest * white.interval / np.sqrt(2)))


def heading_spread_by_window() -> AveragingWindow:
    """Align many times with means of the gyros over windows of several lengths."""
    runs = 200
    windows = np.array([1, 3, 10, RIVAL_WINDOW, 100, 300, MOVING_AVERAGE, 2000, 6000, 20000])
    level = EARTH_RATE * np.cos(SARATOV_LATITUDE)

    def formula(noises: list[GyroNoise]) -> FloatArray:
        return np.array([[n.deviation_of_mean(w) for w in windows] for n in noises]) / level

    slow = [gyro_noise(white) for white in WHITE]
    rival = [rival_noise(white) for white in WHITE]
    return AveragingWindow(
        windows.astype(float),
        _simulated(slow, windows, runs, np.random.default_rng(12)),
        formula(slow),
        formula([gyro_noise(white, 0.0) for white in WHITE]),
        _simulated(rival, windows, runs, np.random.default_rng(13)),
        formula(rival),
        runs,
    )


def _simulated(
    noises: list[GyroNoise], windows: NDArray[np.int_], runs: int, rng: np.random.Generator
) -> FloatArray:
    """Deviations of the heading over many alignments, a row for each noise, rad."""
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], SARATOV_LATITUDE)
    found = np.empty((len(noises), len(windows)))
    for i, noise in enumerate(noises):
        sums = np.cumsum(noise.samples(windows[-1], rng, runs, 3), axis=-1)
        for j, window in enumerate(windows):
            means = sums[..., window - 1] / window
            found[i, j] = np.std(align(rate + means, force, heading_tolerance=np.inf).heading)
    return found
