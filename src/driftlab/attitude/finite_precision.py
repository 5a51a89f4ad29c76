"""Effect of a short floating-point word on an attitude that is computed step by step.

Perelyaev and Chelnokov remark, at the end of section 1, that the scalar part l0 of a step's
quaternion is so close to 1 that a short word loses the difference, and advise to use 1 - l0
instead. (The letter is lost in the copy at hand; l0 is a reading.) Here all arithmetic runs in the
requested precision, in the order in which an on-board computer would do it, so that the advice can
be compared with its alternatives.
"""

from __future__ import annotations

from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from driftlab.checks import finite_array, finite_arrays, one_of, truth_value, unit_quaternions

from .coning_algorithms import Algorithm, AnyAlgorithm, checked_algorithm
from .integration import step_rotation_vectors

Update = Literal["product", "small terms first", "complement", "compensated"]
UPDATES: tuple[Update, ...] = get_args(Update)
"""Orders of summation when a step is multiplied to the attitude; see `integrate_finite_word`."""


def step_finite_word(vectors: NDArray[Any], *, rotation_vector: bool = False) -> NDArray[Any]:
    """Quaternion of each step, and 1 minus its scalar part, in the precision of `vectors`.

    Parameters
    ----------
    vectors : ndarray, shape (..., 3)
        Cayley vector k = -tan(phi/4) e of each step, in any floating dtype.
    rotation_vector : bool
        Whether `vectors` are rotation vectors (rad) instead.

    Returns
    -------
    ndarray, shape (..., 5)
        Vector part, scalar part l0, and 1 - l0 = 2|k|²/(1 + |k|²), which does not lose its digits
        for small steps. In the dtype of `vectors`.

    Raises
    ------
    ValueError
        If `vectors` are not floating numbers, or a square overflows.

    Examples
    --------
    In single precision the scalar part of a small step is 1, and 1 - l0 is kept beside it:

    >>> step = step_finite_word(np.array([1e-4, 0.0, 0.0], np.float32))
    >>> float(step[3]), f"{step[4]:.1e}"
    (1.0, '2.0e-08')
    """
    finite_array(vectors, "vectors", 3)
    vectors = np.asarray(vectors)
    kind = vectors.dtype.type
    with np.errstate(over="ignore"):
        square = (vectors[..., 0] ** 2 + vectors[..., 1] ** 2 + vectors[..., 2] ** 2)[..., None]
    if vectors.dtype.kind != "f" or not np.isfinite(square).all():
        raise ValueError(
            "vectors: expected floating numbers whose squares are finite, "
            f"got {vectors.dtype} up to {np.abs(vectors).max():g}."
        )
    if rotation_vector:
        half = kind(0.5) * np.sqrt(square)
        vector = vectors * (kind(0.5) * np.sinc(half / kind(np.pi)))
        complement = kind(2) * np.sin(half / kind(2)) ** 2
        return np.concatenate([vector, np.cos(half), complement], axis=-1)
    scale = kind(2) / (kind(1) + square)
    complement = scale * square
    # The other way round, (1 - |k|²)/(1 + |k|²) would round three times near 1.
    return np.concatenate([-scale * vectors, kind(1) - complement, complement], axis=-1)


