"""How many runs show that a filter states its errors too small."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gammaincinv

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.monte_carlo import mean_square_bounds

MOST_RUNS = 200
"""Drawn on the axis of the runs."""


def squared_errors(
    states: int = 27, runs: int = 60, factor: float = 1.1, seed: int = 12
) -> DataTable:
    """Draw normalised squared errors of runs, and their mean so far, with its 95 % bounds.

    `factor` is the true standard deviation of the errors divided by the stated one.
    """
    states = whole_number(states, "states", least=1)
    runs = whole_number(runs, "runs", least=1)
    factor = positive_number(factor, "factor")
    drawn = np.random.default_rng(seed).chisquare(states, MOST_RUNS if runs < MOST_RUNS else runs)
    each = factor**2 * drawn[:runs] / states
    count = np.arange(1.0, runs + 1)
    so_far = each.cumsum() / count
    all_counts = np.arange(1.0, max(runs, MOST_RUNS) + 1)
    low, high = (_quantile(p, states * all_counts) for p in (0.025, 0.975))
    part = (np.arange(1.0, 200) - 0.5) / 199
    bounds = [bound / states for bound in mean_square_bounds(states, runs)]
    mean = float(so_far[-1])
    verdict = "too large" if mean > bounds[1] else "too small" if mean < bounds[0] else "consistent"
    return DataTable(
        {
            "run": (count, "", "how many runs so far"),
            "mean_so_far": (so_far, "", "squared errors over expected, mean over the runs so far"),
            "runs_of_bounds": (all_counts, "", "how many runs"),
            "bound_low": (low, "", "95 % of the means of a consistent filter lie between these"),
            "bound_high": (high, "", "likewise"),
            "squared_error": (np.sort(each), "", "of one run, over expected"),
            "part_of_runs": ((count - 0.5) / runs, "", "with at most this squared error"),
            "of_a_consistent_filter": (_quantile(part, states), "", "squared error"),
            "part_expected": (part, "", "of the runs"),
            "expected": ([factor**2], "", "mean squared error to expect"),
        },
        {
            "mean": (mean, "", "mean squared error over expected"),
            "bounds": (bounds, "", "of this mean, 95 %"),
            "verdict": (verdict, "", "of the test"),
            "states": (states, "", "components"),
            "runs": (runs, "", "runs"),
        },
    )  # fmt: skip


def _quantile(probability: ArrayLike, degrees: ArrayLike) -> FloatArray:
    """Quantiles of a chi-square distribution over its degrees of freedom; no `scipy.stats`."""
    half = np.asarray(degrees) / 2
    return np.asarray(gammaincinv(half, probability) / half)
