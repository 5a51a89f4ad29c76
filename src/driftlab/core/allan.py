"""Allan variances of a record, how uncertain they are together, and the noise terms behind them.

The noise of a rate has five terms; their squared coefficients are called `squares` (5,) here:
quantisation, angle random walk, bias instability, rate random walk, rate ramp.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from driftlab.checks import FloatArray

Counts = NDArray[np.int_]

_BLOCK = 2**15  # numbers
_FREQUENCIES = 2000
"""Places of the integrals over frequency, in equal ratios; more change them by a tenth at most."""
_ROUNDS = 30
"""Rounds of reweighting at most; some ten settle it to a thousandth."""


def variances(samples: FloatArray, counts: Counts) -> FloatArray:
    """Overlapping Allan variances (..., k) of rates (..., n) for means of k numbers of samples."""
    *lead, length = samples.shape
    sums = np.zeros((*lead, length + 1))
    # Without the mean the sums stay small, and keep their digits in long records.
    np.subtract(samples, samples.mean(axis=-1, keepdims=True), out=sums[..., 1:])
    np.cumsum(sums[..., 1:], axis=-1, out=sums[..., 1:])
    found = np.zeros((*lead, len(counts)))
    # Block by block, so that the differences never leave the processor's cache.
    size = max(_BLOCK // math.prod(lead), 1)
    room = np.empty((*lead, min(size, length)))
    for i, m in enumerate(counts):
        many = length + 1 - 2 * m
        for begin in range(0, many, size):
            end = min(begin + size, many)
            first, middle, last = (sums[..., begin + k : end + k] for k in (0, m, 2 * m))
            step = np.subtract(last, middle, out=room[..., : end - begin])
            step -= middle
            step += first
            found[..., i] += np.einsum("...i,...i->...", step, step)
        found[..., i] /= 2.0 * m**2 * many
    return found


def term_variances(times: NDArray[np.floating[Any]]) -> FloatArray:
    """Allan variances (..., 5) of the five terms with coefficients of one."""
    flat = np.full_like(times, 2 * np.log(2) / np.pi)
    return np.stack([3 / times**2, 1 / times, flat, times / 3, times**2 / 2], axis=-1)


def covariance(squares: FloatArray, counts: Counts, length: int, interval: float) -> FloatArray:
    """Covariance (k, k) of the Allan variances of a record whose noise has these terms.

    A variance is a mean of squares of the rate after a filter. For normal noise of one-sided
    density S, means over a time T of two filters' squares have the covariance of the integral of
    S^2 H_i H_j over frequency, divided by T. That is a little more than the truth where T is not
    much longer than what the filters remember. A ramp adds its product with the mean of the noise.
    """
    f, width, response, averaging = _filters(tuple(counts), length, interval)
    q, n, b, k, ramp = squares
    folded = 8 * q * np.sin(np.pi * f * interval) ** 2 / interval
    density = folded + 2 * n + b / (np.pi * f) + k / (2 * (np.pi * f) ** 2)
    averaged = interval * (length + 1 - 2 * counts)  # s, for each variance
    both = np.sqrt(averaged[:, None] * averaged)
    power = response**2 * density
    found = (power * width) @ power.T / both
    if ramp:
        offset = np.sqrt(ramp / 2) * interval * counts
        mean = response * averaging
        found += 4 * np.outer(offset, offset) * ((mean * density * width) @ mean.T)
    return found


@lru_cache(maxsize=4)
def _filters(counts: tuple[int, ...], length: int, interval: float) -> tuple[FloatArray, ...]:
    """Frequencies (n,), their shares of the axis (n,), the Allan filters and the means' (k, n)."""
    # Below a tenth of 1/T nothing is left: all filters go to zero with the frequency.
    edges = np.geomspace(0.1 / (length * interval), 0.5 / interval, _FREQUENCIES + 1)
    f = np.sqrt(edges[1:] * edges[:-1])
    number = np.array(counts)[:, None]
    swing = np.sin(np.pi * f * interval * number) ** 2
    response = np.sqrt(2) * swing / (number * np.sin(np.pi * f * interval))
    return f, np.diff(edges), response, np.sinc(f * interval * (length + 1 - 2 * number))


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
    from scipy.optimize import nnls  # here, lest every Allan deviation wait for it

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
