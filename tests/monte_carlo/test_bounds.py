"""Bounds of the mean of squared normalised errors, which chi-square numbers keep to."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.stats import binom, chi2, norm

from driftlab.monte_carlo import mean_square_bounds


@given(freedom=st.integers(1, 60), runs=st.integers(1, 1000), confidence=st.floats(0.01, 0.999))
def test_bounds_keep_equal_tails_outside(freedom, runs, confidence):
    low, high = mean_square_bounds(freedom, runs, confidence)
    tail = (1 - confidence) / 2
    assert chi2.cdf(runs * low, freedom * runs) == pytest.approx(tail, rel=1e-6)
    assert chi2.sf(runs * high, freedom * runs) == pytest.approx(tail, rel=1e-6)
    assert (type(low), type(high)) == (float, float)


def test_bounds_are_those_of_tables():
    """Chi-square of 10 degrees: 2.5 % below 3.247 and above 20.483; 0.5 %: 2.156 and 25.188."""
    assert mean_square_bounds(10, 1) == pytest.approx((3.247, 20.483), abs=5e-4)
    assert mean_square_bounds(5, 2) == pytest.approx((3.247 / 2, 20.483 / 2), abs=5e-4)
    assert mean_square_bounds(1, 10, 0.99) == pytest.approx((0.2156, 2.5188), abs=5e-5)


def test_bounds_are_nearly_normal_for_many_runs():
    """The mean of n squares of m components has the mean m and the variance 2 m/n."""
    low, high = mean_square_bounds(27, 10_000)
    most = norm.isf(0.025) * np.sqrt(2 * 27 / 10_000)
    assert (high - low) / 2 == pytest.approx(most, rel=1e-3)
    # The middle is moved by the third moment: 2/3 of z^2 - 1, over n.
    assert (high + low) / 2 - 27 == pytest.approx(
        2 / 3 * (norm.isf(0.025) ** 2 - 1) / 1e4, rel=0.01
    )


def test_simulated_errors_keep_to_the_bounds():
    rng = np.random.default_rng(6)
    repeats, freedom, runs = 4000, 3, 20
    squares = (rng.standard_normal((repeats, runs, freedom)) ** 2).sum(axis=-1)
    low, high = mean_square_bounds(freedom, runs, 0.9)
    means = squares.mean(axis=-1)
    for outside in (means < low, means > high):
        # 5 % on each side: binomial, with one in a hundred of the tests kept out.
        assert abs(outside.sum() - 200) <= binom.ppf(0.995, repeats, 0.05) - 200


@pytest.mark.parametrize("confidence", [0, 1, -0.5, 1.5, float("nan")])
def test_confidences_that_are_none_are_refused(confidence):
    with pytest.raises(
        ValueError, match=r"^confidence: expected (a number between 0 and 1|finite numbers), got"
    ):
        mean_square_bounds(3, 10, confidence)
