"""Arrays of finite real numbers, of the shape that is wanted."""

from __future__ import annotations

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
    """Return a value as a float64 array of finite numbers, or refuse it in one sentence.

    Parameters
    ----------
    value : array_like
        Real numbers. Where quaternions are expected, with a last axis of 4, also a `Rotation` of
        SciPy, of one rotation or of a stack with any axes.
    name : str
        Name of the argument, for the sentence.
    *shape : int
        Required lengths of the last axes. Leading axes are free; without `shape` any shape goes.

    Returns
    -------
    ndarray
        `value` as float64, not copied if it is a float64 array already.

    Raises
    ------
    ValueError
        If `value` is not real and numeric, is empty, has other last axes, or holds NaN, infinity,
        masked values or numbers larger than `LARGEST_NUMBER`.

    Examples
    --------
    >>> finite_array([1, 2, 3], "rate", 3)
    array([1., 2., 3.])
    >>> finite_array([1, 2], "rate", 3)
    Traceback (most recent call last):
        ...
    ValueError: rate: expected shape (..., 3), got shape (2,).
    >>> finite_array([0, -1e60], "rate")
    Traceback (most recent call last):
        ...
    ValueError: rate: expected numbers of at most 1e+50 in size, got -1e+60.
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
    """Make an array of what is none, or what NumPy knows as a kind of array."""
    if shape[-1:] == (4,):  # by its method, lest SciPy be loaded for those who do without
        as_quat = getattr(value, "as_quat", None)
        value = as_quat() if as_quat is not None else value
    masked = value if isinstance(value, list | tuple) else (value,)
    if any(np.ma.is_masked(each) for each in masked if isinstance(each, np.ma.MaskedArray)):
        raise ValueError(f"{name}: expected all values to be there, got masked ones.")
    try:
        return np.asarray(value)
    except ValueError:  # NumPy's error for lists of unequal length
        got = _object(value) or "rows of unequal length"
        raise ValueError(f"{name}: expected {_expected(shape)}, got {got}.") from None


def _expected(shape: tuple[int, ...]) -> str:
    return f"shape (..., {', '.join(map(str, shape))})" if shape else "real numbers"


def _what_is_wrong(array: NDArray[Any]) -> str:
    """Words for numbers that are not finite, or else too large."""
    if count := array.size - np.count_nonzero(np.isfinite(array)):
        return f"finite numbers, got {count} NaN or infinite"
    worst = max(array.min(), array.max(), key=abs)
    return f"numbers of at most {LARGEST_NUMBER:g} in size, got {shown(worst)}"


def _object(value: object) -> str:
    """Words for an object that holds arrays, and for which of them may be meant; else nothing."""
    hint = named_in(value, "FloatArray")
    return f"{with_article(type(value).__name__)}{hint}" if hint else ""


def finite_arrays(**arguments: tuple[ArrayLike, *tuple[int, ...]]) -> list[FloatArray]:
    """Check several arguments by `finite_array`, and that their leading axes broadcast.

    Parameters
    ----------
    **arguments : tuple
        Under the name of each argument its value and then the required lengths of its last axes.

    Returns
    -------
    list of ndarray
        The values as float64 arrays, in the order given. They are not broadcast.

    Raises
    ------
    ValueError
        If the leading axes do not broadcast, or as for `finite_array`.

    Examples
    --------
    >>> rate, time = finite_arrays(rate=([1, 2, 3], 3), time=([0, 1],))
    >>> rate.shape, time.shape
    ((3,), (2,))
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
    """Return the axes to which the leading axes of several arguments broadcast.

    Parameters
    ----------
    **leading : tuple of int
        Under the name of each argument its leading axes.

    Returns
    -------
    tuple of int

    Raises
    ------
    ValueError
        If they do not broadcast.

    Examples
    --------
    >>> common_leading_axes(rate=(3, 1), time=(2,))
    (3, 2)
    >>> common_leading_axes(rate=(3,), time=(2,))
    Traceback (most recent call last):
    ValueError: rate, time: expected leading axes that broadcast, got (3,) and (2,).
    """
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
    """Return a value as a float64 array of numbers above zero, or refuse it in one sentence.

    Parameters
    ----------
    value : array_like, shape (...)
        The numbers.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray, shape (...)
        `value` as float64.

    Raises
    ------
    ValueError
        If a number is zero or less, or less than `SMALLEST_DIVISOR`, or as for `finite_array`.

    Examples
    --------
    >>> positive_array([1, 2], "averaging_times")
    array([1., 2.])
    >>> positive_array([1, -2], "averaging_times")
    Traceback (most recent call last):
        ...
    ValueError: averaging_times: expected numbers above 0, got -2.
    """
    array = finite_array(value, name)
    least = float(array.min())
    if least < SMALLEST_DIVISOR:
        limit = "above 0" if least <= 0 else f"of at least {SMALLEST_DIVISOR:g}"
        raise ValueError(f"{name}: expected numbers {limit}, got {least:g}.")
    return array


def whole_pairs(value: ArrayLike, name: str) -> NDArray[np.int_]:
    """Return pairs of whole numbers, as of rows where something begins and ends.

    Parameters
    ----------
    value : array_like of int, shape (m, 2)
        The pairs; none if it is empty.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray of int, shape (m, 2)

    Raises
    ------
    ValueError
        If it is anything else.

    Examples
    --------
    >>> whole_pairs([(0, 100), 200], "rests")
    Traceback (most recent call last):
    ValueError: rests: expected whole numbers of shape (m, 2), got [(0, 100), 200].
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
