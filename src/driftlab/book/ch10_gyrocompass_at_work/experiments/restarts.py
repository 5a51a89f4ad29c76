"""Plotnikov Fig. 2, simulated from its description: 26 restarts, and what their spread can say."""

from typing import NamedTuple

import numpy as np

from driftlab.book.ch09_aligning_a_gyrocompass.experiments import (
    MOVING_AVERAGE,
    WHITE,
    gyro_noise,
)
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.noise import moving_average
from driftlab.gyrocompass.trials import normal_ranges
from driftlab.motion.vehicle import static_imu

RESTARTS = 26
"""The paper's."""
PAPER_SPREAD, PAPER_DEVIATION = 0.3, 0.054
"""The paper's, degrees."""
TRIALS = 200_000
"""Samples of as many normal values."""


class Restarts(NamedTuple):
    """A series of restarts, the noise of one of them, and ranges of normal samples.

    Attributes
    ----------
    heading : ndarray, shape (26,)
        rad, with the weaker white noise of the paper's range, averaged.
    raw : ndarray, shape (n,)
        Noise of one gyro with the stronger white noise, rad/s.
    averaged : ndarray, shape (m,)
        The same after the moving average, rad/s.
    deviations : ndarray, shape (2, 2)
        A row for each white noise: before and after averaging, rad/s.
    ranges : ndarray, shape (200000,)
        Range over standard deviation of 26 normal values.
    """

    heading: FloatArray
    raw: FloatArray
    averaged: FloatArray
    deviations: FloatArray
    ranges: FloatArray


def restart_series() -> Restarts:
    """Switch a compass on again and again, and let it average before it aligns."""
    rng = np.random.default_rng(26)
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], SARATOV_LATITUDE)
    weak, strong = map(gyro_noise, WHITE)
    quiet = weak.samples(MOVING_AVERAGE, rng, RESTARTS, 3)
    heading = align(rate + quiet.mean(axis=-1), force).heading
    raw = strong.samples(10 * MOVING_AVERAGE, rng)
    deviations = [
        [np.hypot(gyro.white, gyro.slow), gyro.deviation_of_mean(MOVING_AVERAGE)]
        for gyro in (weak, strong)
    ]
    return Restarts(
        heading,
        raw,
        moving_average(raw, MOVING_AVERAGE),
        np.array(deviations),
        normal_ranges(RESTARTS, TRIALS, rng),
    )


def rounded_ratio_range() -> tuple[float, float]:
    """Return the least and the largest ratio of spread to deviation that rounds to the paper's."""
    return (
        (PAPER_SPREAD - 0.05) / (PAPER_DEVIATION + 0.0005),
        (PAPER_SPREAD + 0.05) / (PAPER_DEVIATION - 0.0005),
    )


def spread_readings(ranges: FloatArray) -> dict[str, tuple[float, float]]:
    """Return what a spread of 0.3 degrees may mean: ratio to the deviation, and its probability.

    Probable is how often normal values have at least that ratio of range to deviation. Six
    deviations are not a range: any values have them.

    Parameters
    ----------
    ranges : ndarray, shape (n,)
        Range over standard deviation of normal samples.
    """
    least, _ = rounded_ratio_range()
    taken = PAPER_SPREAD / PAPER_DEVIATION
    ratios = {
        "largest minus least, 0.3/0.054": taken,
        "the same, 0.25 rounded up, over 0.054": (PAPER_SPREAD - 0.05) / PAPER_DEVIATION,
        "the same, 0.25 over 0.0545": least,
        "plus and minus 0.3, 0.6/0.054": 2 * taken,
    }
    readings = {name: (ratio, float(np.mean(ranges >= ratio))) for name, ratio in ratios.items()}
    return readings | {"six deviations, 0.324 in one digit": (6.0, 1.0)}
