"""Quaternions, scalar last: the arithmetic behind `driftlab.quaternion`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from .vectors import components, norms


def multiply(first: FloatArray, second: FloatArray) -> FloatArray:
    """Hamilton product (..., 4) of quaternions (..., 4)."""
    a, b = components(first), components(second)
    product: FloatArray = np.empty((*np.broadcast_shapes(a[0].shape, b[0].shape), 4))
    product[..., 0] = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1]
    product[..., 1] = a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2]
    product[..., 2] = a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0]
    product[..., 3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]
    return product


def conjugate(quaternion: FloatArray) -> FloatArray:
    """Conjugate, (..., 4) to (..., 4)."""
    return quaternion * np.array([-1.0, -1.0, -1.0, 1.0])


def pure(vector: FloatArray) -> FloatArray:
    """Quaternion (..., 4) with the vector (..., 3) and scalar part zero."""
    return np.concatenate([vector, np.zeros_like(vector[..., :1])], axis=-1)


def rotate(quaternion: FloatArray, vector: FloatArray) -> FloatArray:
    """Vector (..., 3) rotated by a unit quaternion (..., 4): q∘v∘conj(q)."""
    (x, y, z, w), v = components(quaternion), components(vector)
    # v + 2 w u×v + 2 u×(u×v) with u the vector part, and t = 2 u×v formed once.
    t = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    rotated: FloatArray = np.empty((*t[0].shape, 3))
    rotated[..., 0] = v[0] + w * t[0] + y * t[2] - z * t[1]
    rotated[..., 1] = v[1] + w * t[1] + z * t[0] - x * t[2]
    rotated[..., 2] = v[2] + w * t[2] + x * t[1] - y * t[0]
    return rotated


def to_matrix(quaternion: FloatArray) -> FloatArray:
    """Matrix (..., 3, 3) of the rotation of a unit quaternion (..., 4)."""
    return np.swapaxes(rotate(quaternion[..., np.newaxis, :], np.eye(3)), -1, -2)


def left_matrix(quaternion: FloatArray) -> FloatArray:
    """Matrix (..., 4, 4) of multiplication by a quaternion (..., 4) from the left."""
    return (quaternion @ _LEFT_UNITS).reshape(*quaternion.shape[:-1], 4, 4)


def right_matrix(quaternion: FloatArray) -> FloatArray:
    """Matrix (..., 4, 4) of multiplication by a quaternion (..., 4) from the right."""
    return (quaternion @ _RIGHT_UNITS).reshape(*quaternion.shape[:-1], 4, 4)


# The matrices of the four units 1i, 1j, 1k, 1, flattened: any other is a combination of them.
# Entry [u, a, b] is component a of unit_u∘unit_b (left) or unit_b∘unit_u (right).
_PRODUCTS = multiply(np.eye(4)[:, np.newaxis], np.eye(4))
_LEFT_UNITS = np.swapaxes(_PRODUCTS, 1, 2).reshape(4, 16)
_RIGHT_UNITS = np.moveaxis(_PRODUCTS, (0, 1, 2), (2, 0, 1)).reshape(4, 16)


def from_rotation_vector(rotation_vector: FloatArray) -> FloatArray:
    """Unit quaternion (..., 4) of a rotation vector (..., 3), scalar part cos(angle/2)."""
    half_angle = 0.5 * norms(rotation_vector)
    # sin(x)/x at x = 0 is 1; a tiny stand-in for 0 gives it without a division by zero.
    half_angle = np.maximum(half_angle, np.finfo(float).tiny)
    quaternion = np.empty((*half_angle.shape, 4))
    quaternion[..., :3] = (0.5 * np.sin(half_angle) / half_angle)[..., np.newaxis] * rotation_vector
    quaternion[..., 3] = np.cos(half_angle)
    return quaternion


def to_rotation_vector(quaternion: FloatArray) -> FloatArray:
    """Rotation vector (..., 3), angle up to pi, of a quaternion (..., 4) that is not zero."""
    largest = np.abs(quaternion).max(axis=-1, keepdims=True)
    # All multiples of q are one rotation: take the one with the scalar part not negative, and of
    # a size whose squares neither underflow nor overflow.
    size = np.where(quaternion[..., 3:] < 0, -largest, largest)
    scaled: FloatArray = quaternion / size
    vector, scalar = scaled[..., :3], scaled[..., 3:]
    sine = np.linalg.norm(vector, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, scalar)
    # Where the vector part vanishes, the scalar part is 1 and angle/sine tends to 2.
    return np.divide(angle, sine, out=np.full_like(sine, 2.0), where=sine > 0) * vector


def cumulative_product(quaternions: FloatArray) -> FloatArray:
    """Products q_0, q_0∘q_1, q_0∘q_1∘q_2, ... of rows (..., n, 4).

    A row of n is cut into about sqrt(n) blocks. The products inside the blocks are formed in step,
    all blocks at once; the products of whole blocks are a row of their own, done in the same way;
    and one more product puts each block after those before it. So nearly all of the work is
    NumPy's, on arrays of sqrt(n), with two quaternion products an element.
    """
    rows = quaternions.reshape(-1, *quaternions.shape[-2:]).swapaxes(0, 1)
    first, second = rows[..., 3] + 1j * rows[..., 2], rows[..., 0] + 1j * rows[..., 1]
    _scan(first, second)
    products = np.empty(quaternions.shape)
    rows = products.reshape(-1, *quaternions.shape[-2:]).swapaxes(0, 1)
    rows[..., 3], rows[..., 2] = first.real, first.imag
    rows[..., 0], rows[..., 1] = second.real, second.imag
    return products


# A quaternion x i + y j + z k + w is a + b i with the pair a = w + z k, b = x + y k of ordinary
# complex numbers in k, because j = k i. Four complex products then make one of quaternions.
_Pair = tuple[NDArray[np.complex128], NDArray[np.complex128]]


def _multiply_pairs(a: Any, b: Any, c: Any, d: Any) -> _Pair:
    """Pair of (a + b i)∘(c + d i). Since i c = conj(c) i: a c - b conj(d) and a d + b conj(c)."""
    first = a * c
    other = np.conjugate(d)
    other *= b
    first -= other
    second = a * d
    np.conjugate(c, out=other)
    other *= b
    second += other
    return first, second


def _scan(first: NDArray[np.complex128], second: NDArray[np.complex128]) -> None:
    """Turn the pairs (n, m) of m rows of quaternions into those of their products, in place."""
    count, many = first.shape
    if count < 6:
        for i in range(1, count):
            first[i], second[i] = _multiply_pairs(first[i - 1], second[i - 1], first[i], second[i])
        return
    length = math.isqrt(count - 1) + 1
    blocks = -(-count // length)

    def in_step(values: NDArray[np.complex128], rest: float) -> NDArray[np.complex128]:
        """As (length, blocks, m), the last block filled up with `rest`."""
        filled = np.full((blocks * length, many), rest, np.complex128)
        filled[:count] = values
        return np.ascontiguousarray(filled.reshape(blocks, length, many).swapaxes(0, 1))

    a, b = in_step(first, 1.0), in_step(second, 0.0)
    for i in range(1, length):
        a[i], b[i] = _multiply_pairs(a[i - 1], b[i - 1], a[i], b[i])
    before_a, before_b = a[-1].copy(), b[-1].copy()
    _scan(before_a, before_b)
    # Some rows at a time: few enough to stay in the processor's cache, else as many as can be.
    rows = max(1, 2**13 // (blocks * many))
    for i in range(0, length, rows):
        here = np.s_[i : i + rows, 1:]
        a[here], b[here] = _multiply_pairs(before_a[:-1], before_b[:-1], a[here], b[here])
    first[:] = a.swapaxes(0, 1).reshape(-1, many)[:count]
    second[:] = b.swapaxes(0, 1).reshape(-1, many)[:count]
