"""Allan deviation of a sensor at rest, with its confidence.

The Allan deviation says by how much the means of two neighbouring stretches differ, over the
length of the stretches. Five kinds of noise make five straight lines on a double logarithmic plot:
`noise_terms` has them, and finds them in a record.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, positive_array, positive_number, probability
from .core import allan as core
from .core.quantiles import chi_squared_quantile

_GRID = 30
"""Averaging times, if none are given."""
_LONGEST = 4
"""The longest of them is this part of the record."""
_COLUMNS = 7
"""So few samples are columns: gyros, accelerometers, and the time or the temperature,"""
_ROWS = 100
"""where there are more rows than this."""


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
        """Return that of one of several sensors, by its place along each leading axis."""
        of_each = ("deviation", "lower", "upper", "degrees_of_freedom")
        return replace(self, **{name: getattr(self, name)[index] for name in of_each})


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
        Rates along the last axis, at least 3: rad/s, or any unit.
    interval : float
        Between samples, s.
    averaging_times : array_like, shape (k,), optional
        s, taken to the nearest whole number of samples, from one to half of them; by default some
        thirty in equal ratios, up to a quarter of the record.
    confidence : float
        Probability of each interval, between 0 and 1.

    Returns
    -------
    AllanDeviation
        Deviations, intervals, and the averaging times that were taken.

    Raises
    ------
    ValueError
        If there are fewer than three samples, sensors stand in columns, an averaging time is out of
        range, or the fourth powers of the samples' deviations are no numbers.

    See Also
    --------
    driftlab.noise_terms.fit_noise_terms : The noise terms behind it.

    Notes
    -----
    With the means :math:`\bar\omega_k` of m samples that begin with the k-th, and the averaging
    time :math:`\tau`, m times the interval, the deviation is the root of

    .. math:: \sigma^2(\tau) = \frac{1}{2 (n - 2m + 1)}
        \sum_{k=1}^{n - 2m + 1} \left( \bar\omega_{k+m} - \bar\omega_k \right)^2.

    The intervals are those of chi-square with equivalent degrees of freedom, as in W. Riley's
    Handbook of Frequency Stability Analysis, NIST SP 1065 (2008), section 5.3. To find these, the
    five terms of IEEE Std 952 are fitted first; then the variance of each point follows from the
    integral of the squared spectrum behind the Allan filter (P. Lesage, C. Audoin, IEEE
    Transactions on Instrumentation and Measurement 22, 1973). For pure terms this agrees with
    Table 5 of the handbook within some percent, or has fewer. The intervals hold for noise of these
    five kinds, and point by point: neighbours are made of the same samples and go astray together.

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
    confidence = probability(confidence, "confidence")
    grid = np.round(np.geomspace(1, max(1, length // _LONGEST), _GRID)).astype(int)
    counts = grid = np.unique(grid)
    if averaging_times is not None:
        counts = _whole_counts(averaging_times, step, length)
        grid = np.union1d(grid, counts)  # the noise is known by all of them
    all_variances = core.variances(rates, grid)
    sizes = np.sqrt(all_variances[all_variances > 0])
    if sizes.size and sizes.min() < 1e-60:
        raise ValueError(f"samples: expected deviations of at least 1e-60, got {sizes.min():.3g}.")
    freedom = np.empty_like(all_variances)
    for index in np.ndindex(rates.shape[:-1]):
        freedom[index] = core.degrees_of_freedom(all_variances[index], grid, length, step)
    chosen = np.searchsorted(grid, counts)
    variances, freedom = all_variances[..., chosen], freedom[..., chosen]
    tails = chi_squared_quantile(
        [[(1 + confidence) / 2], [(1 - confidence) / 2]], freedom.reshape(1, -1)
    )
    low, high = np.sqrt(variances * freedom / tails.reshape(2, *freedom.shape))
    return AllanDeviation(
        averaging_times=step * counts,
        deviation=np.sqrt(variances),
        lower=low,
        upper=high,
        degrees_of_freedom=freedom,
        interval=step,
        count=length,
    )


def _whole_counts(averaging_times: ArrayLike, interval: float, length: int) -> core.Counts:
    """Numbers of samples (k,) in averaging times (k,)."""
    times = np.atleast_1d(positive_array(averaging_times, "averaging_times"))
    # More than the record has are all alike too many, and may be more than a whole number holds.
    counts = np.round(np.minimum(times / interval, length)).astype(int)
    if times.ndim > 1 or counts.min() < 1 or counts.max() > length // 2:
        raise ValueError(
            f"averaging_times: expected shape (k,), from {interval:g} s to half of the record, "
            f"{length // 2 * interval:g} s, got shape {times.shape} from {times.min():g} s "
            f"to {times.max():g} s."
        )
    return counts
