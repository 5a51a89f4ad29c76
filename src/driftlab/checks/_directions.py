"""Vectors and quaternions of which only the direction counts, made of length one."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import FloatArray, finite_array


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


def one_quaternion(value: ArrayLike, name: str) -> FloatArray:
    """Return a single quaternion scaled to unit norm.

    Parameters
    ----------
    value : array_like, shape (4,)
        A quaternion of any norm above zero.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray, shape (4,)
        The same rotation, of unit norm.

    Raises
    ------
    ValueError
        If there are several, or as for `unit_quaternions`.

    Examples
    --------
    >>> one_quaternion([[0, 0, 0, 1]], "attitude")
    Traceback (most recent call last):
    ValueError: attitude: expected one quaternion (4,), got shape (1, 4).
    """
    quaternion = unit_quaternions(value, name)
    if quaternion.ndim != 1:
        raise ValueError(f"{name}: expected one quaternion (4,), got shape {quaternion.shape}.")
    return quaternion
