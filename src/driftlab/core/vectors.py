"""Vectors of three components along the last axis, unless said otherwise."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray


def norms(vectors: FloatArray) -> FloatArray:
    """Norms (...) of vectors (..., 3), right for vectors of any size."""
    squares = np.asarray(np.einsum("...i,...i->...", vectors, vectors))
    norms = np.asarray(np.sqrt(squares))
    # Where squares may have under- or overflowed, take the slower way that forms none.
    unsafe = ~((squares > 1e-280) & (squares < 1e300))
    if unsafe.any():
        x, y, z = vectors[unsafe].T
        norms[unsafe] = np.hypot(np.hypot(x, y), z)
    return norms


def components(vectors: FloatArray) -> list[FloatArray]:
    """Views (...) of what stands along the last axis; for few vectors sooner than `np.moveaxis`."""
    return [vectors[..., i] for i in range(vectors.shape[-1])]


def stacked(*parts: FloatArray) -> FloatArray:
    """Vectors (..., n) of n components (...) of one shape; for few sooner than `np.stack`."""
    vectors = np.empty((*parts[0].shape, len(parts)))
    for i, part in enumerate(parts):
        vectors[..., i] = part
    return vectors


def components_first(vectors: NDArray[Any]) -> NDArray[Any]:
    """View (3, ...) of vectors (..., 3): of `np.moveaxis`, what it comes to."""
    return vectors.transpose(vectors.ndim - 1, *range(vectors.ndim - 1))


def components_last(vectors: NDArray[Any]) -> NDArray[Any]:
    """View (..., 3) of vectors (3, ...)."""
    return vectors.transpose(*range(1, vectors.ndim), 0)


def cross(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """Cross product of vectors whose components stand along the *first* axis, (3, ...)."""
    x = a[1] * b[2] - a[2] * b[1]
    product = np.empty((3, *x.shape), x.dtype)
    product[0], product[1], product[2] = x, a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    return product


def cross_matrix(vector: FloatArray) -> FloatArray:
    """Matrix (..., 3, 3) of ``vector × ...``, for vectors (..., 3)."""
    matrix = np.zeros((*vector.shape, 3))
    matrix[..., 0, 1], matrix[..., 0, 2] = -vector[..., 2], vector[..., 1]
    matrix[..., 1, 0], matrix[..., 1, 2] = vector[..., 2], -vector[..., 0]
    matrix[..., 2, 0], matrix[..., 2, 1] = -vector[..., 1], vector[..., 0]
    return matrix


def left_jacobian(vector: FloatArray) -> FloatArray:
    """Left Jacobians (..., 3, 3) of SO(3) at rotation vectors (..., 3).

    Each is the mean of the rotation matrices from the identity to the rotation itself.
    """
    # A tiny stand-in for 0 gives sin(x)/x = 1 without a division by zero.
    angle = np.maximum(norms(vector), np.finfo(float).tiny)[..., np.newaxis, np.newaxis]
    n = vector / angle[..., 0]
    sine, cosine = np.sin(angle) / angle, 2 * np.sin(angle / 2) ** 2 / angle
    outer = n[..., :, np.newaxis] * n[..., np.newaxis, :]
    return sine * np.eye(3) + cosine * cross_matrix(n) + (1 - sine) * outer


def wrap_angle(angle: FloatArray) -> FloatArray:
    """Angles (...) in rad brought to -pi to pi."""
    wrapped: FloatArray = np.arctan2(np.sin(angle), np.cos(angle))
    return wrapped


def transform(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Vectors (..., 3) seen through matrices (..., 3, 3)."""
    return np.einsum("...ij,...j->...i", matrix, vector)


def symmetric_part(matrix: FloatArray) -> FloatArray:
    """Half the sum of matrices (..., 3, 3) and their transposes."""
    return 0.5 * (matrix + np.swapaxes(matrix, -1, -2))
