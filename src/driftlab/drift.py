"""Larin, section 2: characteristic equation, its roots, and the systematic drift of a bent triad.

A triad with misalignment M measures ``(E + M) rate``. With n the direction of a constant rate, the
error rotates with |measured rate| - |rate| once the whole turns are taken out, and that difference
is, to first order, n^T M n times the rate: only the symmetric part of M drifts.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import (
    ComplexArray,
    FloatArray,
    finite_array,
    finite_arrays,
    lengths,
    nonzero_vectors,
)
from .quaternion import left_matrix, pure, right_matrix


def triad_matrix(misalignment: ArrayLike) -> FloatArray:
    """A = E + M (..., 3, 3), rows the sensitive axes; Larin (1.5), (2.4).

    Raises
    ------
    ValueError
        If A is singular: its axes lie in one plane, and the rate across it is never measured.
    """
    triad = np.eye(3) + finite_array(misalignment, "misalignment", 3, 3)
    if (np.linalg.cond(triad) > 1e12).any():
        raise ValueError(
            "misalignment: expected three sensitive axes that span space, "
            "got a singular triad matrix E + M."
        )
    return triad


def measured_rate(rate: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """What the triad says (..., 3) of a true `rate` (..., 3), both in rad/s; Larin (1.5)."""
    rate, misalignment = finite_arrays(rate=(rate, 3), misalignment=(misalignment, 3, 3))
    return np.einsum("...ij,...j->...i", triad_matrix(misalignment), rate)


def characteristic_polynomial(
    rate: ArrayLike, measured_rate: ArrayLike, *, as_printed: bool = False
) -> FloatArray:
    """Coefficients (..., 5), highest power first, of det(sE - Omega_e); Larin (2.1), corrected.

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s.
    as_printed : bool
        Use the coefficient of s^2 that the paper prints, 4 w^T w + 4 w^T eps + eps^T eps. It lacks
        one eps^T eps, and is offered only to show what that changes.

    Notes
    -----
    The right coefficients are 1, 0, 2(|w|^2 + |w_hat|^2), 0, (|w_hat|^2 - |w|^2)^2.
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    error = measured_rate - rate
    rate_squared, along, error_squared = (
        np.einsum("...i,...i->...", a, b) for a, b in ((rate, rate), (rate, error), (error, error))
    )
    quadratic = 4 * rate_squared + 4 * along + (1 if as_printed else 2) * error_squared
    constant = (2 * along + error_squared) ** 2
    zero = np.zeros_like(quadratic)
    return np.stack([zero + 1, zero, quadratic, zero, constant], axis=-1)


def exact_roots(rate: ArrayLike, measured_rate: ArrayLike) -> ComplexArray:
    """The four eigenvalues of Omega_e, (..., 4), in rad/s: the exact roots of (2.1).

    In the order +i(|w_hat|+|w|), -i(|w_hat|+|w|), +i(|w_hat|-|w|), -i(|w_hat|-|w|): the sum and
    the difference of the two commuting halves of Omega_e.
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    total = lengths(measured_rate) + lengths(rate)
    # |w_hat| - |w| without the loss of digits that the subtraction would bring.
    middle = (measured_rate + rate) / np.where(total == 0, 1.0, total)[..., np.newaxis]
    difference = np.einsum("...i,...i->...", middle, measured_rate - rate)
    return 1j * np.stack([total, -total, difference, -difference], axis=-1)


def asymptotic_roots(rate: ArrayLike, misalignment: ArrayLike, *, order: int = 1) -> ComplexArray:
    """Roots (..., 4) of (2.1) for a small misalignment, in the order of `exact_roots`; Larin (2.2).

    Parameters
    ----------
    rate : array_like, shape (..., 3)
        True angular rate in body axes, rad/s, not zero.
    misalignment : array_like, shape (..., 3, 3)
        M = mu T, measured rate = (E + M) rate.
    order : {1, 2}
        1 is Larin's formula, theta = |w|(2 + rho); 2 adds |w|(|M n|^2 - rho^2)/2 to both pairs.
    """
    if order not in (1, 2):
        raise ValueError(f"order: expected 1 or 2, got {order!r}.")
    rate, misalignment = finite_arrays(rate=(rate, 3), misalignment=(misalignment, 3, 3))
    direction, norm = nonzero_vectors(rate, "rate")
    coefficient, across = _along_and_across(direction, misalignment)
    if order == 2:
        coefficient = coefficient + 0.5 * across
    fast, slow = norm * (2 + coefficient), norm * coefficient
    return 1j * np.stack([fast, -fast, slow, -slow], axis=-1)


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


def drift_coefficient(direction: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """rho = n^T M n (...): drift rate in units of the turn rate, to first order; Larin (2.2).

    Parameters
    ----------
    direction : array_like, shape (..., 3)
        Axis of the rotation in body axes; only its direction counts, it must not be zero.
    misalignment : array_like, shape (..., 3, 3)
    """
    direction, misalignment = finite_arrays(
        direction=(direction, 3), misalignment=(misalignment, 3, 3)
    )
    return _along_and_across(nonzero_vectors(direction, "direction")[0], misalignment)[0]


def exact_drift_coefficient(direction: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """|(E + M) n| - 1 (...): drift rate in units of the turn rate, for any size of misalignment."""
    direction, misalignment = finite_arrays(
        direction=(direction, 3), misalignment=(misalignment, 3, 3)
    )
    n, _ = nonzero_vectors(direction, "direction")
    rho, across = _along_and_across(n, misalignment)
    # |A n| - 1 = (|A n|^2 - 1)/(|A n| + 1), without the loss of digits of the subtraction.
    return (2 * rho + rho**2 + across) / (lengths(measured_rate(n, misalignment)) + 1)


def _along_and_across(n: FloatArray, misalignment: FloatArray) -> tuple[FloatArray, FloatArray]:
    """n^T M n, and |M n|^2 - (n^T M n)^2, the square of the part of M n across n."""
    error = np.einsum("...ij,...j->...i", misalignment, n)
    along = np.einsum("...i,...i->...", n, error)
    across = error - along[..., np.newaxis] * n
    return along, np.einsum("...i,...i->...", across, across)


def drift_per_turn(direction: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """Exact drift angle (...) in rad after one whole turn: Larin (2.3), without approximation.

    Parameters
    ----------
    direction : array_like, shape (..., 3)
        Axis n of the turn in body axes; only its direction counts, it must not be zero.
    misalignment : array_like, shape (..., 3, 3)
        M, dimensionless: the triad measures A = E + M times the rate.

    Notes
    -----
    2 pi (|A n| - 1), positive when the apparent frame runs ahead; 2 pi n^T M n to first order.
    After j turns the error is j times this angle, about the *measured* rate.
    """
    return 2 * np.pi * exact_drift_coefficient(direction, misalignment)


def split_error_rate_matrix(
    rate: ArrayLike, measured_rate: ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """V and W (..., 4, 4) with Omega_e = V + W and VW = WV; Larin, between (2.2) and (2.3).

    V is the part that comes back, exp(V t/2) = E after each whole turn t = 2 pi j/|w|. W is the
    systematic drift. Larin gives them to first order; split like this they hold exactly: W is
    right multiplication by the part (|w_hat| - |w|) of the measured rate.
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    n, norm = nonzero_vectors(rate, "rate")
    m, _ = nonzero_vectors(measured_rate, "measured_rate")
    drift_rate = exact_roots(rate, measured_rate)[..., 2].imag
    turning = right_matrix(pure(norm[..., np.newaxis] * m))
    periodic = turning - left_matrix(pure(norm[..., np.newaxis] * n))
    return periodic, right_matrix(pure(drift_rate[..., np.newaxis] * m))


