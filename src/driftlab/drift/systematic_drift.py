"""Systematic drift of a bent gyro triad at a constant rate; Larin, section 2.

A triad with the error M measures ``(I + M) rate``. With n the direction of a constant rate, the
error rotates with |measured rate| - |rate| once the whole turns are taken out, and that difference
is, to first order, n^T M n times the rate: only the symmetric part of M drifts.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_arrays,
    linear_error_matrix,
    nonzero_vectors,
    plausible_error_matrix,
    truth_value,
)
from driftlab.core.vectors import norms, symmetric_part, transform
from driftlab.triad import checked_triad


def drift_coefficient(direction: ArrayLike, error_matrix: ArrayLike) -> FloatArray:
    r"""Drift rate in units of the turn rate, rho = n^T M n, to first order; Larin (2.2).

    Parameters
    ----------
    direction : array_like, shape (..., 3)
        Axis n of the rotation in body axes; only its direction counts, it must not be zero.
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of the errors of the triad, without unit.

    Returns
    -------
    ndarray, shape (...)
        rho, without unit.

    See Also
    --------
    drift_per_revolution : Exact, for a whole turn.
    principal_drifts : The worst axes.

    Notes
    -----
    Only the symmetric part of the matrix counts:

    .. math:: \rho = n^T M\, n = n^T \Sigma\, n, \qquad \Sigma = \tfrac12 (M + M^T).

    Examples
    --------
    About the bisector of x and y both non-diagonal entries count; about x alone neither does:

    >>> error_matrix = [[0, 0.01, 0], [0.03, 0, 0], [0, 0, 0]]
    >>> drift_coefficient([[1, 1, 0], [1, 0, 0]], error_matrix).round(9)
    array([0.02, 0.  ])
    """
    direction, error_matrix = finite_arrays(
        direction=(direction, 3), error_matrix=(error_matrix, 3, 3)
    )
    linear_error_matrix(error_matrix, "error_matrix")
    return _along_and_across(nonzero_vectors(direction, "direction")[0], error_matrix)[0]


def _exact_drift_coefficient(direction: ArrayLike, error_matrix: ArrayLike) -> FloatArray:
    """Drift rate (...) in units of the turn rate, |(I + M) n| - 1, for errors of any size."""
    direction, error_matrix = finite_arrays(
        direction=(direction, 3), error_matrix=(error_matrix, 3, 3)
    )
    plausible_error_matrix(error_matrix, "error_matrix")
    n, _ = nonzero_vectors(direction, "direction")
    rho, across = _along_and_across(n, error_matrix)
    # |A n| - 1 = (|A n|^2 - 1)/(|A n| + 1), without the loss of digits of the subtraction.
    return (2 * rho + rho**2 + across) / (norms(transform(checked_triad(error_matrix), n)) + 1)


def _along_and_across(n: FloatArray, error_matrix: FloatArray) -> tuple[FloatArray, FloatArray]:
    """n^T M n, and |M n|^2 - (n^T M n)^2, the square of the part of M n across n."""
    error = transform(error_matrix, n)
    along = np.einsum("...i,...i->...", n, error)
    across = error - along[..., np.newaxis] * n
    return along, np.einsum("...i,...i->...", across, across)


def drift_per_revolution(direction: ArrayLike, error_matrix: ArrayLike) -> FloatArray:
    r"""Drift angle after one whole turn: Larin (2.3), without approximation.

    Parameters
    ----------
    direction : array_like, shape (..., 3)
        Axis n of the turn in body axes; only its direction counts, it must not be zero.
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of the errors of the triad, without unit, which measures A = I + M times the rate.

    Returns
    -------
    ndarray, shape (...)
        rad, positive when the apparent frame runs ahead.

    See Also
    --------
    drift_coefficient : In units of the turn rate, to first order.
    drift_per_cycle : The same for any closed motion.

    Notes
    -----
    With A = I + M and a unit vector n it is

    .. math:: 2 \pi \left( |A n| - 1 \right) = 2 \pi\, n^T M\, n + O(|M|^2).

    After j turns the error is j times this angle, about the *measured* rate.

    Examples
    --------
    A non-orthogonality of one arc second between two axes, and a turn about their bisector:

    >>> second = np.radians(1 / 3600)
    >>> error_matrix = second * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
    >>> print(f"{drift_per_revolution([1, 1, 0], error_matrix) / second:.3f}")  # arc seconds
    6.283
    """
    return 2 * np.pi * _exact_drift_coefficient(direction, error_matrix)


def principal_drifts(
    error_matrix: ArrayLike, *, exact: bool = False
) -> tuple[FloatArray, FloatArray]:
    """Extreme drift coefficients and the axes that give them; Larin, before (2.6).

    Parameters
    ----------
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of the errors of the triad, without unit.
    exact : bool
        Take the singular values of A = I + M, less one, instead of the eigenvalues of Sigma.

    Returns
    -------
    coefficients : ndarray, shape (..., 3)
        Ascending, without unit: the drift coefficient of any axis lies between the first and the
        last.
    axes : ndarray, shape (..., 3, 3)
        The unit axes as rows, in the same order, each with its largest entry positive.

    See Also
    --------
    drift_coefficient : About an axis of your own.
    driftlab.triad.split_error_matrix : The parts of the matrix.

    Examples
    --------
    >>> coefficients, axes = principal_drifts([[0, 0.02, 0], [0, 0, 0], [0, 0, 0.005]])
    >>> print(coefficients.round(9))
    [-0.01   0.005  0.01 ]
    >>> print(np.abs(axes[2]).round(4))
    [0.7071 0.7071 0.    ]
    """
    truth_value(exact, "exact")
    error_matrix = finite_array(error_matrix, "error_matrix", 3, 3)
    (plausible_error_matrix if exact else linear_error_matrix)(error_matrix, "error_matrix")
    symmetric = symmetric_part(error_matrix)
    if exact:
        # A^T A - I; its eigenvalues are the squares of the singular values of A, less one.
        symmetric = 2 * symmetric + np.swapaxes(error_matrix, -1, -2) @ error_matrix
    coefficients, vectors = np.linalg.eigh(symmetric)
    if exact:
        coefficients = coefficients / (np.sqrt(np.maximum(1 + coefficients, 0)) + 1)
    axes = np.swapaxes(vectors, -1, -2)
    largest = np.take_along_axis(axes, np.abs(axes).argmax(axis=-1, keepdims=True), axis=-1)
    return coefficients, axes * np.sign(largest)
