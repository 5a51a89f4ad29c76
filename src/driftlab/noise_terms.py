"""Five noise terms of a sensor at rest: lines on an Allan plot, records of them, and their fit.

They are those of IEEE Std 952, and of every data sheet. The fit identifies them in a record, and
says what the record cannot tell.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import zeta

from .allan import AllanDeviation
from .checks import (
    FloatArray,
    checked_generator,
    checked_instance,
    keep,
    nonnegative_number,
    positive_array,
    positive_number,
    some_of,
    whole_number,
)
from .core import allan as core

_BOUND = 0.95
"""Probability that stands behind an upper bound."""


@dataclass(frozen=True)
class NoiseTerms:
    """Five terms of the noise of a rate, with the coefficients of IEEE Std 952.

    Of an accelerometer the same, with m/s instead of rad.

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
    >>> noise.lines(4.0)["angle_random_walk"]
    np.float64(5e-06)
    >>> noise.samples(4, 0.5, np.random.default_rng(1)).shape
    (4,)
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
        """Allan deviation (...) of each term alone, rad/s, over averaging times (...), s."""
        times = positive_array(averaging_times, "averaging_times")
        rows = np.moveaxis(np.sqrt(core.term_variances(times)) * astuple(self), -1, 0)
        return dict(zip(TERMS, rows, strict=True))

    def deviation(self, averaging_times: ArrayLike) -> FloatArray:
        """Allan deviation (...) of all terms together, rad/s, over averaging times (...), s."""
        times = positive_array(averaging_times, "averaging_times")
        return np.sqrt(core.term_variances(times) @ np.square(astuple(self)))

    def samples(
        self, count: int, interval: float, rng: np.random.Generator | int, *shape: int
    ) -> FloatArray:
        """Draw a record ``(*shape, count)`` of this noise: mean rates of an interval, rad/s.

        The random walk begins at zero. The flicker noise is the first half of a record with a
        period of twice the length.
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


@dataclass(frozen=True)
class NoiseFit:
    """Noise terms that fit an Allan deviation.

    Attributes
    ----------
    terms : NoiseTerms
        What the record shows; zero for a term that it does not show.
    standard_deviations : dict of str to float
        Standard deviations of the terms that it shows.
    upper_bounds : dict of str to float
        For each term that was sought and is not seen: with 95 % probability it is smaller.
        Infinite if the record is too short to say anything.
    covariance : ndarray, shape (5, 5)
        Of the squared coefficients, in the order of `TERMS`; zero for terms that are not seen.
    rms_residual : float
        Root mean square of the points' distances from the fit, in standard deviations of each: 1
        or less for noise of these kinds. If it is much more, none of the other numbers holds.
    """

    terms: NoiseTerms
    standard_deviations: dict[str, float]
    upper_bounds: dict[str, float]
    covariance: FloatArray
    rms_residual: float


def fit_noise_terms(allan: AllanDeviation, terms: Iterable[str] = TERMS) -> NoiseFit:
    """Find the noise terms behind an Allan deviation, and what it cannot tell.

    Parameters
    ----------
    allan : AllanDeviation
        Of one sensor, with at least as many averaging times as terms.
    terms : iterable of str
        Those that are sought, from `TERMS`; the others are taken to be zero.

    Returns
    -------
    NoiseFit
        With a standard deviation for each term that is seen, and an upper bound for each other.

    Raises
    ------
    ValueError
        If there are several sensors, too few averaging times, or unknown terms.

    See Also
    --------
    driftlab.allan.allan_deviation : What it fits.
    driftlab.gyrocompass.fit_gyro_noise : For the heading of a gyrocompass.

    Notes
    -----
    Least squares without negative terms, each point with the weight of its own degrees of freedom.
    But the points of an Allan plot share their samples, and thirty of them are worth far fewer
    independent ones: the deviations of the terms come from the covariance of all points under the
    fitted noise. A term is seen if its square is above twice its standard deviation; the
    weakest is dropped first, and the rest fitted again. An upper bound counts the other unseen
    terms as zero. An absent term is seen by mistake in a few records of a hundred; a weak one only
    where chance has made it larger, by two of its deviations if it is seldom seen. Noise of another
    kind, from an engine or the temperature of a day, is put on the nearest line all the same: look
    at the plot.

    References
    ----------
    - N. El-Sheimy, H. Hou, X. Niu, *Analysis and modeling of inertial sensors using Allan
      variance*, IEEE Transactions on Instrumentation and Measurement 57(1), 2008.

    Examples
    --------
    >>> from driftlab.allan import allan_deviation
    >>> noise = NoiseTerms(quantisation=1e-6, angle_random_walk=1e-6)
    >>> rates = noise.samples(20_000, 0.1, np.random.default_rng(1))
    >>> found = fit_noise_terms(allan_deviation(rates, 0.1))
    >>> print(f"{found.terms.angle_random_walk:.2e}", f"{found.terms.quantisation:.2e}")
    9.79e-07 9.99e-07
    >>> list(found.upper_bounds)
    ['bias_instability', 'rate_random_walk', 'rate_ramp']
    """
    found = checked_instance(
        allan, AllanDeviation, "allan", "from allan_deviation(rates, interval)"
    )
    sought = list(dict.fromkeys(some_of(terms, TERMS, "terms")))
    if found.deviation.ndim != 1:
        raise ValueError(
            "allan: expected that of one sensor, deviation of shape (k,), "
            f"got shape {found.deviation.shape}; take allan.row(0), say."
        )
    # One time that comes twice says no more than once.
    _, places = np.unique(found.averaging_times, return_index=True)
    places = places[found.deviation[places] > 0]
    if not sought or len(places) < len(sought):
        raise ValueError(
            "allan: expected at least as many averaging times with a deviation above zero as "
            f"terms, {max(len(sought), 1)} different ones, got {len(places)}."
        )
    times, freedom = found.averaging_times[places], found.degrees_of_freedom[places]
    counts = np.round(times / found.interval).astype(int)
    variance = found.deviation[places] ** 2
    points = core.Points(variance, freedom, counts, found.count, found.interval)
    kept, squares, covariance = core.fit_seen(points, sorted(map(TERMS.index, sought)))
    roots, spread = np.sqrt(squares), np.sqrt(np.diagonal(covariance))
    expected = core.term_variances(times) @ squares
    unseen = [name for name in sought if TERMS.index(name) not in kept]
    return NoiseFit(
        NoiseTerms(*map(float, roots)),
        {TERMS[i]: float(spread[i] / (2 * roots[i])) for i in kept},
        {
            name: float(np.sqrt(core.upper_bound(points, squares, TERMS.index(name), _BOUND)))
            for name in unseen
        },
        covariance,
        float(np.sqrt(np.mean((variance / expected - 1) ** 2 * freedom / 2))),
    )
