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


def printed_ratio_range() -> tuple[float, float]:
    """Return the least and the largest ratio of range to deviation that rounds to the print."""
    return (
        (PAPER_SPREAD - 0.05) / (PAPER_DEVIATION + 0.0005),
        (PAPER_SPREAD + 0.05) / (PAPER_DEVIATION - 0.0005),
    )
