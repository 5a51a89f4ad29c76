"""Cayley transforms of a rotation and their Riccati equations; Perelyaev & Chelnokov, section 1.

A skew matrix and an orthogonal one belong together by n = (I - k)(I + k)^-1, which is its own
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
    chosen_number,
    finite_array,
    nonzero_vectors,
    unit_quaternions,
)
from driftlab.core.attitude import rotation_quaternion as core_rotation_quaternion
from driftlab.core.quaternion import pure, right_matrix
from driftlab.core.vectors import norms


def cayley_transform(matrix: ArrayLike) -> FloatArray:
    """Cayley transform (I - X)(I + X)^-1 of a matrix X; (1.2).

    It maps skew matrices to orthogonal ones and back: the transform is its own inverse.

    Parameters
    ----------
    matrix : array_like, shape (..., n, n)
        A skew or an orthogonal matrix X.

    Returns
    -------
    ndarray, shape (..., n, n)
        Orthogonal if X is skew, skew if X is orthogonal.

    Raises
    ------
    ValueError
        If I + X is singular to rounding, as for an orthogonal X with the eigenvalue -1.

    Examples
    --------
    A quarter turn in the plane becomes the skew matrix of tan(pi/4):

    >>> cayley_transform([[0, -1], [1, 0]])
    array([[ 0.,  1.],
           [-1.,  0.]])
    """
    x = finite_array(matrix, "matrix")
    if x.ndim < 2 or x.shape[-1] != x.shape[-2]:
        raise ValueError(f"matrix: expected shape (..., n, n), got shape {x.shape}.")
    unit = np.eye(x.shape[-1])
    # From here on the smallest singular value of I + X cannot be told from zero.
    condition = np.linalg.cond(unit + x).max()
    if not condition < 1 / (x.shape[-1] * np.finfo(float).eps):
        raise ValueError("matrix: expected one without the eigenvalue -1, got I + X singular.")
    # The two factors commute, so the inverse may stand on the left.
    return np.asarray(np.linalg.solve(unit + x, unit - x), np.float64)


def skew_operator(vector: ArrayLike, dimension: int = 4) -> FloatArray:
    """Skew matrix of a vector k, or of an angular rate; (1.2), (1.5).

    Parameters
    ----------
    vector : array_like, shape (..., 3)
        Cayley vector, without unit, or angular rate, rad/s.
    dimension : {4, 3}
        4 for the matrix of ``p -> p∘k``, 3 for its block of the vector parts: the matrix of
        ``p -> p×k``.

    Returns
    -------
    ndarray, shape (..., dimension, dimension)
        In the unit of `vector`. Rows and columns are in the order of this package, scalar last; the
        paper puts the scalar first.

    Examples
    --------
    >>> skew_operator([0, 0, 1], 3) @ [0, 1, 0]
    array([1., 0., 0.])
    """
    matrix = right_matrix(pure(finite_array(vector, "vector", 3)))
    return matrix if chosen_number(dimension, (3, 4), "dimension") == 4 else matrix[..., :3, :3]


def cayley_vector(quaternion: ArrayLike, dimension: int = 4) -> FloatArray:
    """Cayley vector k of a rotation; (1.9).

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)
        Need not be of unit norm. For dimension 4 its sign matters: the quaternions q and -q have
        different vectors, each the `shadow` of the other.
    dimension : {4, 3}
        Of the matrices whose Cayley transform the vector describes.

    Returns
    -------
    ndarray, shape (..., 3)
        -tan(phi/4) e for dimension 4, -tan(phi/2) e for dimension 3, where phi is the angle and e
        the axis of the rotation. Without unit.

    Raises
    ------
    ValueError
        Where k is infinite: at whole turns (dimension 4) or half turns (dimension 3).

    Examples
    --------
    A third of a turn about the diagonal:

    >>> cayley_vector([0.5, 0.5, 0.5, 0.5]).round(4)
    array([-0.3333, -0.3333, -0.3333])
    >>> cayley_vector([0.5, 0.5, 0.5, 0.5], dimension=3)
    array([-1., -1., -1.])
    """
    vector, scalar = np.split(unit_quaternions(quaternion, "quaternion"), [3], axis=-1)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        if chosen_number(dimension, (3, 4), "dimension") == 3:
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
    r"""Unit quaternion of a Cayley vector k, without sine or cosine; (1.8).

    Parameters
    ----------
    vector : array_like, shape (..., 3)
        k = -tan(phi/4) e for dimension 4, -tan(phi/2) e for dimension 3.
    dimension : {4, 3}
        Of the matrices whose Cayley transform the vector describes.

    Returns
    -------
    ndarray, shape (..., 4)
        Body to reference, scalar last.

    Notes
    -----
    With the vector part first, for dimension 4 and for dimension 3

    .. math:: q = \frac{(-2 k,\; 1 - |k|^2)}{1 + |k|^2} \quad\text{or}\quad
              q = \frac{(-k,\; 1)}{\sqrt{1 + |k|^2}}.

    Examples
    --------
    >>> rotation_quaternion([-1 / 3, -1 / 3, -1 / 3]).round(12)
    array([0.5, 0.5, 0.5, 0.5])
    >>> rotation_quaternion([-1, -1, -1], dimension=3)
    array([0.5, 0.5, 0.5, 0.5])
    """
    k = finite_array(vector, "vector", 3)
    if chosen_number(dimension, (3, 4), "dimension") == 4:
        return core_rotation_quaternion(k)
    # Both are divided by the largest entry: its square may overflow.
    size = np.maximum(np.abs(k).max(axis=-1, keepdims=True), 1.0)
    k, one = k / size, 1 / size
    quaternion = np.concatenate([-k, one], axis=-1)
    return quaternion / np.sqrt(np.sum(k**2, axis=-1, keepdims=True) + one**2)


def shadow(vector: ArrayLike) -> FloatArray:
    """Other Cayley vector of the same attitude, -k/|k|^2; dimension 4 only.

    Parameters
    ----------
    vector : array_like, shape (..., 3)
        k = -tan(phi/4) e.

    Returns
    -------
    ndarray, shape (..., 3)
        Its quaternion is minus that of `vector`. Where k is long its shadow is short; both have
        length 1 at half a turn.

    Raises
    ------
    ValueError
        If a vector is zero, or so short that its shadow overflows.

    Examples
    --------
    >>> k = [2, 1, 2]
    >>> rotation_quaternion([k, shadow(k)]).round(12)
    array([[-0.4, -0.2, -0.4, -0.8],
           [ 0.4,  0.2,  0.4,  0.8]])
    """
    direction, norm = nonzero_vectors(vector, "vector")
    with np.errstate(over="ignore"):
        other = -direction / norm[..., np.newaxis]
    if not np.isfinite(other).all():
        raise ValueError("vector: expected vectors with a finite shadow, got one too short.")
    return other
