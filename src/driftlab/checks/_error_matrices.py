"""Error matrices of a triad, and the whole matrix or another unit in the place of one."""

from __future__ import annotations

import warnings

import numpy as np

from ._arrays import FloatArray
from ._magnitudes import UnusualWarning

LARGEST_ERROR = 1.0
"""Largest entry of an error matrix: with more, a gyro feels more across its axis than along it."""
LARGEST_SCALE = 4.0
"""Largest scale error of a unit whose readings were given another nominal scale than they have."""
_NEAR_ONE, _PERHAPS_ONE = 0.2, 0.4
"""Within the first of one, all three diagonal entries are taken for those of I + M; within the
second they may be. A triad that reads double is possible where its nominal scale is another: the
range of a gyro set to twice what one thought, say."""
_WHOLE = (
    "expected the matrix M of measured = (I + M) true, got a diagonal near one: "
    "is it the whole matrix I + M?"
)


def error_matrix(matrix: FloatArray, name: str, scale: float = LARGEST_ERROR) -> FloatArray:
    """Return an error matrix M of a triad, refusing the whole matrix I + M.

    Parameters
    ----------
    matrix : ndarray, shape (..., 3, 3)
        Finite numbers.
    name : str
        Name of the argument, for the sentence.
    scale : float
        Largest usual size of a diagonal entry. If it is larger than one, a triad may well read
        double, and the whole matrix is only warned of.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        `matrix` itself.

    Raises
    ------
    ValueError
        If all three diagonal entries of a matrix are within a fifth of one.

    Warns
    -----
    UnusualWarning
        If an entry is larger than one, or than `scale` on the diagonal; if all three diagonal
        entries are within two fifths of one.

    Examples
    --------
    >>> error_matrix(np.eye(3), "triad_error")  # doctest: +NORMALIZE_WHITESPACE
    Traceback (most recent call last):
    ValueError: triad_error: expected the matrix M of measured = (I + M) true, got a diagonal near
    one: is it the whole matrix I + M? Subtract the identity.
    """
    if scale <= LARGEST_ERROR and _is_whole(matrix):
        raise ValueError(f"{name}: {_WHOLE} Subtract the identity.")
    if _is_whole(matrix, _PERHAPS_ONE):
        warnings.warn(f"{name}: {_WHOLE} If so, subtract the identity.", UnusualWarning, 3)
    excess = np.abs(matrix) / (LARGEST_ERROR + (scale - LARGEST_ERROR) * np.eye(3))
    if excess.max() > 1:
        warnings.warn(
            f"{name}: an entry is {matrix.flat[excess.argmax()]:g}, and they are rad or parts of "
            "the scale. If mrad, ppm or arc seconds were meant, multiply by 1e-3, 1e-6 or "
            "scipy.constants.arcsecond.",
            UnusualWarning,
            stacklevel=3,
        )
    return matrix


def linear_error_matrix(matrix: FloatArray, name: str) -> FloatArray:
    """Return an error matrix of which the result is linear, warning of the whole matrix I + M.

    A linear result is right in any unit of the matrix, and for the identity as well.

    Parameters
    ----------
    matrix : ndarray, shape (..., 3, 3)
        Finite numbers.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        `matrix` itself.

    Warns
    -----
    UnusualWarning
        If all three diagonal entries of a matrix are within a fifth of one.

    Examples
    --------
    >>> float(linear_error_matrix(2 * np.eye(3), "triad_error")[0, 0])
    2.0
    """
    if _is_whole(matrix):
        warnings.warn(f"{name}: {_WHOLE} If so, subtract the identity.", UnusualWarning, 3)
    return matrix


def _is_whole(matrix: FloatArray, near: float = _NEAR_ONE) -> bool:
    diagonal = np.einsum("...ii->...i", matrix)
    return bool((np.abs(diagonal - 1) <= near).all(axis=-1).any())
