"""Rodrigues-Hamilton parameters: unit quaternions, scalar last, body to reference.

The product is Hamilton's; a rotation that happens later about *body* axes multiplies on the right.
Everything here agrees with `scipy.spatial.transform.Rotation`, which is what to use for ordinary
work; these functions exist because the book's subject is the algebra itself, because they
broadcast over any leading axes, and because products of long arrays take a fraction of the time.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays, lengths


def multiply(first: ArrayLike, second: ArrayLike) -> FloatArray:
    """Hamilton product first∘second.

    Parameters
    ----------
    first, second : array_like, shape (..., 4)
        Quaternions, scalar last; leading axes broadcast.

    Returns
    -------
    ndarray, shape (..., 4)
    """
    pair = finite_arrays(first=(first, 4), second=(second, 4))
    a, b = (np.moveaxis(quaternion, -1, 0) for quaternion in pair)
    product: FloatArray = np.empty((*np.broadcast_shapes(a[0].shape, b[0].shape), 4))
    product[..., 0] = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1]
    product[..., 1] = a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2]
    product[..., 2] = a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0]
    product[..., 3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]
    return product


def conjugate(quaternion: ArrayLike) -> FloatArray:
    """Conjugate, (..., 4) to (..., 4): the inverse rotation of a unit quaternion."""
    return finite_array(quaternion, "quaternion", 4) * np.array([-1.0, -1.0, -1.0, 1.0])


def pure(vector: ArrayLike) -> FloatArray:
    """Quaternion (..., 4) with the vector (..., 3) and scalar part zero."""
    vector = finite_array(vector, "vector", 3)
    return np.concatenate([vector, np.zeros_like(vector[..., :1])], axis=-1)


def left_matrix(quaternion: ArrayLike) -> FloatArray:
    """Matrix (..., 4, 4) of multiplication from the left: ``left_matrix(q) @ p = q∘p``."""
    return _combine(quaternion, _LEFT_UNITS)


def right_matrix(quaternion: ArrayLike) -> FloatArray:
    """Matrix (..., 4, 4) of multiplication from the right: ``right_matrix(q) @ p = p∘q``."""
    return _combine(quaternion, _RIGHT_UNITS)


# The matrices of the four units 1i, 1j, 1k, 1, flattened: any other is a combination of them.
# Entry [u, a, b] is component a of unit_u∘unit_b (left) or unit_b∘unit_u (right).
_PRODUCTS = multiply(np.eye(4)[:, np.newaxis], np.eye(4))
_LEFT_UNITS = np.swapaxes(_PRODUCTS, 1, 2).reshape(4, 16)
_RIGHT_UNITS = np.moveaxis(_PRODUCTS, (0, 1, 2), (2, 0, 1)).reshape(4, 16)


def _combine(quaternion: ArrayLike, units: FloatArray) -> FloatArray:
    quaternion = finite_array(quaternion, "quaternion", 4)
    return (quaternion @ units).reshape(*quaternion.shape[:-1], 4, 4)


def from_rotation_vector(rotation_vector: ArrayLike) -> FloatArray:
    """Unit quaternion (..., 4) of a rotation vector (..., 3) in radians.

    Its scalar part is cos(angle/2) for any angle, so ``t -> from_rotation_vector(w t)`` has no
    jumps of sign.
    """
    rotation_vector = finite_array(rotation_vector, "rotation_vector", 3)
    half_angle = 0.5 * lengths(rotation_vector)
    # sin(x)/x at x = 0 is 1; a tiny stand-in for 0 gives it without a division by zero.
    half_angle = np.maximum(half_angle, np.finfo(float).tiny)
    quaternion = np.empty((*half_angle.shape, 4))
    quaternion[..., :3] = (0.5 * np.sin(half_angle) / half_angle)[..., np.newaxis] * rotation_vector
    quaternion[..., 3] = np.cos(half_angle)
    return quaternion


def to_rotation_vector(quaternion: ArrayLike) -> FloatArray:
    """Rotation vector (..., 3) in radians, of the shorter of the two rotations (angle up to pi).

    The quaternion (..., 4) need not be of unit norm; a zero quaternion is refused.
    """
    quaternion = finite_array(quaternion, "quaternion", 4)
    largest = np.abs(quaternion).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError("quaternion: expected nonzero quaternions, got a zero quaternion.")
    # All multiples of q are one rotation: take the one with the scalar part not negative, and of
    # a size whose squares neither underflow nor overflow.
    size = np.where(quaternion[..., 3:] < 0, -largest, largest)
    vector, scalar = np.split(quaternion / size, [3], axis=-1)
    sine = np.linalg.norm(vector, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, scalar)
    # Where the vector part vanishes, the scalar part is 1 and angle/sine tends to 2.
    return np.divide(angle, sine, out=np.full_like(sine, 2.0), where=sine > 0) * vector


def rotation_angle(quaternion: ArrayLike) -> FloatArray:
    """Angle (...) in radians, 0 to pi, of the rotation that a quaternion (..., 4) describes."""
    return np.linalg.norm(to_rotation_vector(quaternion), axis=-1)


def cumulative_product(quaternions: ArrayLike) -> FloatArray:
    """Products q_0, q_0∘q_1, q_0∘q_1∘q_2, ... along the last axis but one.

    Parameters
    ----------
    quaternions : array_like, shape (..., n, 4)
        Increments in the order in which they happen, each about body axes.

    Returns
    -------
    ndarray, shape (..., n, 4)

    Notes
    -----
    A parallel scan: the products of neighbours are half as many, their cumulative product is every
    second answer, and one more product gives the rest: about 2 log2(n) array products, not n.
    """
    quaternions = finite_array(quaternions, "quaternions", 4)
    if quaternions.ndim < 2:
        raise ValueError(f"quaternions: expected shape (..., n, 4), got shape {quaternions.shape}.")
    return _scan(quaternions)


def _scan(quaternions: FloatArray) -> FloatArray:
    if quaternions.shape[-2] == 1:
        return quaternions.copy()
    count = quaternions.shape[-2]
    pairs = multiply(quaternions[..., 0 : count - 1 : 2, :], quaternions[..., 1::2, :])
    products = np.empty_like(quaternions)
    products[..., 0, :] = quaternions[..., 0, :]
    products[..., 1::2, :] = _scan(pairs)
    if count > 2:
        before = products[..., 1 : count - 1 : 2, :]
        products[..., 2::2, :] = multiply(before, quaternions[..., 2::2, :])
    return products
