"""Error matrix of a sensor triad: what it makes of a rate, and its three parts.

A triad with error matrix K measures ``(I + K) w``; Wu et al., sections 2 and 3. Any K is a sum of
three matrices: a diagonal one (scale-factor errors), a symmetric one (non-orthogonality) and a
skew one, the *misalignment*: a small rotation of the triad as a whole.

Data sheets say cross-coupling (or cross-axis sensitivity) for an entry off the diagonal.

A function of one triad calls the whole matrix `error_matrix`, M in Part I; where there are two
triads they are `gyro_error_matrix` and `accelerometer_error_matrix`, K and L from Part III on.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .checks import (
    FloatArray,
    finite_array,
    finite_arrays,
    linear_error_matrix,
    plausible_error_matrix,
)
from .core.vectors import symmetric_part, transform


class TriadErrors(NamedTuple):
    """An error matrix as the sum of three matrices.

    Attributes
    ----------
    scale_factor : ndarray, shape (..., 3, 3)
        Diagonal part: scale-factor errors, without unit.
    non_orthogonality : ndarray, shape (..., 3, 3)
        Symmetric part with zero diagonal, rad.
    misalignment : ndarray, shape (..., 3, 3)
        Skew part, rad.
    """

    scale_factor: FloatArray
    non_orthogonality: FloatArray
    misalignment: FloatArray


def split_error_matrix(matrix: ArrayLike) -> TriadErrors:
    """Decompose an error matrix into scale factors, non-orthogonality and misalignment.

    Parameters
    ----------
    matrix : array_like, shape (..., 3, 3)
        Error matrix K of a triad that measures ``(I + K) w``.

    Returns
    -------
    TriadErrors
        Three matrices whose sum is `matrix`; Wu et al., (7)-(15).

    Warns
    -----
    UnusualWarning
        If its diagonal is near one, as that of the whole matrix I + K.

    See Also
    --------
    driftlab.drift.principal_drifts : What the symmetric part does.

    Examples
    --------
    >>> parts = split_error_matrix([[1, 2, 0], [4, 5, 0], [0, 0, 9]])
    >>> parts.misalignment
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  0.]])
    """
    matrix = linear_error_matrix(finite_array(matrix, "matrix", 3, 3), "matrix")
    transposed = np.swapaxes(matrix, -1, -2)
    scale = matrix * np.eye(3)
    return TriadErrors(
        scale, 0.5 * matrix + 0.5 * transposed - scale, 0.5 * matrix - 0.5 * transposed
    )


def triad_matrix(error_matrix: ArrayLike) -> FloatArray:
    """Matrix A = I + M of a triad, its rows being the sensitive axes; Larin (1.5), (2.4).

    Parameters
    ----------
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of all errors of the triad, without unit.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        A, from true components to measured ones.

    Raises
    ------
    ValueError
        If A is singular: its axes lie in one plane, and the rate across it is never measured.

    Examples
    --------
    >>> triad_matrix([[0, 0.01, 0], [0, 0, 0], [0, 0, 0]])
    array([[1.  , 0.01, 0.  ],
           [0.  , 1.  , 0.  ],
           [0.  , 0.  , 1.  ]])
    """
    return checked_triad(
        plausible_error_matrix(finite_array(error_matrix, "error_matrix", 3, 3), "error_matrix")
    )


def checked_triad(error_matrix: FloatArray) -> FloatArray:
    """Return I + M, (..., 3, 3), refusing sensitive axes that do not span space."""
    triad: FloatArray = np.eye(3) + error_matrix
    # Errors whose squares add up to less than 1/4 leave singular values above 1/2.
    large = np.einsum("...ij,...ij->...", error_matrix, error_matrix) > 0.25
    if (np.linalg.cond(triad[large]) > 1e12).any():
        raise ValueError(
            "error_matrix: expected three sensitive axes that span space, "
            "got a singular triad matrix I + M."
        )
    return triad


def measured_rate(rate: ArrayLike, error_matrix: ArrayLike) -> FloatArray:
    """Rate that a gyro triad measures, without bias and noise; Larin (1.5).

    Parameters
    ----------
    rate : array_like, shape (..., 3)
        True angular rate in body axes, rad/s.
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of all errors of the triad, without unit.

    Returns
    -------
    ndarray, shape (..., 3)
        (I + M) rate, rad/s.

    See Also
    --------
    driftlab.drift.drift_per_revolution : What becomes of it.
    split_error_matrix : The parts of the matrix.

    Examples
    --------
    The x gyro leans towards the y axis and measures a part of the rate about it:

    >>> measured_rate([0, 2, 0], [[0, 0.01, 0], [0, 0, 0], [0, 0, 0]])
    array([0.02, 2.  , 0.  ])
    """
    rate, error_matrix = finite_arrays(rate=(rate, 3), error_matrix=(error_matrix, 3, 3))
    return transform(checked_triad(plausible_error_matrix(error_matrix, "error_matrix")), rate)


def non_orthogonality(error_matrix: ArrayLike) -> FloatArray:
    """Symmetric part of an error matrix, which alone makes drift to first order; Larin (2.5).

    Parameters
    ----------
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of all errors of the triad, without unit.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Sigma = (M + M^T)/2, its diagonal included.

    Examples
    --------
    >>> non_orthogonality([[0, 0.02, 0], [0, 0, 0], [0, 0, 0]])
    array([[0.  , 0.01, 0.  ],
           [0.01, 0.  , 0.  ],
           [0.  , 0.  , 0.  ]])
    """
    error = linear_error_matrix(finite_array(error_matrix, "error_matrix", 3, 3), "error_matrix")
    return symmetric_part(error)


def pairwise_non_orthogonality(axes: ArrayLike) -> FloatArray:
    r"""Non-orthogonality of each pair of sensitive axes; Larin, remark before (2.5).

    Parameters
    ----------
    axes : array_like, shape (..., 3, 3)
        Sensitive axes i_x, i_y, i_z as rows, unit vectors.

    Returns
    -------
    ndarray, shape (..., 3)
        [sigma1, sigma2, sigma3] of the pairs (x, y), (x, z) and (y, z).

    Notes
    -----
    It is half the cosine of the angle between the two axes to first order, and depends on no other
    angle:

    .. math:: \sigma_1 = 1 - |i_x - i_y| / \sqrt 2.

    Examples
    --------
    >>> angle = 0.01  # of the y axis towards the x axis, rad
    >>> axes = [[1, 0, 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    >>> pairwise_non_orthogonality(axes).round(4)
    array([0.005, 0.   , 0.   ])
    """
    axes = finite_array(axes, "axes", 3, 3)
    if not np.allclose(np.linalg.norm(axes, axis=-1), 1, rtol=0, atol=1e-9):
        raise ValueError("axes: expected rows of unit length, got rows of another length.")
    pairs = axes[..., [0, 0, 1], :] - axes[..., [1, 2, 2], :]
    return 1 - np.linalg.norm(pairs, axis=-1) / np.sqrt(2)
