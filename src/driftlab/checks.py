"""The one place where arguments are looked at: shape, finiteness, and the sentence that refuses."""

from __future__ import annotations

import operator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complexfloating[Any, Any]]


def finite_array(value: ArrayLike, name: str, *shape: int) -> FloatArray:
    """Return `value` as a float64 array, or refuse it in one sentence.

    Parameters
    ----------
    value : array_like of real numbers
    name : str
        The argument's name, for the sentence.
    *shape : int
        What the last axes must be. Leading axes are free; without `shape` any shape goes.

    Raises
    ------
    ValueError
        If `value` is not real and numeric, is empty, has other last axes, or holds NaN, infinity or
        masked values.
    """
    expected = f"shape (..., {', '.join(map(str, shape))})" if shape else "real numbers"
    try:
        array = np.asarray(value)
    except ValueError:  # NumPy's word for lists of unequal length
        raise ValueError(f"{name}: expected {expected}, got rows of unequal length.") from None
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name}: expected real numbers, got dtype {array.dtype}.")
    if shape and array.shape[-len(shape) :] != shape:
        raise ValueError(f"{name}: expected {expected}, got shape {array.shape}.")
    if array.size == 0:
        raise ValueError(f"{name}: expected at least one value, got an empty array.")
    if np.ma.is_masked(value):
        raise ValueError(f"{name}: expected all values to be there, got masked ones.")
    array = array.astype(np.float64, copy=False)
    if not np.isfinite(array).all():
        count = array.size - np.count_nonzero(np.isfinite(array))
        raise ValueError(f"{name}: expected finite numbers, got {count} NaN or infinite.")
    return array


def nonzero_vectors(value: ArrayLike, name: str) -> tuple[FloatArray, FloatArray]:
    """Return vectors (..., 3) as unit vectors (..., 3) and norms (...), refusing a zero vector."""
    vectors = finite_array(value, name, 3)
    # Dividing by the largest entry first keeps the squares clear of underflow and overflow.
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError(f"{name}: expected nonzero vectors, got a zero vector.")
    vectors = vectors / largest
    norms = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / norms, (norms * largest)[..., 0]


def unit_quaternions(value: ArrayLike, name: str) -> FloatArray:
    """Return quaternions (..., 4) brought to unit norm, refusing a zero quaternion."""
    quaternions = finite_array(value, name, 4)
    # Dividing by the largest entry first, as for vectors.
    largest = np.abs(quaternions).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError(f"{name}: expected nonzero quaternions, got a zero quaternion.")
    quaternions = quaternions / largest
    return quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)


def finite_arrays(**arguments: tuple[ArrayLike, *tuple[int, ...]]) -> list[FloatArray]:
    """`finite_array` for several arguments at once, whose leading axes must broadcast.

    ``finite_arrays(rate=(rate, 3), time=(time,))`` checks a `rate` (..., 3) and a `time` (...).
    """
    arrays = [finite_array(value, name, *shape) for name, (value, *shape) in arguments.items()]
    depths = [len(shape) for _, *shape in arguments.values()]
    leading = [a.shape[: a.ndim - depth] for a, depth in zip(arrays, depths, strict=True)]
    try:
        np.broadcast_shapes(*leading)
    except ValueError:
        raise ValueError(
            f"{', '.join(arguments)}: expected leading axes that broadcast, "
            f"got {' and '.join(map(str, leading))}."
        ) from None
    return arrays


def finite_number(value: ArrayLike, name: str) -> float:
    """Return `value` as a float, refusing what is not one finite real number."""
    number = finite_array(value, name)
    if number.ndim:
        raise ValueError(f"{name}: expected one number, got shape {number.shape}.")
    return float(number)


def positive_number(value: ArrayLike, name: str) -> float:
    """Return `value` as a float, refusing what is not one finite number above zero."""
    number = finite_number(value, name)
    # Below the smallest normal number its reciprocal overflows.
    if number < np.finfo(float).tiny:
        raise ValueError(f"{name}: expected a positive number, got {value!r}.")
    return number


def whole_number(value: int, name: str, least: int = 1) -> int:
    """Return `value` as an int, refusing what is not a whole number of at least `least`."""
    try:
        # NumPy 2.0 takes its own truth values for whole numbers, with a warning.
        number = None if isinstance(value, bool | np.bool) else operator.index(value)
    except TypeError:
        number = None
    if number is None or number < least:
        raise ValueError(f"{name}: expected a whole number of at least {least}, got {value!r}.")
    return number
