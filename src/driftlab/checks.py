"""Checks of arguments: shape, finiteness, and the sentence that explains a refusal.

Every function here takes the argument's name, which begins the sentence of the `ValueError`.
"""

from __future__ import annotations

import operator
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complexfloating[Any, Any]]
Kind = TypeVar("Kind")


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
        If `value` is not real and numeric, is empty, has other last axes, or holds NaN, infinity or
        masked values.

    Examples
    --------
    >>> finite_array([1, 2, 3], "rate", 3)
    array([1., 2., 3.])
    >>> finite_array([1, 2], "rate", 3)
    Traceback (most recent call last):
        ...
    ValueError: rate: expected shape (..., 3), got shape (2,).
    """
    expected = f"shape (..., {', '.join(map(str, shape))})" if shape else "real numbers"
    if shape[-1:] == (4,):  # by its method, lest SciPy be loaded for those who do without
        as_quat = getattr(value, "as_quat", None)
        value = as_quat() if as_quat is not None else value
    try:
        array = np.asarray(value)
    except ValueError:  # NumPy's error for lists of unequal length
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
    """Return vectors as unit vectors and norms, refusing a zero vector.

    Parameters
    ----------
    value : array_like, shape (..., 3)
        Vectors of any unit and any size above zero.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    directions : ndarray, shape (..., 3)
        Unit vectors.
    norms : ndarray, shape (...)
        Lengths, in the unit of `value`.

    Raises
    ------
    ValueError
        If a vector is zero, or as for `finite_array`.

    Examples
    --------
    >>> directions, norms = nonzero_vectors([[3, 0, 4], [0, 1e-200, 0]], "axis")
    >>> directions
    array([[0.6, 0. , 0.8],
           [0. , 1. , 0. ]])
    >>> norms
    array([5.e+000, 1.e-200])
    """
    vectors = finite_array(value, name, 3)
    # Dividing by the largest entry first keeps the squares clear of underflow and overflow.
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError(f"{name}: expected nonzero vectors, got a zero vector.")
    vectors = vectors / largest
    norms = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / norms, (norms * largest)[..., 0]


def unit_quaternions(value: ArrayLike, name: str) -> FloatArray:
    """Return quaternions scaled to unit norm, refusing a zero quaternion.

    Parameters
    ----------
    value : array_like or Rotation, shape (..., 4)
        Quaternions of any norm above zero.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray, shape (..., 4)
        The same rotations, of unit norm.

    Raises
    ------
    ValueError
        If a quaternion is zero, or as for `finite_array`.

    Examples
    --------
    >>> unit_quaternions([0, 0, 3, 4], "attitude")
    array([0. , 0. , 0.6, 0.8])
    """
    quaternions = finite_array(value, name, 4)
    # Dividing by the largest entry first, as for vectors.
    largest = np.abs(quaternions).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError(f"{name}: expected nonzero quaternions, got a zero quaternion.")
    quaternions = quaternions / largest
    return quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)


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
    """Return a value as a float, refusing everything but one finite real number.

    Parameters
    ----------
    value : array_like, shape ()
        The number.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        If `value` has axes, or as for `finite_array`.

    Examples
    --------
    >>> finite_number(np.array(2), "interval")
    2.0
    """
    number = finite_array(value, name)
    if number.ndim:
        raise ValueError(f"{name}: expected one number, got shape {number.shape}.")
    return float(number)


def positive_number(value: ArrayLike, name: str) -> float:
    """Return a value as a float, refusing everything but one finite number above zero.

    Parameters
    ----------
    value : array_like, shape ()
        The number.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        If `value` is not above zero, or as for `finite_number`.

    Examples
    --------
    >>> positive_number(-1, "interval")
    Traceback (most recent call last):
        ...
    ValueError: interval: expected a positive number, got -1.
    """
    number = finite_number(value, name)
    # Below the smallest normal number its reciprocal overflows.
    if number < np.finfo(float).tiny:
        raise ValueError(f"{name}: expected a positive number, got {value!r}.")
    return number


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
        If a number is zero or less, or as for `finite_array`.

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
    if array.min() <= 0:
        raise ValueError(f"{name}: expected numbers above 0, got {array.min():g}.")
    return array


def checked_instance(value: object, kind: type[Kind], name: str) -> Kind:
    """Return an object if it is of a kind.

    Parameters
    ----------
    value : object
        Anything.
    kind : type
        The class it must be of.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    object
        `value` itself.

    Raises
    ------
    ValueError
        If it is of another class.

    Examples
    --------
    >>> checked_instance(3, str, "scheme")
    Traceback (most recent call last):
    ValueError: scheme: expected a str, got 3.
    """
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIOUaeiou" else "a"
        fields = getattr(kind, "_fields", ())  # of a NamedTuple
        wanted = f"({', '.join(fields)})" if fields else ""
        short = value is None or isinstance(value, str | int | float)
        shown = repr(value) if short else type(value).__name__
        raise ValueError(f"{name}: expected {article} {kind.__name__}{wanted}, got {shown}.")
    return value


def checked_generator(rng: object) -> np.random.Generator:
    """Return the argument `rng` if noise can be drawn from it.

    Parameters
    ----------
    rng : object
        Should be a `numpy.random.Generator`.

    Returns
    -------
    numpy.random.Generator

    Raises
    ------
    ValueError
        If it is something else, as a seed or None.

    Examples
    --------
    >>> checked_generator(1)
    Traceback (most recent call last):
    ValueError: rng: expected a numpy Generator to draw the noise, got 1.
    """
    if not isinstance(rng, np.random.Generator):
        raise ValueError(f"rng: expected a numpy Generator to draw the noise, got {rng!r}.")
    return rng


def whole_number(value: int, name: str, least: int = 1) -> int:
    """Return a value as an int, refusing everything but a whole number that is large enough.

    Parameters
    ----------
    value : int
        The number; a truth value is refused.
    name : str
        Name of the argument, for the sentence.
    least : int
        Smallest number allowed.

    Returns
    -------
    int
        The number.

    Raises
    ------
    ValueError
        If `value` is not a whole number, or is less than `least`.

    Examples
    --------
    >>> whole_number(np.int64(3), "turns")
    3
    >>> whole_number(2.5, "turns")
    Traceback (most recent call last):
        ...
    ValueError: turns: expected a whole number of at least 1, got 2.5.
    """
    try:
        # NumPy 2.0 takes its own truth values for whole numbers, with a warning.
        number = None if isinstance(value, bool | np.bool) else operator.index(value)
    except TypeError:
        number = None
    if number is None or number < least:
        raise ValueError(f"{name}: expected a whole number of at least {least}, got {value!r}.")
    return number
