"""Noise of a gyro at rest, and what is left of it by a moving average and by a horizon.

Two parts: white noise, which averages away with the square root of the window, and a slow part, a
Gauss-Markov process, which does so only in windows much longer than its correlation time.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree, hour
from scipy.signal import lfilter

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    positive_number,
    whole_number,
)
from driftlab.earth import EARTH_RADIUS


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
        size = (*(whole_number(n, "shape") for n in shape), whole_number(count, "count"))
        if not isinstance(rng, np.random.Generator):
            raise ValueError(f"rng: expected a numpy Generator to draw the noise, got {rng!r}.")
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
        lags = np.arange(1, number)
        # Sum of the correlations of all pairs of samples, pair by pair of equal distance.
        decay = np.exp(-self.interval / self.correlation_time * lags)
        pairs = number + 2 * np.sum((number - lags) * decay)
        return float(np.hypot(self.white / np.sqrt(number), self.slow * np.sqrt(pairs) / number))


def moving_average(values: ArrayLike, window: int) -> FloatArray:
    """Means (..., n - window + 1) of each `window` values in a row of `values` (..., n)."""
    row = np.atleast_1d(finite_array(values, "values"))
    length = whole_number(window, "window")
    if length > row.shape[-1]:
        raise ValueError(
            f"window: expected at most the number of values, {row.shape[-1]}, got {window!r}."
        )
    sums = np.cumsum(row, axis=-1)
    sums = np.concatenate([np.zeros_like(sums[..., :1]), sums], axis=-1)
    means: FloatArray = (sums[..., length:] - sums[..., :-length]) / length
    return means


def settled_deviation(
    angle_random_walk: float, natural_frequency: float, damping: float = float(np.sqrt(0.5))
) -> float:
    """Standard deviation in rad/s of the integrals `Horizon.rate` of a damped horizon under noise.

    White gyro noise N passes a low-pass filter of second order: N sqrt(wn/(4 zeta)).

    Parameters
    ----------
    angle_random_walk : float
        N, rad/sqrt(s).
    natural_frequency, damping : float
        Of `damped_tuning`.
    """
    frequency = positive_number(natural_frequency, "natural_frequency")
    ratio = positive_number(damping, "damping")
    walk = _checked_walk(angle_random_walk)
    return float(walk * np.sqrt(frequency / (4 * ratio)))


def swing_deviation(
    angle_random_walk: float, time: ArrayLike, gravity: float, radius: float = EARTH_RADIUS
) -> FloatArray:
    """Standard deviation (...) in rad/s of `Horizon.rate` under Schuler's tuning and white noise.

    From a horizon without error: N ws sqrt(t/2 - sin(2 ws t)/(4 ws)) with ws^2 = g/R. Nothing
    damps the swing, so it grows with the square root of the time.

    Parameters
    ----------
    angle_random_walk : float
        N, rad/sqrt(s).
    time : array_like, shape (...)
        s.
    gravity, radius : float
        g in m/s^2 and R in m.
    """
    t, walk = finite_array(time, "time"), _checked_walk(angle_random_walk)
    if t.min() < 0:
        raise ValueError(f"time: expected times from 0 on, got {t.min():g} s.")
    schuler = np.sqrt(positive_number(gravity, "gravity") / positive_number(radius, "radius"))
    swing = t / 2 - np.sin(2 * schuler * t) / (4 * schuler)
    return np.asarray(walk * schuler * np.sqrt(np.maximum(swing, 0.0)))


def _checked_walk(angle_random_walk: float) -> float:
    walk = finite_number(angle_random_walk, "angle_random_walk")
    if walk < 0:
        raise ValueError(f"angle_random_walk: expected a number of at least 0, got {walk!r}.")
    return walk
