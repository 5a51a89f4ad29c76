"""Quantiles, by `scipy.special`: to load the same from `scipy.stats` takes longer."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike
from scipy.special import gammaincinv

from driftlab.checks import FloatArray


def chi_squared_quantile(probability: ArrayLike, freedom: float | FloatArray) -> Any:
    """What a chi-squared variable of so many degrees of freedom stays below, shapes broadcast."""
    return 2.0 * gammaincinv(0.5 * freedom, probability)
