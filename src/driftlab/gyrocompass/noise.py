"""Noise of a gyro at rest, and how far a moving average reduces it.

Three parts: white noise, which averages away with the square root of the window; a slow part, a
Gauss-Markov process, which does so only in windows much longer than its correlation time; and the
rounding of the angle, which averages away with the window itself.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree, hour

from driftlab.checks import (
    FloatArray,
    checked_generator,
    finite_number,
    keep,
    positive_array,
    positive_number,
    shown,
    whole_number,
)
from driftlab.core.gauss_markov import gauss_markov

_SHORT = 1e-3
"""Averaging times, in correlation times, below which a series is better than the closed form."""
_SIZES = ("white", "gauss_markov", "quantisation")


@dataclass(frozen=True)
class GyroNoise:
    """Noise of one gyro's rate, sample by sample: a white and a slow part, and a rounded angle.

    Attributes
    ----------
    white : float
        Standard deviation of the white part of a sample, rad/s.
    gauss_markov : float
        Standard deviation of the slow part, a Gauss-Markov process, rad/s.
    correlation_time : float
        Of the slow part, s.
    interval : float
        Between samples, s.
    quantisation : float
        Standard deviation of the error of the angle at the ends of each interval, rad: of its
        rounding, or of anything else that leaves the angle alone in the long run.

    Examples
    --------
    The mean of an hour of samples is left with the slow part alone, here in degrees per hour:

    >>> noise = GyroNoise()
    >>> [round(noise.standard_deviation_of_mean(count) / degree * hour, 3) for count in (1, 36000)]
    [0.5, 0.009]
    >>> noise.samples(5, np.random.default_rng(1), 2).shape  # of two gyros
    (2, 5)
    >>> noise.sampled_every(1.0).interval
    1.0
    >>> (noise.allan_deviation([0.1, 3600.0]) / degree * hour).round(3)
    array([0.5  , 0.006])
    """

    white: float = 0.5 * degree / hour
    gauss_markov: float = 0.01 * degree / hour
    correlation_time: float = 1 * hour
    interval: float = 0.1
    quantisation: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value, least = getattr(self, field.name), field.name in _SIZES
            if finite_number(value, field.name) < 0 or not (least or value > 0):
                kind = "number of at least 0" if least else "positive time"
                raise ValueError(f"{field.name}: expected a {kind}, got {shown(value)}.")
            keep(self, **{field.name: finite_number(value, field.name)})

    def sampled_every(self, interval: float) -> GyroNoise:
        """Return the same noise, each sample a mean over its `interval`, s.

        The white part is smaller by the root of the number of samples in a mean. The interval shall
        be short beside the correlation time.
        """
        seconds = positive_number(interval, "interval")
        white = self.white * float(np.sqrt(self.interval / seconds))
        return replace(self, white=white, interval=seconds)

    def samples(self, count: int, rng: np.random.Generator | int, *shape: int) -> FloatArray:
        """Draw the noise of gyros that are switched on anew, rates ``(*shape, count)`` in rad/s."""
        size = (*(whole_number(n, "shape") for n in shape), whole_number(count, "count"))
        source = checked_generator(rng)
        kept = float(np.exp(-self.interval / self.correlation_time))
        slow = self.gauss_markov * gauss_markov(source.standard_normal(size), kept)
        noise: FloatArray = slow + self.white * source.standard_normal(size)
        if self.quantisation:
            rounding = source.standard_normal((*size[:-1], size[-1] + 1))
            noise += self.quantisation / self.interval * np.diff(rounding)
        return noise

    def standard_deviation_of_mean(self, count: int) -> float:
        """Standard deviation of the mean of `count` neighbouring samples, in closed form, rad/s."""
        number = whole_number(count, "count")
        lags = np.arange(1, number)
        # Sum of the correlations of all pairs of samples, pair by pair of equal distance.
        decay = np.exp(-self.interval / self.correlation_time * lags)
        pairs = number + 2 * np.sum((number - lags) * decay)
        parts = [self.white / np.sqrt(number), self.gauss_markov * np.sqrt(pairs) / number]
        # Of all the angles in between nothing is left but the first and the last.
        parts.append(np.sqrt(2) * self.quantisation / (number * self.interval))
        return float(np.linalg.norm(parts))

    def allan_deviation(self, averaging_times: ArrayLike) -> FloatArray:
        r"""Allan deviation (...) in closed form, rad/s, at averaging times (...) in s.

        With the parts' deviations w and s, the correlation time T, the interval h and the
        quantisation Q:

        .. math:: \sigma^2(\tau) = \frac{w^2 h}{\tau} + \frac{2 s^2 T}{\tau} \left[1 -
                  \frac{T}{2\tau}\left(3 - 4e^{-\tau/T} + e^{-2\tau/T}\right)\right] +
                  \frac{3 Q^2}{\tau^2}

        The slow part is averaged as if it were known at all times. That of its sampled values is
        larger by the factor sqrt(1 + h^2/(2 tau^2)), if h and tau are short beside T: by 22 % at
        one sample, 1 % at five.
        """
        times = positive_array(averaging_times, "averaging_times")
        x = times / self.correlation_time
        # Most of the terms cancel in short times, so there the series stands for them.
        long = np.maximum(x, _SHORT)
        slow = np.where(
            x > _SHORT,
            2 / long * (1 - (3 - 4 * np.exp(-long) + np.exp(-2 * long)) / (2 * long)),
            2 * x / 3 - x**2 / 2 + 7 * x**3 / 30,
        )
        fast = self.white**2 * self.interval / times + 3 * (self.quantisation / times) ** 2
        return np.sqrt(fast + self.gauss_markov**2 * slow)
