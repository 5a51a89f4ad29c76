"""Noise of a gyro at rest, and what a moving average leaves of it.

Two parts: white noise, which averages away with the square root of the window, and a slow part, a
Gauss-Markov process, which does so only in windows much longer than its correlation time.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from scipy.constants import degree, hour
from scipy.signal import lfilter

from .checks import FloatArray, finite_number, whole_number


@dataclass(frozen=True)
class GyroNoise:
    """Noise of one gyro's rate, sample by sample.

    Attributes
    ----------
    white : float
        Standard deviation of the white part of a sample, rad/s.
    slow : float
        Standard deviation of the slow part, rad/s.
    correlation_time : float
        Of the slow part, s.
    interval : float
        Between samples, s.
    """

    white: float = 0.5 * degree / hour
    slow: float = 0.01 * degree / hour
    correlation_time: float = 1 * hour
    interval: float = 0.1

    def __post_init__(self) -> None:
        for field in fields(self):
            value, least = getattr(self, field.name), field.name in ("white", "slow")
            if finite_number(value, field.name) < 0 or not (least or value > 0):
                kind = "number of at least 0" if least else "positive time"
                raise ValueError(f"{field.name}: expected a {kind}, got {value!r}.")

    def samples(self, count: int, rng: np.random.Generator, *shape: int) -> FloatArray:
        """Rates (*shape, count) in rad/s, each row a gyro switched on anew."""
        size = (*shape, whole_number(count, "count"))
        kept = float(np.exp(-self.interval / self.correlation_time))
        draws = rng.standard_normal(size)
        # The first value has the spread of all; later ones forget it little by little.
        draws[..., 1:] *= np.sqrt(1 - kept**2)
        slow = lfilter([1.0], [1.0, -kept], draws, axis=-1)
        noise: FloatArray = self.slow * slow + self.white * rng.standard_normal(size)
        return noise

    def deviation_of_mean(self, count: int) -> float:
        """Standard deviation in rad/s of the mean of `count` samples, in closed form."""
        number = whole_number(count, "count")
        kept = np.exp(-self.interval / self.correlation_time)
        # Sum of kept^|i - j| over all pairs of samples.
        away = -np.expm1(-self.interval / self.correlation_time)
        pairs = number * (1 + kept) / away - 2 * kept * (1 - kept**number) / away**2
        return float(np.sqrt(self.white**2 / number + self.slow**2 * pairs / number**2))


def moving_average(values: FloatArray, window: int) -> FloatArray:
    """Means (..., n - window + 1) of each `window` values in a row of `values` (..., n)."""
    length = whole_number(window, "window")
    if length > values.shape[-1]:
        raise ValueError(
            f"window: expected at most the number of values, {values.shape[-1]}, got {window!r}."
        )
    sums = np.cumsum(values, axis=-1)
    sums = np.concatenate([np.zeros_like(sums[..., :1]), sums], axis=-1)
    means: FloatArray = (sums[..., length:] - sums[..., :-length]) / length
    return means