def integrate_finite_word(
    increments: ArrayLike,
    algorithm: AnyAlgorithm = "two-step-4",
    *,
    start: ArrayLike = (0.0, 0.0, 0.0, 1.0),
    word: DTypeLike = np.float32,
    update: Update = "product",
    fused: bool = False,
    normalise: bool = False,
) -> NDArray[Any]:
    """Attitude after each step, computed step by step in a given floating-point precision.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the body rate over equal intervals, rad.
    algorithm : str or Algorithm or FunctionalIteration or callable
        As in `driftlab.attitude.integrate`. Of one's own function only the steps are rounded.
    start : array_like or Rotation, shape (..., 4)
        Attitude before the first increment; brought to unit norm.
    word : dtype
        Precision of the computation: float16, float32 or float64.
    update : {"product", "small terms first", "complement", "compensated"}
        Order of summation of the four products in a component: a large one with the scalar part l0
        of the step and three small ones. ``"product"`` adds the first two, the last two, and the
        sums. ``"complement"`` adds to the old component the three small ones and the product with
        -(1 - l0), a reading of the paper's advice; ``"compensated"`` also carries the rounding
        error of this last sum into the next step (Kahan summation).
    fused : bool
        Whether the four products of a component are added by fused multiply-add, which rounds a
        product and the sum that it joins once. Not with words of 64 bits.
    normalise : bool
        Whether the attitude is divided by its length after each step.

    Returns
    -------
    ndarray, shape (..., n // samples, 4)
        Of dtype `word`; of length one to rounding if `normalise`.

    Raises
    ------
    ValueError
        If `fused` is wanted with words of 64 bits, and as in `driftlab.attitude.integrate`.

    Examples
    --------
    Compensated summation keeps the norm better by far:

    >>> steps = np.tile([1e-3, 0.0, 0.0], (1000, 1))
    >>> plain, kept = (
    ...     abs(1 - np.linalg.norm(integrate_finite_word(steps, update=update)[-1].astype(float)))
    ...     for update in ("product", "compensated")
    ... )
    >>> bool(kept < plain / 10)
    True
    """
    one_of(update, UPDATES, "update")
    truth_value(fused, "fused")
    truth_value(normalise, "normalise")
    vectors = step_rotation_vectors(increments, algorithm, word=word)
    if fused and vectors.dtype == np.float64:
        raise ValueError("word: expected float16 or float32 with fused multiply-add, got float64.")
    first = unit_quaternions(start, "start")
    finite_arrays(increments=(vectors, *vectors.shape[-2:]), start=(first, 4))
    chosen = checked_algorithm(algorithm)
    by_rotation_vector = isinstance(chosen, Algorithm) and chosen.last_stage == "rotation vector"
    steps = step_finite_word(vectors, rotation_vector=by_rotation_vector)
    leading = np.broadcast_shapes(steps.shape[:-2], first.shape[:-1])
    attitude = np.broadcast_to(first.astype(steps.dtype), (*leading, 4))
    x, y, z, scalar, complement = np.moveaxis(steps, -1, 0)
    diagonal = {"product": scalar, "small terms first": np.zeros_like(scalar)}.get(
        update, -complement
    )
    # Columns of right multiplication by each step: component j of the attitude times column j.
    columns = np.stack(
        [
            np.stack(column, axis=-1)
            for column in (
                (diagonal, -z, y, -x),
                (z, diagonal, -x, -y),
                (-y, x, diagonal, -z),
                (x, y, z, diagonal),
            )
        ],
        axis=-2,
    )
    columns, scalars = np.moveaxis(columns, -3, 0), np.moveaxis(scalar, -1, 0)[..., np.newaxis]
    attitudes = np.empty((len(columns), *leading, 4), steps.dtype)
    lost = np.zeros_like(attitude)
    for i, column in enumerate(columns):
        change = _sum_of_products(attitude, column, fused=fused)
        if update == "product":
            attitude = change
        elif update == "small terms first":
            attitude = _multiply_add(scalars[i], attitude, change, fused=fused)
        elif update == "complement":
            attitude = attitude + change
        else:
            change = change - lost
            total = attitude + change
            lost = (total - attitude) - change
            attitude = total
        if normalise:
            squares = attitude**2
            length = (squares[..., 0] + squares[..., 1]) + (squares[..., 2] + squares[..., 3])
            attitude = attitude / np.sqrt(length)[..., np.newaxis]
        attitudes[i] = attitude
    return np.moveaxis(attitudes, 0, -2)


def _sum_of_products(attitude: NDArray[Any], column: NDArray[Any], *, fused: bool) -> NDArray[Any]:
    """Sum of attitude[..., j] times column[..., j, :] over j, rounded as a processor would."""
    if not fused:
        terms = attitude[..., np.newaxis] * column
        return (terms[..., 0, :] + terms[..., 1, :]) + (terms[..., 2, :] + terms[..., 3, :])
    total = attitude[..., :1] * column[..., 0, :]
    for j in range(1, 4):
        total = _multiply_add(attitude[..., j : j + 1], column[..., j, :], total, fused=True)
    return total


def _multiply_add(
    a: NDArray[Any], b: NDArray[Any], c: NDArray[Any], *, fused: bool
) -> NDArray[Any]:
    """a times b plus c, with two roundings or with one."""
    if not fused:
        return a * b + c
    # Double precision holds the product of two shorter words exactly. It rounds the sum a first
    # time, far below the last digit of the word.
    return (a.astype(np.float64) * b + c).astype(c.dtype)
