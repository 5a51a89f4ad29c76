"""Arrays of finite real numbers with the expected last axes, vectors and quaternions included."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._words import named_in, shown, with_article

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complexfloating[Any, Any]]

LARGEST_NUMBER = 1e50
"""Largest size of a number that is computed with, in any unit. No quantity comes near, and up to
the sixth power nothing overflows."""
SMALLEST_DIVISOR = 1 / LARGEST_NUMBER
"""Smallest of the numbers that must be above zero, times for instance: they divide."""

_DOUBLE = np.dtype(np.float64)
_SMALL = LARGEST_NUMBER**2


def finite_array(value: ArrayLike, name: str, *shape: int) -> FloatArray:
    """Return a value as a float64 array of finite numbers whose last axes have the lengths `shape`.

    A float64 array is not copied. A SciPy `Rotation` is accepted where the last axis is 4. With no
    `shape`, any shape is allowed.
    """
    array = value if type(value) is np.ndarray else _as_array(value, name, shape)
    if array.dtype.kind not in "fiu":
        one = array.ndim == 0 and not isinstance(value, np.ndarray)
        got = _object(value) or (shown(value) if one else f"dtype {array.dtype}")
        raise ValueError(f"{name}: expected real numbers, got {got}.")
    if shape and array.shape[-len(shape) :] != shape:
        raise ValueError(f"{name}: expected {_expected(shape)}, got shape {array.shape}.")
    if array.size == 0:
        raise ValueError(f"{name}: expected at least one value, got an empty array.")
    # A small sum of squares tells all in one look, of a NaN as well, which is not small.
    if array.dtype == _DOUBLE and array.flags.c_contiguous and np.vdot(array, array) <= _SMALL:
        return array
    # So do both ends, without another array; a NaN is at both of them.
    least, most = float(array.min()), float(array.max())
    if not -LARGEST_NUMBER <= least <= most <= LARGEST_NUMBER:
        raise ValueError(f"{name}: expected {_what_is_wrong(array)}.")
    return array.astype(np.float64, copy=False)


def _as_array(value: ArrayLike, name: str, shape: tuple[int, ...]) -> NDArray[Any]:
    """Return a value that is not a plain array as one, `Rotation` and masked array included."""
    if shape[-1:] == (4,):  # by its method, lest SciPy be loaded for those who do without
        as_quat = getattr(value, "as_quat", None)
        value = as_quat() if as_quat is not None else value
    masked = value if isinstance(value, list | tuple) else (value,)
    # Without the module, which takes longer to load than all of ours, there are no masked arrays.
    if "numpy.ma" in sys.modules and any(
        np.ma.is_masked(each) for each in masked if isinstance(each, np.ma.MaskedArray)
    ):
        raise ValueError(f"{name}: expected all values to be there, got masked ones.")
    try:
        return np.asarray(value)
    except ValueError:  # NumPy's error for lists of unequal length
        got = _object(value) or "rows of unequal length"
        raise ValueError(f"{name}: expected {_expected(shape)}, got {got}.") from None


def _expected(shape: tuple[int, ...]) -> str:
    return f"shape (..., {', '.join(map(str, shape))})" if shape else "real numbers"


def _what_is_wrong(array: NDArray[Any]) -> str:
    """Say how many numbers are not finite or, if none, which is too large."""
    if count := array.size - np.count_nonzero(np.isfinite(array)):
        return f"finite numbers, got {count} NaN or infinite"
    worst = max(array.min(), array.max(), key=abs)
    return f"numbers of at most {LARGEST_NUMBER:g} in size, got {shown(worst)}"


def _object(value: object) -> str:
    """Describe an object that holds arrays and name them; return an empty string for others."""
    hint = named_in(value, "FloatArray")
    return f"{with_article(type(value).__name__)}{hint}" if hint else ""


def finite_arrays(**arguments: tuple[ArrayLike, *tuple[int, ...]]) -> list[FloatArray]:
    """Check several arguments with `finite_array` and that their leading axes broadcast.

    Each is given as `name=(value, *lengths of its last axes)`. The results are not broadcast.
    """
    arrays = [finite_array(value, name, *shape) for name, (value, *shape) in arguments.items()]
    depths = [len(shape) for _, *shape in arguments.values()]
    common_leading_axes(
        **{
            name: array.shape[: array.ndim - depth]
            for name, array, depth in zip(arguments, arrays, depths, strict=True)
        }
    )
    return arrays


def common_leading_axes(**leading: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape to which the leading axes of several arguments broadcast."""
    different = set(leading.values())
    if len(different) == 1:  # sooner than NumPy
        return different.pop()
    try:
        return np.broadcast_shapes(*different)
    except ValueError:
        raise ValueError(
            f"{', '.join(leading)}: expected leading axes that broadcast, "
            f"got {' and '.join(map(str, leading.values()))}."
        ) from None


def positive_array(value: ArrayLike, name: str) -> FloatArray:
    """Return a value as a float64 array of numbers no smaller than `SMALLEST_DIVISOR`."""
    array = finite_array(value, name)
    least = float(array.min())
    if least < SMALLEST_DIVISOR:
        limit = "above 0" if least <= 0 else f"of at least {SMALLEST_DIVISOR:g}"
        raise ValueError(f"{name}: expected numbers {limit}, got {least:g}.")
    return array


def whole_pairs(value: ArrayLike, name: str) -> NDArray[np.int_]:
    """Return pairs of integers, shape (m, 2), such as the first and last rows of intervals.

    An empty value gives an array of shape (0, 2).
    """
    try:
        pairs = np.array(None) if np.ma.is_masked(value) else np.asarray(value)
    except ValueError:  # lists of unequal length
        pairs = np.array(None)
    if pairs.size == 0 and pairs.ndim:
        return np.zeros((0, 2), int)
    if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iu":
        raise ValueError(f"{name}: expected whole numbers of shape (m, 2), got {shown(value)}.")
    return pairs


def nonzero_vectors(value: ArrayLike, name: str) -> tuple[FloatArray, FloatArray]:
    """Return the unit vectors and the lengths of vectors (..., 3), none of which is zero."""
    vectors = finite_array(value, name, 3)
    # Dividing by the largest entry first keeps the squares clear of underflow and overflow.
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError(f"{name}: expected nonzero vectors, got a zero vector.")
    vectors = vectors / largest
    norms = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / norms, (norms * largest)[..., 0]


def unit_quaternions(value: ArrayLike, name: str) -> FloatArray:
    """Return quaternions (..., 4), none of which is zero, scaled to unit norm."""
    quaternions = finite_array(value, name, 4)
    # Dividing by the largest entry first, as for vectors.
    largest = np.abs(quaternions).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError(f"{name}: expected nonzero quaternions, got a zero quaternion.")
    quaternions = quaternions / largest
    return quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)


def one_quaternion(value: ArrayLike, name: str) -> FloatArray:
    """Return a single nonzero quaternion (4,) scaled to unit norm."""
    quaternion = unit_quaternions(value, name)
    if quaternion.ndim != 1:
        raise ValueError(f"{name}: expected one quaternion (4,), got shape {quaternion.shape}.")
    return quaternion
