"""Larin, section 2: the characteristic equation of the error matrix, and its roots."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import ComplexArray, FloatArray, finite_arrays, nonzero_vectors
from driftlab.core.quaternion import left_matrix, pure, right_matrix
from driftlab.core.vectors import norms

from .systematic_drift import _along_and_across


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
    total = norms(measured_rate) + norms(rate)
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
