"""Allan deviation of a sensor at rest, and the noise terms that can be read from it.

The Allan deviation says by how much the means of two neighbouring stretches differ, over the
length of the stretches. Five kinds of noise make five straight lines on a double logarithmic plot;
they are the terms of IEEE Std 952.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import chi2

from .checks import (
    FloatArray,
    checked_instance,
    finite_array,
    positive_array,
    positive_number,
    probability,
    some_of,
)
from .core import allan as core
from .noise_terms import TERMS, NoiseTerms

__all__ = [
    "TERMS",
    "AllanDeviation",
    "NoiseFit",
    "NoiseTerms",
    "allan_deviation",
    "fit_noise_terms",
]

_GRID = 30
"""Averaging times, if none are given."""
_LONGEST = 4
"""The longest of them is this part of the record."""
_COLUMNS = 7
"""So few samples are columns: gyros, accelerometers, and the time or the temperature,"""
_ROWS = 100
"""where there are more rows than this."""
_BOUND = 0.95
"""Probability that stands behind an upper bound."""


@dataclass(frozen=True)
class AllanDeviation:
    """Allan deviation of a record, or of several of equal length, with confidence intervals.

    Attributes
    ----------
    averaging_times : ndarray, shape (k,)
        s.
    deviation : ndarray, shape (..., k)
        In the unit of the samples.
    lower, upper : ndarray, shape (..., k)
        Ends of the confidence interval.
    degrees_of_freedom : ndarray, shape (..., k)
        Equivalent ones, of the variance.
    interval : float
        Of the samples, s.
    count : int
        Number of samples.
    """

    averaging_times: FloatArray
    deviation: FloatArray
    lower: FloatArray
    upper: FloatArray
    degrees_of_freedom: FloatArray
    interval: float
    count: int

    def row(self, *index: int) -> AllanDeviation:
        """Return that of one of several sensors.

        Parameters
        ----------
        *index : int
            Places along the leading axes of the samples.

        Returns
        -------
        AllanDeviation
            With arrays (k,) if there is an index for each leading axis.

        Examples
        --------
        >>> three = allan_deviation(np.random.default_rng(1).normal(size=(3, 1000)), 0.1)
        >>> three.deviation.shape == (3, *three.row(0).deviation.shape)
        True
        """
        return replace(
            self,
            deviation=self.deviation[index],
            lower=self.lower[index],
            upper=self.upper[index],
            degrees_of_freedom=self.degrees_of_freedom[index],
        )


def allan_deviation(
    samples: ArrayLike,
    interval: float,
    averaging_times: ArrayLike | None = None,
    *,
    confidence: float = 0.683,
) -> AllanDeviation:
    r"""Overlapping Allan deviation of equally spaced rates, with its confidence.

    Parameters
    ----------
    samples : array_like, shape (..., n)
        Rates, at least 3, along the last axis: rad/s, or any unit. Increments of angle are rates
        times the interval.
    interval : float
        Between samples, s.
    averaging_times : array_like, shape (k,), optional
        s, taken to the nearest whole number of samples, from one to half of them. If not given,
        some thirty in equal ratios, up to a quarter of the record.
    confidence : float
        Probability of each interval, between 0 and 1.

    Returns
    -------
    AllanDeviation
        With the averaging times that were taken.

    Raises
    ------
    ValueError
        If there are fewer than three samples, sensors stand in columns, an averaging time is out of
        range, or the samples are so small or large that the fourth powers of their deviations are
        no numbers.

    See Also
    --------
    fit_noise_terms : The noise terms behind it.
    driftlab.noise_terms.NoiseTerms : What they are, and samples of them.

    Notes
    -----
    With the means :math:`\bar\omega_k` of m samples that begin with the k-th, and the averaging
    time :math:`\tau`, m times the interval, the deviation is the root of

    .. math:: \sigma^2(\tau) = \frac{1}{2 (n - 2m + 1)}
        \sum_{k=1}^{n - 2m + 1} \left( \bar\omega_{k+m} - \bar\omega_k \right)^2.

    The intervals are those of chi-square with equivalent degrees of freedom, as in W. Riley's
    Handbook of Frequency Stability Analysis, NIST SP 1065 (2008), section 5.3. How many there are
    depends on the noise. Here the five terms are fitted first; then the variance of each point
    follows from the integral of the squared spectrum behind the Allan filter (P. Lesage, C. Audoin,
    IEEE Transactions on Instrumentation and Measurement 22, 1973). For pure terms this agrees with
    Table 5 of the handbook within some percent, or has fewer. No time has
    less than one. The intervals hold for noise of these five kinds, and point by point: neighbours
    are made of the same samples and go astray together.

    References
    ----------
    - IEEE, *IEEE Standard Specification Format Guide and Test Procedure for Single-Axis
      Interferometric Fiber Optic Gyros*, IEEE Std 952, 1997.
    - N. El-Sheimy, H. Hou, X. Niu, *Analysis and modeling of inertial sensors using Allan
      variance*, IEEE Transactions on Instrumentation and Measurement 57(1), 2008.

    Examples
    --------
    White noise falls with the square root of the averaging time:

    >>> rates = np.random.default_rng(1).normal(size=100_000)
    >>> found = allan_deviation(rates, 0.01, [0.01, 1.0, 100.0])
    >>> found.deviation.round(3)
    array([1.   , 0.097, 0.009])
    >>> bool((found.lower < [1.0, 0.1, 0.01]).all() and (found.upper > 0.01).all())
    True
    """
    rates = np.atleast_1d(finite_array(samples, "samples"))
    step, length = positive_number(interval, "interval"), rates.shape[-1]
    if rates.ndim > 1 and length <= _COLUMNS and rates.shape[-2] > _ROWS:
        raise ValueError(
            f"samples: expected shape (..., n), the samples of a sensor along the last axis, got "
            f"{rates.shape}: are they rows of {length} sensors? Hand in samples.T, or one column."
        )
    if length < 3:
        raise ValueError(f"samples: expected shape (..., n), n at least 3, got {rates.shape}.")
    probability(confidence, "confidence")
    grid = np.round(np.geomspace(1, max(1, length // _LONGEST), _GRID)).astype(int)
    counts = grid = np.unique(grid)
    if averaging_times is not None:
        counts = _whole_counts(averaging_times, step, length)
        grid = np.union1d(grid, counts)  # the noise is known by all of them
    with np.errstate(over="ignore"):  # refused below
        all_variances = core.variances(rates, grid)
    sizes = np.sqrt(all_variances[all_variances > 0])
    if sizes.size and not 1e-60 < sizes.min() <= sizes.max() < 1e60:
        ends = f"{sizes.min():.3g} to {sizes.max():.3g}"
        raise ValueError(f"samples: expected deviations between 1e-60 and 1e60, got {ends}.")
    freedom = np.empty_like(all_variances)
    for index in np.ndindex(rates.shape[:-1]):
        freedom[index] = core.degrees_of_freedom(all_variances[index], grid, length, step)
    chosen = np.searchsorted(grid, counts)
    variances, freedom = all_variances[..., chosen], freedom[..., chosen]
    tails = chi2.ppf([[(1 + confidence) / 2], [(1 - confidence) / 2]], freedom.reshape(1, -1))
    low, high = np.sqrt(variances * freedom / tails.reshape(2, *freedom.shape))
    return AllanDeviation(step * counts, np.sqrt(variances), low, high, freedom, step, length)


@dataclass(frozen=True)
class NoiseFit:
    """Noise terms that fit an Allan deviation.

    Attributes
    ----------
    terms : NoiseTerms
        What the record shows; zero for a term that it does not show.
    deviations : dict of str to float
        Standard deviations of the terms that it shows.
    upper_bounds : dict of str to float
        For each term that was sought and is not seen: with 95 % probability it is smaller.
        Infinite if the record is too short to say anything.
    covariance : ndarray, shape (5, 5)
        Of the squared coefficients, in the order of `TERMS`; zero for terms that are not seen.
    misfit : float
        Root mean square of the points' distances from the fit, in standard deviations of each: 1
        or less for noise of these kinds. If it is much more, none of the other numbers holds.
    """

    terms: NoiseTerms
    deviations: dict[str, float]
    upper_bounds: dict[str, float]
    covariance: FloatArray
    misfit: float


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
    allan_deviation : What it fits.
    driftlab.gyrocompass.fit_gyro_noise : For the heading of a gyrocompass.

    Notes
    -----
    Least squares without negative terms, each point with the weight of its own degrees of freedom.
    But the points of an Allan plot share their samples, and thirty of them are worth far fewer
    independent ones: the deviations of the terms come from the covariance of all points under the
    fitted noise. A term is seen if its square is above twice its standard deviation; the
    weakest is dropped first, and the rest fitted again. An upper bound counts the other unseen
    terms as zero. An absent term is seen by mistake in a few records of a hundred; a weak one only
    where chance has made it larger, by two of its deviations if it is seldom seen. All of this is
    good for noise of these five kinds. What is none, an engine's shaking or the temperature of a
    day, is put on the nearest line all the same: look at the plot.

    References
    ----------
    - IEEE, *IEEE Standard Specification Format Guide and Test Procedure for Single-Axis
      Interferometric Fiber Optic Gyros*, IEEE Std 952, 1997.
    - N. El-Sheimy, H. Hou, X. Niu, *Analysis and modeling of inertial sensors using Allan
      variance*, IEEE Transactions on Instrumentation and Measurement 57(1), 2008.

    Examples
    --------
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


def _whole_counts(averaging_times: ArrayLike, interval: float, length: int) -> core.Counts:
    """Numbers of samples (k,) in averaging times (k,)."""
    times = np.atleast_1d(positive_array(averaging_times, "averaging_times"))
    counts = np.round(times / interval).astype(int)
    if times.ndim > 1 or counts.min() < 1 or counts.max() > length // 2:
        raise ValueError(
            f"averaging_times: expected shape (k,), from {interval:g} s to half of the record, "
            f"{length // 2 * interval:g} s, got shape {times.shape} from {times.min():g} s "
            f"to {times.max():g} s."
        )
    return counts