def non_orthogonality(misalignment: ArrayLike) -> FloatArray:
    """Sigma = (M + M^T)/2 (..., 3, 3), all of M that drifts to first order; Larin (2.5)."""
    misalignment = finite_array(misalignment, "misalignment", 3, 3)
    return 0.5 * (misalignment + np.swapaxes(misalignment, -1, -2))


def principal_drifts(
    misalignment: ArrayLike, *, exact: bool = False
) -> tuple[FloatArray, FloatArray]:
    """Extreme drift coefficients and the axes that give them; Larin, before (2.6).

    Parameters
    ----------
    misalignment : array_like, shape (..., 3, 3)
    exact : bool
        Singular values of A = E + M, less one, in place of the eigenvalues of Sigma.

    Returns
    -------
    coefficients : ndarray, shape (..., 3)
        Rising: the drift coefficient lies between the first and the last, whatever the axis.
    axes : ndarray, shape (..., 3, 3)
        The unit axes as rows, in the same order, each with its largest entry positive.
    """
    misalignment = finite_array(misalignment, "misalignment", 3, 3)
    symmetric = non_orthogonality(misalignment)
    if exact:
        # A^T A - E; its eigenvalues are the squares of the singular values of A, less one.
        symmetric = 2 * symmetric + np.swapaxes(misalignment, -1, -2) @ misalignment
    coefficients, vectors = np.linalg.eigh(symmetric)
    if exact:
        coefficients = coefficients / (np.sqrt(np.maximum(1 + coefficients, 0)) + 1)
    axes = np.swapaxes(vectors, -1, -2)
    largest = np.take_along_axis(axes, np.abs(axes).argmax(axis=-1, keepdims=True), axis=-1)
    return coefficients, axes * np.sign(largest)


def pairwise_non_orthogonality(axes: ArrayLike) -> FloatArray:
    """[sigma1, sigma2, sigma3] (..., 3) of three sensitive axes; Larin, remark before (2.5).

    Parameters
    ----------
    axes : array_like, shape (..., 3, 3)
        Rows i_x, i_y, i_z, unit vectors.

    Notes
    -----
    sigma1 = 1 - |i_x - i_y|/sqrt(2), and so on for (x, z) and (y, z). It equals half the cosine of
    the angle between the two axes to first order, and sees nothing but that angle.
    """
    axes = finite_array(axes, "axes", 3, 3)
    if not np.allclose(np.linalg.norm(axes, axis=-1), 1, rtol=0, atol=1e-9):
        raise ValueError("axes: expected rows of unit length, got rows of another length.")
    pairs = axes[..., [0, 0, 1], :] - axes[..., [1, 2, 2], :]
    return 1 - np.linalg.norm(pairs, axis=-1) / np.sqrt(2)
