"""Between which bounds the mean of many squared normalised errors lies by chance."""

from __future__ import annotations

import numpy as np

from driftlab.checks import probability, whole_number
from driftlab.core.quantiles import chi_squared_quantile


def mean_square_bounds(freedom: int, runs: int, confidence: float = 0.95) -> tuple[float, float]:
    """Confidence bounds of the mean of squared normalised errors over many runs.

    Parameters
    ----------
    freedom : int
        Number of components of each error.
    runs : int
        Number of independent runs over which the mean is taken.
    confidence : float
        Probability that the mean lies between the bounds, from 0 to 1.

    Returns
    -------
    lower, upper : float
        Bounds of the mean, without unit.

    Raises
    ------
    ValueError
        If `confidence` is not between 0 and 1.

    Notes
    -----
    If the errors are as large as their covariance states, the sum of the squared errors of all runs
    has a chi-square distribution with ``freedom * runs`` degrees of freedom. Both tails are equal.

    Examples
    --------
    >>> [round(bound, 3) for bound in mean_square_bounds(3, 100)]
    [2.539, 3.499]
    """
    inside, many = probability(confidence, "confidence"), whole_number(runs, "runs")
    tails = np.array([1 - inside, 1 + inside]) / 2
    low, high = chi_squared_quantile(tails, float(whole_number(freedom, "freedom")) * many) / many
    return float(low), float(high)
