"""Rodrigues-Hamilton parameters: unit quaternions, scalar last, body to reference.

The product is Hamilton's; a rotation that happens later about *body* axes multiplies on the right.
Everything here agrees with `scipy.spatial.transform.Rotation`. These functions broadcast over any
leading axes, and products of long arrays take a fraction of the time.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays, unit_quaternions
from .core import loops, quaternion as core


def multiply(first: ArrayLike, second: ArrayLike) -> FloatArray:
    """Hamilton product first∘second.

    Parameters
    ----------
    first, second : array_like or Rotation, shape (..., 4)
        Quaternions, scalar last; leading axes broadcast.

    Returns
    -------
    ndarray, shape (..., 4)

    Examples
    --------
    >>> multiply([1, 0, 0, 0], [0, 1, 0, 0])  # i∘j = k
    array([0., 0., 1., 0.])
    """
    return core.multiply(*finite_arrays(first=(first, 4), second=(second, 4)))


def conjugate(quaternion: ArrayLike) -> FloatArray:
    """Conjugate of a quaternion: the inverse rotation if its norm is one.

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)

    Returns
    -------
    ndarray, shape (..., 4)

    Examples
    --------
    >>> conjugate([1, 2, 3, 4])
    array([-1., -2., -3.,  4.])
    """
    return core.conjugate(finite_array(quaternion, "quaternion", 4))


def pure(vector: ArrayLike) -> FloatArray:
    """Quaternion with a given vector part and scalar part zero.

    Parameters
    ----------
    vector : array_like, shape (..., 3)

    Returns
    -------
    ndarray, shape (..., 4)

    Examples
    --------
    >>> pure([1, 2, 3])
    array([1., 2., 3., 0.])
    """
    return core.pure(finite_array(vector, "vector", 3))


def rotate(quaternion: ArrayLike, vector: ArrayLike) -> FloatArray:
    """Reference components of a vector given in body components: q∘v∘conj(q).

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)
        Of any norm above zero; it is scaled to unit norm.
    vector : array_like, shape (..., 3)

    Returns
    -------
    ndarray, shape (..., 3)

    Raises
    ------
    ValueError
        If a quaternion is zero.

    Examples
    --------
    A quarter turn about the third axis takes axis 1 to axis 2:

    >>> rotate([0, 0, np.sqrt(0.5), np.sqrt(0.5)], [1, 0, 0]).round(3) + 0
    array([0., 1., 0.])
    """
    unit = unit_quaternions(quaternion, "quaternion")
    return core.rotate(*finite_arrays(quaternion=(unit, 4), vector=(vector, 3)))


def to_matrix(quaternion: ArrayLike) -> FloatArray:
    """Matrix of the rotation that a quaternion describes.

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)
        Of any norm above zero; it is scaled to unit norm.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Body components to reference components.

    Raises
    ------
    ValueError
        If a quaternion is zero.

    Examples
    --------
    >>> to_matrix([0, 0, 1, 0])  # half a turn about the third axis
    array([[-1.,  0.,  0.],
           [ 0., -1.,  0.],
           [ 0.,  0.,  1.]])
    """
    return core.to_matrix(unit_quaternions(quaternion, "quaternion"))


def left_matrix(quaternion: ArrayLike) -> FloatArray:
    """Matrix of multiplication from the left: ``left_matrix(q) @ p`` is q∘p.

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)

    Returns
    -------
    ndarray, shape (..., 4, 4)

    Examples
    --------
    >>> left_matrix([1, 0, 0, 0]) @ [0, 1, 0, 0]
    array([0., 0., 1., 0.])
    """
    return core.left_matrix(finite_array(quaternion, "quaternion", 4))


def right_matrix(quaternion: ArrayLike) -> FloatArray:
    """Matrix of multiplication from the right: ``right_matrix(q) @ p`` is p∘q.

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)

    Returns
    -------
    ndarray, shape (..., 4, 4)

    Examples
    --------
    >>> right_matrix([0, 1, 0, 0]) @ [1, 0, 0, 0]
    array([0., 0., 1., 0.])
    """
    return core.right_matrix(finite_array(quaternion, "quaternion", 4))


def from_rotation_vector(rotation_vector: ArrayLike) -> FloatArray:
    """Unit quaternion of a rotation vector.

    Parameters
    ----------
    rotation_vector : array_like, shape (..., 3)
        Axis times angle, rad.

    Returns
    -------
    ndarray, shape (..., 4)
        Its scalar part is cos(angle/2) for any angle, so its sign does not jump as a body turns.

    Examples
    --------
    >>> from_rotation_vector([0, 0, np.pi / 3]).round(4)
    array([0.   , 0.   , 0.5  , 0.866])
    """
    return core.from_rotation_vector(finite_array(rotation_vector, "rotation_vector", 3))


def to_rotation_vector(quaternion: ArrayLike) -> FloatArray:
    """Rotation vector of the shorter of the two rotations of a quaternion (angle up to pi).

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)
        Need not be of unit norm; a zero quaternion is refused.

    Returns
    -------
    ndarray, shape (..., 3)
        rad.

    Examples
    --------
    >>> to_rotation_vector([0, 0, 1, 1])  # a quarter turn about the third axis
    array([0.        , 0.        , 1.57079633])
    """
    quaternion = finite_array(quaternion, "quaternion", 4)
    if not quaternion.any(axis=-1).all():
        raise ValueError("quaternion: expected nonzero quaternions, got a zero quaternion.")
    return core.to_rotation_vector(quaternion)


def rotation_angle(quaternion: ArrayLike) -> FloatArray:
    """Angle of the rotation that a quaternion describes.

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)
        Need not be of unit norm; a zero quaternion is refused.

    Returns
    -------
    ndarray, shape (...)
        rad, 0 to pi.

    Examples
    --------
    >>> rotation_angle([[0, 0, 1, 1], [0, 0, 0, -1]])
    array([1.57079633, 0.        ])
    """
    return np.linalg.norm(to_rotation_vector(quaternion), axis=-1)


def cumulative_product(quaternions: ArrayLike) -> FloatArray:
    """Products q_0, q_0∘q_1, q_0∘q_1∘q_2, ... along the last axis but one.

    Parameters
    ----------
    quaternions : array_like or Rotation, shape (..., n, 4)
        Increments in the order in which they happen, each about body axes.

    Returns
    -------
    ndarray, shape (..., n, 4)

    Examples
    --------
    Three half turns about the third axis make one and a half:

    >>> rotation_angle(cumulative_product([[0, 0, 1, 0]] * 3)).round(4)
    array([3.1416, 0.    , 3.1416])
    """
    quaternions = finite_array(quaternions, "quaternions", 4)
    if quaternions.ndim < 2:
        raise ValueError(f"quaternions: expected shape (..., n, 4), got shape {quaternions.shape}.")
    return loops.cumulative_product(quaternions)
