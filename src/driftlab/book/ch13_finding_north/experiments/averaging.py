"""How long to average before an alignment, and the heading error that is left.

Beside white noise there is a slow part, or, as the rival has it, the rounding of an angle.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.constants import degree, hour

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, finite_array, finite_number, positive_number, whole_number
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.motion.vehicle import static_imu

DEGREE_PER_HOUR = degree / hour
WHITE = (0.06, 0.5)
"""White noise of a sample, deg/h: the ends of the paper's range."""
GYROS = ("quiet", "noisy")
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


def gyro_noise(white: float, gauss_markov: float = SLOW) -> GyroNoise:
    """Return the noise of a gyro from the deviations of its white and its slow part, deg/h."""
    return GyroNoise(white * degree / hour, gauss_markov * degree / hour)


def rival_noise(total: float, quiet: float = WHITE[0]) -> GyroNoise:
    """Return noise of some deviation in a sample, deg/h: a quiet part white, the rest rounding."""
    white = gyro_noise(quiet, 0.0)
    rest = np.sqrt(total**2 - quiet**2) * degree / hour
    return replace(white, quantisation=float(rest * white.interval / np.sqrt(2)))


def heading_spread_by_window(
    white: ArrayLike = (WHITE[0] * DEGREE_PER_HOUR, WHITE[1] * DEGREE_PER_HOUR),
    gauss_markov: float = SLOW * DEGREE_PER_HOUR,
    moving_average: int = MOVING_AVERAGE,
    rival_window: int = RIVAL_WINDOW,
    latitude: float = SARATOV_LATITUDE,
    runs: int = 200,
    seed: int = 12,
) -> DataTable:
    """Align many times with means of the gyros over windows of several lengths.

    With the rival the white noise is that of the quiet gyro, and the rest is rounding.
    """
    quiet, noisy = (float(value) for value in finite_array(white, "white", 2) / DEGREE_PER_HOUR)
    if not 0 < quiet <= noisy:
        raise ValueError(f"white: expected a quiet gyro and a noisier one, got {white!r}.")
    part = positive_number(gauss_markov, "gauss_markov") / DEGREE_PER_HOUR
    own_window = whole_number(moving_average, "moving_average")
    marked = own_window, whole_number(rival_window, "rival_window")
    count, place = whole_number(runs, "runs", least=2), finite_number(latitude, "latitude")
    windows = np.array(sorted({1, 3, 10, 100, 300, 2000, 6000, 20000, *marked}))
    level = EARTH_RATE * np.cos(place)

    def means(noises: list[GyroNoise], windows: Iterable[int]) -> FloatArray:
        return np.array([[n.standard_deviation_of_mean(int(w)) for w in windows] for n in noises])

    kinds = [gyro_noise(value, part) for value in (quiet, noisy)]
    rival = [rival_noise(value, quiet) for value in (quiet, noisy)]
    alone = [gyro_noise(value, 0.0) for value in (quiet, noisy)]
    found = [
        _simulated(noises, windows, count, place, np.random.default_rng(seed + k))
        for k, noises in enumerate((kinds, rival))
    ]
    formula, white_alone, by_rival = (means(n, windows) / level for n in (kinds, alone, rival))
    spread = np.stack([found[0], formula, white_alone], axis=1)
    left, by_rival_left = (means(n, [w])[:, 0] for n, w in zip((kinds, rival), marked, strict=True))
    return DataTable(
        {
            "samples": (windows.astype(float), "", "samples in the mean, ten per second"),
            "moving_average": ([own_window], "", "marked number of samples"),
            "rival_window": ([marked[1]], "", "marked number of samples with a rounded angle"),
            "spread": (
                spread, "deg", "deviation of the heading with white noise and a slow part",
                [GYROS, ("simulated", "formula", "white_alone")],
            ),
            "rival_spread": (
                np.stack([found[1], by_rival], axis=1), "deg", "the same with a rounded angle",
                [GYROS, ("simulated", "formula")],
            ),
        },
        {
            "white": (np.array([quiet, noisy]) * DEGREE_PER_HOUR, "deg_per_h", "white noise"),
            "gauss_markov": (part * DEGREE_PER_HOUR, "deg_per_h", "deviation of the slow part"),
            "averaged": (left, "deg_per_h", "noise left by the marked mean"),
            "rival_averaged": (by_rival_left, "deg_per_h", "the same with a rounded angle"),
            "runs": (count, "", "number of simulated alignments"),
        },
    )  # fmt: skip


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
