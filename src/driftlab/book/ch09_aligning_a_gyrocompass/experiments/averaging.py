"""How long to average before an alignment: white noise, a slow part, and the heading they leave."""

from typing import NamedTuple

import numpy as np
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
    runs : int
        Number of simulated alignments.
    """

    windows: FloatArray
    simulated: FloatArray
    formula: FloatArray
    white_alone: FloatArray
    runs: int


def gyro_noise(white: float, slow: float = SLOW) -> GyroNoise:
    """Return the noise of a gyro from the deviations of its white and its slow part, deg/h."""
    return GyroNoise(white * degree / hour, slow * degree / hour)


def heading_spread_by_window() -> AveragingWindow:
    """Align many times with means of the gyros over windows of several lengths."""
    rng, runs = np.random.default_rng(12), 200
    windows = np.array([1, 3, 10, 36, 100, 300, MOVING_AVERAGE, 2000, 6000, 20000])
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], SARATOV_LATITUDE)
    level = EARTH_RATE * np.cos(SARATOV_LATITUDE)
    simulated = np.empty((len(WHITE), len(windows)))
    formula, white_alone = np.empty_like(simulated), np.empty_like(simulated)
    for i, white in enumerate(WHITE):
        noise, fast = gyro_noise(white), gyro_noise(white, 0.0)
        sums = np.cumsum(noise.samples(windows[-1], rng, runs, 3), axis=-1)
        for j, window in enumerate(windows):
            means = sums[..., window - 1] / window
            simulated[i, j] = np.std(align(rate + means, force).heading)
            formula[i, j] = noise.deviation_of_mean(window) / level
            white_alone[i, j] = fast.deviation_of_mean(window) / level
    return AveragingWindow(windows.astype(float), simulated, formula, white_alone, runs)
