"""Attitude by functional iteration: the arithmetic behind `driftlab.attitude`.

Over a window of N increments the rate is the polynomial of degree N - 1 that has these integrals.
The equation of the quaternion is then integrated by Picard's iterations, on the nodes of a Gauss
rule, so that an iteration is a product with one matrix.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from .vectors import components_first, components_last, cross

_MORE_NODES = 12  # besides one for each increment: they carry the bend of the rotation
_MOST_ITERATIONS = 60  # where they settle at all, half of them will do
_WINDOWS_AT_ONCE = 512  # few enough to stay in the processor's cache


class WindowSteps(NamedTuple):
    """Functional iteration over windows of so many increments, so often or until it settles."""

    window: int
    iterations: int | None


class Tables(NamedTuple):
    """Matrices of a window of N increments, with n nodes."""

    rate: FloatArray  # (n, N): increments to the rate at the nodes, rad in half a window
    until: FloatArray  # (n, n): a function at the nodes to its integrals up to each node
    over: FloatArray  # (N, n): a function at the nodes to its integrals over each sample


@cache
def tables(window: int) -> Tables:
    """Matrices of a window of so many increments; its time runs from -1 to 1."""
    from numpy.polynomial import legendre  # here, lest every attitude wait for it

    count = window + _MORE_NODES
    nodes, weights = legendre.leggauss(count)
    values = legendre.legvander(nodes, count - 1)
    # Legendre coefficients of a function at the nodes, by Gauss's rule: exact for polynomials.
    coefficients = (np.arange(count) + 0.5)[:, np.newaxis] * (weights[:, np.newaxis] * values).T
    over = np.diff(_integrals(np.linspace(-1.0, 1.0, window + 1), count), axis=0)
    rate = values[:, :window] @ np.linalg.inv(over[:, :window])
    return Tables(rate, _integrals(nodes, count) @ coefficients, over @ coefficients)


def _integrals(times: FloatArray, count: int) -> FloatArray:
    """Integrals (m, count) of Legendre's polynomials from -1 to each of m times."""
    from numpy.polynomial import legendre

    values = legendre.legvander(times, count)
    odd = 2 * np.arange(1, count) + 1
    return np.column_stack([times + 1, (values[:, 2:] - values[:, :-2]) / odd])


def step_rotation_vectors(
    increments: NDArray[Any], window: int, iterations: int | None = None
) -> NDArray[Any]:
    """Cayley vector k (..., n, 3) of the rotation over each of n increments (..., n, 3).

    There are at least as many as a window has. Those left over at the end make a window with the
    ones before them.
    """
    rows = components_first(increments)
    count, left = rows.shape[-1], rows.shape[-1] % window
    windows = rows[..., : count - left].reshape(*rows.shape[:-1], -1, window)
    if left:
        windows = np.concatenate([windows, rows[..., np.newaxis, -window:]], axis=-2)
    many = windows.reshape(3, -1, window)
    vectors = np.empty_like(many)
    for i in range(0, many.shape[1], _WINDOWS_AT_ONCE):
        some = np.s_[:, i : i + _WINDOWS_AT_ONCE]
        vectors[some] = _vectors_of_windows(many[some], iterations)
    found = vectors.reshape(*rows.shape[:-1], -1)
    if left:
        found = np.concatenate([found[..., : count - left], found[..., -left:]], axis=-1)
    return components_last(found)


def _vectors_of_windows(increments: NDArray[Any], iterations: int | None) -> NDArray[Any]:
    """Cayley vectors (3, m, N) of m windows of increments (3, m, N)."""
    kind = increments.dtype.type
    rate, until, over = (table.T.astype(kind) for table in tables(increments.shape[-1]))
    half_rate = kind(0.5) * (increments @ rate)
    vector, scalar = np.zeros_like(half_rate), np.ones_like(half_rate[0])
    eps, change = float(np.finfo(kind).eps), 0.0
    with np.errstate(over="ignore", invalid="ignore"):
        # The last iteration is the one over the samples, below.
        for _ in range(_MOST_ITERATIONS if iterations is None else iterations - 1):
            turned, shrunk = _derivative(vector, scalar, half_rate)
            turned, shrunk = turned @ until, kind(1) + shrunk @ until
            change = max(np.abs(turned - vector).max(), np.abs(shrunk - scalar).max())
            vector, scalar = turned, shrunk
            if iterations is None and change <= 4 * eps:
                break
    if not change < (np.inf if iterations else 1e3 * eps):
        raise _unsettled(half_rate)
    turned, shrunk = _derivative(vector, scalar, half_rate)
    return _vectors_of_samples(turned @ over, shrunk @ over)


def _derivative(
    vector: NDArray[Any], scalar: NDArray[Any], half_rate: NDArray[Any]
) -> tuple[NDArray[Any], NDArray[Any]]:
    """Quaternion times half the rate."""
    return scalar * half_rate + cross(vector, half_rate), -(vector * half_rate).sum(axis=0)


def _vectors_of_samples(turned: NDArray[Any], shrunk: NDArray[Any]) -> NDArray[Any]:
    """Cayley vectors (3, m, N) from what each sample adds to the quaternion, (3, m, N), (m, N).

    That is conj(q)∘(q + added) for the quaternion q before the sample. As |q|² + conj(q)∘added it
    keeps the digits of a small rotation.
    """
    vector = np.cumsum(turned, axis=-1) - turned
    scalar = turned.dtype.type(1) + np.cumsum(shrunk, axis=-1) - shrunk
    sine = scalar * turned - shrunk * vector - cross(vector, turned)
    cosine = (vector * (vector + turned)).sum(axis=0) + scalar * (scalar + shrunk)
    return -sine / (np.sqrt((sine**2).sum(axis=0) + cosine**2) + cosine)


def _unsettled(half_rate: NDArray[Any]) -> ValueError:
    fitted = 4 * np.sqrt((half_rate.astype(float) ** 2).sum(axis=0).max())
    return ValueError(
        "increments: expected angles that a polynomial fits, turning by some 20 rad a window or "
        f"less, got a fit that turns as fast as {fitted:.3g} rad a window."
    )
