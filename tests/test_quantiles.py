"""Quantiles are those of SciPy's distributions, digit for digit."""

import numpy as np
from scipy.stats import chi2

from driftlab.core.quantiles import chi_squared_quantile


def test_quantiles_are_those_of_scipys_distribution():
    probability = np.array([1e-12, 0.025, 0.5, 0.975, 1 - 1e-12])
    freedom = np.geomspace(0.5, 1e8, 60)
    np.testing.assert_array_equal(
        chi_squared_quantile(probability, freedom[:, np.newaxis]),
        chi2.ppf(probability, freedom[:, np.newaxis]),
    )


def test_as_much_lies_below_as_is_asked():
    freedom = np.array([1.0, 2.0, 27.0])
    below = chi2.cdf(chi_squared_quantile(0.9, freedom), freedom)
    np.testing.assert_allclose(below, 0.9, rtol=1e-12)
    # Two degrees of freedom are an exponential distribution.
    np.testing.assert_allclose(chi_squared_quantile(0.9, 2.0), -2 * np.log(0.1), rtol=1e-14)
