"""Allan variances of a record, and how uncertain they are together.

The noise of a rate has five terms; their squared coefficients are called `squares` (5,) here:
quantisation, angle random walk, bias instability, rate random walk, rate ramp.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

Counts = NDArray[np.int_]

_BLOCK = 2**15  # numbers
_FREQUENCIES = 2000
"""Places of the integrals over frequency, in equal ratios; more change them by a tenth at most."""


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
