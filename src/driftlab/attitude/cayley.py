"""Perelyaev & Chelnokov, section 1: Cayley transforms of a rotation and their Riccati equations.

A skew matrix and an orthogonal one belong together by n = (E - k)(E + k)^-1, which is its own
inverse. Applied to the 3x3 matrix of a rotation by phi about e it gives the vector -tan(phi/2) e,
applied to the 4x4 matrix of its quaternion -tan(phi/4) e. The first is infinite at half a turn, the
second at a whole turn only, and neither needs a sine or a cosine to give the rotation back.

The vector of dimension 4 is minus the modified Rodrigues vector, that of dimension 3 minus the
Rodrigues (Gibbs) vector. Both follow a Riccati equation, quadratic in the vector.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    nonzero_vectors,
    unit_quaternions,
)
from driftlab.core.attitude import rotation_quaternion as core_rotation_quaternion
from driftlab.core.quaternion import pure, right_matrix
from driftlab.core.vectors import norms


def cayley_transform(matrix: ArrayLike) -> FloatArray:
    """Return (E - X)(E + X)^-1, which maps skew to orthogonal matrices and back; (1.2).

    Parameters
    ----------
    matrix : array_like, shape (..., n, n)
        A skew or an orthogonal matrix.

    Returns
    -------
    ndarray, shape (..., n, n)

    Raises
    ------
    ValueError
        If E + X is singular to rounding. An orthogonal X has the eigenvalue -1 then; of skew ones
        only those come near that are singular, or nearly so, and of a size of 1e15.
    """
    x = finite_array(matrix, "matrix")
    if x.ndim < 2 or x.shape[-1] != x.shape[-2]:
        raise ValueError(f"matrix: expected shape (..., n, n), got shape {x.shape}.")
    unit = np.eye(x.shape[-1])
    # From here on the smallest singular value of E + X cannot be told from zero.
    condition = np.linalg.cond(unit + x).max()
    if not condition < 1 / (x.shape[-1] * np.finfo(float).eps):
        raise ValueError("matrix: expected one without the eigenvalue -1, got E + X singular.")
    # The two factors commute, so the inverse may stand on the left.
    return np.asarray(np.linalg.solve(unit + x, unit - x), np.float64)


def skew_operator(vector: ArrayLike, dimension: int = 4) -> FloatArray:
    """Skew matrix of a vector k or of a rate, in the pattern of (1.2) and (1.5).

    Parameters
    ----------
    vector : array_like, shape (..., 3)
    dimension : {4, 3}
        4 for the matrix of ``p -> p∘k``; 3 for its last three rows and columns, in the paper's
        scalar-first order: the matrix of ``p -> p × k``.

    Returns
    -------
    ndarray, shape (..., dimension, dimension)
        Rows and columns have the book's order, scalar last.
    """
    matrix = right_matrix(pure(finite_array(vector, "vector", 3)))
    return matrix if _checked(dimension) == 4 else matrix[..., :3, :3]


def cayley_vector(quaternion: ArrayLike, dimension: int = 4) -> FloatArray:
    """Vector k of a rotation: -tan(phi/4) e for dimension 4, (1.9), -tan(phi/2) e for 3.

    Parameters
    ----------
    quaternion : array_like, shape (..., 4)
        Need not be of unit norm. For dimension 4 its sign counts: the quaternions q and -q have
        different vectors, each the `shadow` of the other.
    dimension : {4, 3}

    Returns
    -------
    ndarray, shape (..., 3)

    Raises
    ------
    ValueError
        Where k is infinite: at whole turns (dimension 4) or half turns (dimension 3). A quaternion
        that is a rounding error away from there has a finite vector, of a length of 1e15 or more.
    """
    vector, scalar = np.split(unit_quaternions(quaternion, "quaternion"), [3], axis=-1)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        if _checked(dimension) == 3:
            k = -vector / scalar
        else:
            sine = norms(vector)[..., np.newaxis]
            # v/(1 + s) equals ((1 - s)/|v|) v/|v|; either is free of cancellation for its sign.
            forward = vector / (1 + scalar)
            backward = (1 - scalar) / sine * (vector / sine)
            k = -np.where(scalar < 0, backward, forward)
    if not np.isfinite(k).all():
        turn = "half" if dimension == 3 else "whole"
        raise ValueError(f"quaternion: expected no {turn} turn, where k is infinite.")
    return k


def rotation_quaternion(vector: ArrayLike, dimension: int = 4) -> FloatArray:
    """Unit quaternion of a vector k: (1.8), without sine or cosine.

    Parameters
    ----------
    vector : array_like, shape (..., 3)
        k = -tan(phi/4) e for dimension 4, -tan(phi/2) e for 3.
    dimension : {4, 3}

    Returns
    -------
    ndarray, shape (..., 4)
    """
    k = finite_array(vector, "vector", 3)
    if _checked(dimension) == 4:
        return core_rotation_quaternion(k)
    # Both are divided by the largest entry: its square may overflow.
    size = np.maximum(np.abs(k).max(axis=-1, keepdims=True), 1.0)
    k, one = k / size, 1 / size
    quaternion = np.concatenate([-k, one], axis=-1)
    return quaternion / np.sqrt(np.sum(k**2, axis=-1, keepdims=True) + one**2)


def shadow(vector: ArrayLike) -> FloatArray:
    """Vector -k/|k|^2 (..., 3) of dimension 4: the same attitude, reached the other way round.

    Where k is long its shadow is short, and the other way round; both have length 1 at half a
    turn. A zero vector is refused, because its shadow is infinite.
    """
    direction, norm = nonzero_vectors(vector, "vector")
    with np.errstate(over="ignore"):
        other = -direction / norm[..., np.newaxis]
    if not np.isfinite(other).all():
        raise ValueError("vector: expected vectors with a finite shadow, got one too short.")
    return other


def _checked(dimension: int) -> int:
    if not isinstance(dimension, int) or dimension not in (3, 4):
        raise ValueError(f"dimension: expected 3 or 4, got {dimension!r}.")
    return dimension
