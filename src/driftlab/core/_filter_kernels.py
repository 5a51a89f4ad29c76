"""Steps of a Kalman filter, as Numba compiles them: one number at a time.

Each goes through the formulas of a function of `driftlab.core.kalman` in the same order, so that
the two differ by rounding alone. Arrays are C-contiguous doubles; the caller sees to that.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ._kernels import compiled, inlined


@compiled
def predict(covariance: Any, transition: Any, noise: Any) -> Any:
    """`kalman.predict` for one filter."""
    size, moving = covariance.shape[1], transition.shape[0]
    rows = np.empty((moving, size))
    _multiply(transition, covariance, rows)
    grown = covariance.copy()
    grown[:moving] = rows
    for i in range(moving):
        for j in range(moving):
            grown[i, j] = _dot(rows[i], transition[j]) + noise[i, j]
    for j in range(moving, size):
        for i in range(moving):
            grown[j, i] = rows[i, j]
    return grown


@compiled
def correct_covariance(covariance: Any, observation: Any, noise: Any) -> Any:
    """`kalman.correct_covariance` for one filter, and whether the matrix to invert was regular."""
    many, size = observation.shape
    seen, spread = np.empty((many, size)), noise.copy()
    gain, weights = np.empty((size, many)), np.empty((many, many))
    _multiply(observation, covariance, seen)
    for i in range(many):
        for j in range(many):
            spread[i, j] += _dot(seen[i], observation[j])
    regular = _invert(spread, weights)
    after = covariance.copy()
    for i in range(size):
        for j in range(many):
            total = 0.0
            for k in range(many):
                total += seen[k, i] * weights[k, j]
            gain[i, j] = total
        row = after[i]
        for k in range(many):
            factor = gain[i, k]
            for j in range(size):
                row[j] -= factor * seen[k, j]
    for i in range(size):
        for j in range(i):
            mean = 0.5 * (after[i, j] + after[j, i])
            after[i, j] = mean
            after[j, i] = mean
    return after, gain, weights, regular


@compiled
def correct(covariance: Any, innovation: Any, observation: Any, noise: Any) -> Any:
    """`kalman.correct` for one filter, and whether the matrix to invert was regular."""
    after, gain, weights, regular = correct_covariance(covariance, observation, noise)
    correction = np.zeros(len(gain))
    nis = 0.0
    for j in range(len(innovation)):
        nis += innovation[j] * _dot(weights[j], innovation)
        for i in range(len(correction)):
            correction[i] += gain[i, j] * innovation[j]
    return correction, after, nis, regular


@compiled
def predict_each(covariances: Any, transitions: Any, noises: Any) -> Any:
    """`predict` for r filters; each argument has r runs or one for all."""
    runs = max(len(covariances), len(transitions), len(noises))
    found = np.empty((runs, *covariances.shape[1:]))
    for run in range(runs):
        found[run] = predict(
            covariances[run % len(covariances)],
            transitions[run % len(transitions)],
            noises[run % len(noises)],
        )
    return found


@compiled
def correct_covariance_each(covariances: Any, observations: Any, noises: Any) -> Any:
    """`correct_covariance` for r filters; each argument has r runs or one for all."""
    runs = max(len(covariances), len(observations), len(noises))
    many, size = observations.shape[1:]
    after, gain = np.empty((runs, size, size)), np.empty((runs, size, many))
    weights, regular = np.empty((runs, many, many)), True
    for run in range(runs):
        after[run], gain[run], weights[run], one = correct_covariance(
            covariances[run % len(covariances)],
            observations[run % len(observations)],
            noises[run % len(noises)],
        )
        regular = regular and one
    return after, gain, weights, regular


@inlined
def _multiply(a: Any, b: Any, found: Any) -> None:
    """Product of matrices (m, n) and (n, k); the rows of the first are often nearly empty."""
    found[:] = 0.0
    for i in range(a.shape[0]):
        for j in range(a.shape[1]):
            factor = a[i, j]
            if factor != 0.0:
                for k in range(b.shape[1]):
                    found[i, k] += factor * b[j, k]


@inlined
def _dot(a: Any, b: Any) -> float:
    """Sum of products; in four parts, none of which waits for the others."""
    total0, total1, total2, total3 = 0.0, 0.0, 0.0, 0.0
    whole = len(a) - len(a) % 4
    for k in range(0, whole, 4):
        total0 += a[k] * b[k]
        total1 += a[k + 1] * b[k + 1]
        total2 += a[k + 2] * b[k + 2]
        total3 += a[k + 3] * b[k + 3]
    for k in range(whole, len(a)):
        total0 += a[k] * b[k]
    return (total0 + total1) + (total2 + total3)


@inlined
def _invert(matrix: Any, inverse: Any) -> bool:
    """Gauss and Jordan with the largest pivots; says whether there were any. Spoils the matrix."""
    size = len(matrix)
    inverse[:] = 0.0
    for i in range(size):
        inverse[i, i] = 1.0
    for column in range(size):
        best = column
        for i in range(column + 1, size):
            if abs(matrix[i, column]) > abs(matrix[best, column]):
                best = i
        pivot = matrix[best, column]
        if pivot == 0.0:
            return False
        for k in range(size):
            chosen, other = matrix[best, k] / pivot, matrix[column, k]
            matrix[best, k], matrix[column, k] = other, chosen
            chosen, other = inverse[best, k] / pivot, inverse[column, k]
            inverse[best, k], inverse[column, k] = other, chosen
        for i in range(size):
            factor = matrix[i, column]
            if i != column and factor != 0.0:
                for k in range(size):
                    matrix[i, k] -= factor * matrix[column, k]
                    inverse[i, k] -= factor * inverse[column, k]
    return True
