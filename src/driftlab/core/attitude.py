"""Attitude from angle increments: the arithmetic behind `driftlab.attitude`."""

from __future__ import annotations

from collections.abc import Callable
from itertools import groupby
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from . import functional_iteration
from .coning import ConingSteps
from .functional_iteration import WindowSteps
from .quaternion import cumulative_product, from_rotation_vector, multiply
from .vectors import components_first, components_last, cross

NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])


def rotation_quaternion(k: FloatArray) -> FloatArray:
    """Unit quaternion (..., 4) of a Cayley vector k (..., 3) = -tan(phi/4) e."""
    # Numerator and denominator are divided by the largest entry: its square may overflow.
    size = np.maximum(np.abs(k).max(axis=-1, keepdims=True), 1.0)
    k, one = k / size, 1 / size
    square = np.sum(k**2, axis=-1, keepdims=True)
    quaternion = np.concatenate([-2 * one * k, one**2 - square], axis=-1)
    return quaternion / (one**2 + square)


def attitudes(
    algorithm: ConingSteps | WindowSteps,
    increments: FloatArray,
    past: int = 0,
    first: FloatArray = NO_TURN,
    product: Callable[[FloatArray], FloatArray] = cumulative_product,
) -> FloatArray:
    """Attitude (..., m, 4) after each step, from `first` (..., 4); see `step_rotation_vectors`."""
    steps = step_quaternions(algorithm, increments, past)
    lead = np.broadcast_shapes(first.shape[:-1], steps.shape[:-2])
    if lead != steps.shape[:-2]:
        steps = np.broadcast_to(steps, (*lead, *steps.shape[-2:])).copy()
    steps[..., 0, :] = multiply(first, steps[..., 0, :])
    return product(steps)


def step_quaternions(
    algorithm: ConingSteps | WindowSteps, increments: FloatArray, past: int = 0
) -> FloatArray:
    """Rotation (..., m, 4) over each step; arguments as in `step_rotation_vectors`."""
    vectors = step_rotation_vectors(algorithm, increments, past)
    if isinstance(algorithm, ConingSteps) and algorithm.last_stage == "rotation vector":
        return from_rotation_vector(vectors)
    return rotation_quaternion(vectors)


def step_rotation_vectors(
    algorithm: ConingSteps | WindowSteps, increments: NDArray[Any], past: int = 0
) -> NDArray[Any]:
    """Vector (..., m, 3) of each step: k, or the rotation vector; of the increments (..., n, 3) the
    first `past` are history."""
    if isinstance(algorithm, WindowSteps):
        return functional_iteration.step_rotation_vectors(increments, *algorithm)
    kind, m = increments.dtype.type, algorithm.samples
    # Components first, so that everything but a cross product is plain arithmetic.
    rows = np.ascontiguousarray(components_first(increments))
    if algorithm.memory:
        gamma, coning = rows[..., past:], _coning_with_memory(algorithm, rows, past)
    else:
        places = [rows[..., i::m] for i in range(m)]
        gamma, coning = sum(places[1:], places[0]), _weighted(algorithm.products(), places)
    stage, corrected = algorithm.last_stage, gamma + coning
    if stage == "rotation vector":
        return components_last(corrected)
    square = (gamma**2).sum(axis=0)
    refuse_whole_turns(float(square.max()))
    if stage == "first iterate":
        return components_last(kind(-1 / 4) * gamma)
    if stage == "tangent":
        square = (corrected**2).sum(axis=0)
        return components_last((kind(-1 / 4) - kind(1 / 192) * square) * corrected)
    vectors = kind(-1 / 4) * corrected - kind(1 / 192) * square * gamma
    if stage == "second iterate":
        # What the second iterate still has and the third removes.
        vectors -= kind(1 / 32) * cross(gamma, coning)
    return components_last(vectors)


def refuse_whole_turns(square: float) -> None:
    """Refuse a step whose sum of increments has this square, where that is too far."""
    if not square < 4 * np.pi**2:
        raise turns_too_far(float(np.sqrt(square)))


def turns_too_far(angle: float) -> ValueError:
    """The refusal of a step whose vector k would be infinite."""
    return ValueError(
        "increments: expected less than a whole turn a step, where the true k is infinite, "
        f"got {angle:.3g} rad."
    )


def _weighted(products: list[tuple[int, int, float]], places: list[NDArray[Any]]) -> NDArray[Any]:
    """Sum of weight * g_i × g_j, where `places` holds the g (3, ...) at each place of the window.

    Cross products with a common right factor are summed before they are multiplied out.
    """
    kind = places[0].dtype.type
    total = np.zeros_like(places[0])
    for j, those in groupby(products, key=itemgetter(1)):
        total += cross(sum(kind(weight) * places[i] for i, _, weight in those), places[j])
    return total


def _coning_with_memory(algorithm: ConingSteps, rows: NDArray[Any], past: int) -> NDArray[Any]:
    """Coning correction (3, ..., n) of an algorithm whose step is one increment."""
    window, last = range(algorithm.memory + 1), rows.shape[-1] - algorithm.memory
    coning = _weighted(algorithm.products(), [rows[..., i : last + i] for i in window])
    if past:
        return coning
    first = [rows[..., i : i + 1] for i in window]
    starts = [_weighted(algorithm.products(i), first) for i in range(algorithm.memory)]
    return np.concatenate([*starts, coning], axis=-1)
