"""Fits of the noise terms behind Allan variances; `squares` (5,) are as in `core.allan`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import nnls
from scipy.special import ndtri

from driftlab.checks import FloatArray

from .allan import Counts, covariance, term_variances

_ROUNDS = 30
"""Rounds of reweighting at most; some ten settle it to a thousandth."""


class Points(NamedTuple):
    """Allan variances (k,) above zero, their degrees of freedom (k,), numbers of samples (k,).

    Of a record of `length` samples, `interval` seconds apart.
    """

    variance: FloatArray
    freedom: FloatArray
    counts: Counts
    length: int
    interval: float


def fit(points: Points, terms: list[int]) -> tuple[FloatArray, FloatArray]:
    """Squares (5,) of the terms that fit variances (k,) best, and their covariance (5, 5).

    None is negative, and those not in `terms` are zero. Each variance has the weight of its own
    deviation, under the fit and not as found, which would favour the small ones. Weights by the
    whole covariance would gain little, and run off when the noise is of another kind.
    """
    variance, freedom, counts, length, interval = points
    curves = term_variances(interval * counts)[:, terms]
    squares, deviation = np.zeros(5), variance * np.sqrt(2 / freedom)
    for done in range(_ROUNDS):
        before = squares.copy()
        columns, sizes = _weighted(curves, deviation)
        scaled, _ = nnls(columns, variance / deviation)
        squares[terms] = scaled / sizes
        if np.allclose(squares, before, rtol=1e-3, atol=0.0):
            break
        # Half of a step later on, because whole ones may swing.
        middle = (squares + before) / 2 if done > _ROUNDS // 3 else squares
        spread = _full_rank(covariance(middle, counts, length, interval), counts, middle, interval)
        deviation = np.sqrt(np.diagonal(spread))
    solve = np.linalg.pinv(columns) / (sizes[:, None] * deviation)
    uncertainty = np.zeros((5, 5))
    uncertainty[np.ix_(terms, terms)] = solve @ spread @ solve.T
    return squares, uncertainty


def fit_seen(points: Points, terms: list[int]) -> tuple[list[int], FloatArray, FloatArray]:
    """The terms above twice their deviation, at least one, their squares and their covariance.

    The weakest is dropped first, and the rest fitted again.
    """
    kept = list(terms)
    while True:
        squares, uncertainty = fit(points, kept)
        strength = [squares[i] / np.sqrt(uncertainty[i, i]) for i in kept]
        if len(kept) == 1 or min(strength) >= 2:
            return kept, squares, uncertainty
        kept.pop(int(np.argmin(strength)))


def degrees_of_freedom(
    found: FloatArray, counts: Counts, length: int, interval: float
) -> FloatArray:
    """Equivalent degrees of freedom (k,) of Allan variances (k,), by the terms that fit them."""
    # Those of a random walk, which has the fewest.
    least = np.maximum((length - 2 * counts) / counts, 1.0)
    seen = found > 0
    if not seen.any():
        return least
    points = Points(found[seen], least[seen], counts[seen], length, interval)
    squares, _ = fit(points, list(range(5)))
    if not squares[:4].any():
        return least
    expected = term_variances(interval * counts) @ squares
    spread = np.diagonal(covariance(squares, counts, length, interval))
    return np.maximum(2 * expected**2 / spread, 1.0)


def upper_bound(points: Points, squares: FloatArray, term: int, probability: float) -> float:
    """Square of a term that these variances would hardly fall short of by chance.

    It is beside terms with `squares` (5,): the largest that is not further above its estimate
    than by the normal quantile, in deviations that it would have itself.
    """
    variance, _, counts, length, interval = points
    quantile, bound = float(ndtri(probability)), 0.0
    curves = term_variances(interval * counts)
    columns = [*np.flatnonzero(squares), term]
    for _ in range(_ROUNDS):
        before, trial = bound, squares.copy()
        trial[term] = bound
        spread = _full_rank(covariance(trial, counts, length, interval), counts, trial, interval)
        deviation = np.sqrt(np.diagonal(spread))
        weighted, sizes = _weighted(curves[:, columns], deviation)
        row = np.linalg.pinv(weighted)[-1] / (sizes[-1] * deviation)
        bound = float(max(row @ variance, 0.0) + quantile * np.sqrt(row @ spread @ row))
        if abs(bound - before) < 1e-3 * bound:
            break
    return bound


def _weighted(curves: FloatArray, deviation: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Curves (k, n) in units of the deviations (k,), scaled to norm one, and those norms (n,).

    The squares may lie twenty powers of ten apart.
    """
    columns = curves / deviation[:, None]
    sizes = np.linalg.norm(columns, axis=0)
    return columns / sizes, sizes


def _full_rank(
    spread: FloatArray, counts: Counts, squares: FloatArray, interval: float
) -> FloatArray:
    """A covariance with a little noise in each variance: a ramp alone has none."""
    expected = term_variances(interval * counts) @ squares
    floored: FloatArray = spread + np.diag(1e-10 * expected**2)
    return floored
