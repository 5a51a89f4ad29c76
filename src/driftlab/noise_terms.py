"""Five terms of the noise of a sensor at rest, as straight lines on an Allan plot, and as records.

They are those of IEEE Std 952, and of every data sheet; `noise_identification` finds them in a
record.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass, fields

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import zeta

from .checks import (
    FloatArray,
    checked_generator,
    keep,
    nonnegative_number,
    positive_array,
    positive_number,
    whole_number,
)
from .core.allan import term_variances


@dataclass(frozen=True)
class NoiseTerms:
    """Five terms of the noise of a rate, with the coefficients of IEEE Std 952.

    Of an accelerometer the same, with m/s in place of rad.

    Attributes
    ----------
    quantisation : float
        Q, rad: the angle is rounded, or dithered, with this standard deviation.
    angle_random_walk : float
        N, rad/sqrt(s): white noise of the rate.
    bias_instability : float
        B, rad/s: flicker noise.
    rate_random_walk : float
        K, rad/s/sqrt(s).
    rate_ramp : float
        R, rad/s^2: a drift that grows evenly.

    Notes
    -----
    Allan deviations over the averaging time T: sqrt(3) Q/T, N/sqrt(T), sqrt(2 ln 2/pi) B,
    K sqrt(T/3), R T/sqrt(2).

    Examples
    --------
    The lowest point is where two lines cross, here at 100 s:

    >>> noise = NoiseTerms(angle_random_walk=1e-5, rate_random_walk=np.sqrt(3) * 1e-7)
    >>> noise.deviation([10.0, 100.0, 1000.0])
    array([3.17804972e-06, 1.41421356e-06, 3.17804972e-06])
    """

    quantisation: float = 0.0
    angle_random_walk: float = 0.0
    bias_instability: float = 0.0
    rate_random_walk: float = 0.0
    rate_ramp: float = 0.0

    def __post_init__(self) -> None:
        for name in TERMS:
            keep(self, **{name: nonnegative_number(getattr(self, name), name)})

    def lines(self, averaging_times: ArrayLike) -> dict[str, FloatArray]:
        """Allan deviation of each term alone.

        Parameters
        ----------
        averaging_times : array_like, shape (...)
            s.

        Returns
        -------
        dict of str to ndarray, shape (...)
            rad/s, by the name of the term.

        Examples
        --------
        >>> NoiseTerms(angle_random_walk=2e-5).lines(4.0)["angle_random_walk"]
        np.float64(1e-05)
        """
        times = positive_array(averaging_times, "averaging_times")
        rows = np.moveaxis(np.sqrt(term_variances(times)) * astuple(self), -1, 0)
        return dict(zip(TERMS, rows, strict=True))

    def deviation(self, averaging_times: ArrayLike) -> FloatArray:
        """Allan deviation of all terms together.

        Parameters
        ----------
        averaging_times : array_like, shape (...)
            s.

        Returns
        -------
        ndarray, shape (...)
            rad/s: the root of the sum of squares of `lines`.

        Examples
        --------
        >>> print(NoiseTerms(quantisation=1.0, rate_ramp=0.0).deviation(3.0).round(3))
        0.577
        """
        variances = term_variances(positive_array(averaging_times, "averaging_times")) @ np.square(
            astuple(self)
        )
        return np.sqrt(variances)

    def samples(
        self, count: int, interval: float, rng: np.random.Generator | int, *shape: int
    ) -> FloatArray:
        """Draw a record of this noise.

        Parameters
        ----------
        count : int
            Number of samples: means of the rate over an interval.
        interval : float
            Between samples, s.
        rng : numpy.random.Generator or int
            Source of the noise.
        *shape : int
            Leading axes of the result: independent sensors.

        Returns
        -------
        ndarray, shape (..., count)
            rad/s. The random walk begins at zero. The flicker noise is the first half of a record
            with a period of twice the length.

        Examples
        --------
        >>> rates = NoiseTerms(rate_ramp=2.0).samples(4, 0.5, np.random.default_rng(1))
        >>> rates
        array([0.5, 1.5, 2.5, 3.5])
        """
        length, step = whole_number(count, "count"), positive_number(interval, "interval")
        size = tuple(whole_number(n, "shape") for n in shape)
        draw = checked_generator(rng).standard_normal
        rates: FloatArray = (
            self.rate_ramp * step * np.broadcast_to(np.arange(length) + 0.5, (*size, length))
        )
        if self.quantisation:
            rates = rates + self.quantisation / step * np.diff(draw((*size, length + 1)))
        if self.angle_random_walk:
            rates = rates + self.angle_random_walk / np.sqrt(step) * draw((*size, length))
        if self.bias_instability:
            # Means of flicker noise: its spectrum through the mean, with all that is folded back.
            x = np.arange(1, length + 1) / (2 * length)
            gain = np.sin(np.pi * x) * np.sqrt((zeta(3, x) + zeta(3, 1 - x)) / (2 * np.pi**3))
            shaped = np.fft.rfft(draw((*size, 2 * length))) * np.append(0.0, gain)
            rates = rates + self.bias_instability * np.fft.irfft(shaped)[..., :length]
        if self.rate_random_walk:
            # Mean of a walk over an interval: half of its step, and what a bridge between adds.
            first, bridge = draw((2, *size, length))
            walk = np.cumsum(first, axis=-1) - first / 2 + bridge / np.sqrt(12)
            rates = rates + self.rate_random_walk * np.sqrt(step) * walk
        return np.array(rates)


TERMS = tuple(field.name for field in fields(NoiseTerms))
"""Names of the terms, from short averaging times to long ones."""
