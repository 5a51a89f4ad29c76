"""Vectors of three components: norms, cross products, angles, directions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import FloatArray, finite_array, finite_arrays


def lengths(vectors: FloatArray) -> FloatArray:
    """Norms (...) of vectors (..., 3), right for vectors of any size."""
    squares = np.asarray(np.einsum("...i,...i->...", vectors, vectors))
    norms = np.asarray(np.sqrt(squares))
    # Where squares may have under- or overflowed, take the slower way that forms none.
    unsafe = ~((squares > 1e-280) & (squares < 1e300))
    if unsafe.any():
        x, y, z = vectors[unsafe].T
        norms[unsafe] = np.hypot(np.hypot(x, y), z)
    return norms


def direction_from_angles(azimuth: ArrayLike, elevation: ArrayLike) -> FloatArray:
    """Unit vector (..., 3) from its azimuth and elevation.

    Parameters
    ----------
    azimuth : array_like, shape (...)
        Angle about axis 3, counted from axis 1, rad.
    elevation : array_like, shape (...)
        Angle above the plane of axes 1 and 2, rad.
    """
    azimuth, elevation = np.broadcast_arrays(
        *finite_arrays(azimuth=(azimuth,), elevation=(elevation,))
    )
    level = np.cos(elevation)
    return np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=-1)


def cross_matrix(vector: ArrayLike) -> FloatArray:
    """Matrix (..., 3, 3) of the cross product ``vector × ...``, for vectors (..., 3)."""
    x, y, z = np.moveaxis(finite_array(vector, "vector", 3), -1, 0)
    matrix = np.zeros((*x.shape, 3, 3))
    matrix[..., 0, 1], matrix[..., 0, 2] = -z, y
    matrix[..., 1, 0], matrix[..., 1, 2] = z, -x
    matrix[..., 2, 0], matrix[..., 2, 1] = -y, x
    return matrix


def wrapped(angle: FloatArray) -> FloatArray:
    """Angles (...) in rad brought to -pi to pi."""
    return np.asarray(np.arctan2(np.sin(angle), np.cos(angle)))


def turning_average(rotation_vector: ArrayLike) -> FloatArray:
    """Mean (3, 3) of the rotation matrices on the way from none to `rotation_vector` (3,), rad."""
    vector = finite_array(rotation_vector, "rotation_vector", 3)
    angle = float(np.linalg.norm(vector))
    if angle == 0:
        return np.eye(3)
    n = vector / angle
    cross = np.cross(n, np.eye(3)).T  # [n×]
    sine, cosine = np.sin(angle) / angle, 2 * np.sin(angle / 2) ** 2 / angle
    return sine * np.eye(3) + cosine * cross + (1 - sine) * np.outer(n, n)


def cross(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """Cross product of vectors whose components stand along the *first* axis, (3, ...)."""
    return np.stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )
