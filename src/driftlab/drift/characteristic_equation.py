"""Characteristic equation of the error-rate matrix, and its roots; Larin, section 2."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    ComplexArray,
    FloatArray,
    chosen_number,
    finite_arrays,
    nonzero_vectors,
    plausible_error_matrix,
    truth_value,
)
from driftlab.core.quaternion import left_matrix, pure, right_matrix
from driftlab.core.vectors import norms

from .systematic_drift import _along_and_across


def characteristic_polynomial(
    rate: ArrayLike, measured_rate: ArrayLike, *, as_copied: bool = False
) -> FloatArray:
    r"""Coefficients of the characteristic polynomial det(sE - Omega_e); Larin (2.1), corrected.

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s.
    as_copied : bool
        Use the coefficient of s^2 in the copy of the paper, 4 w^T w + 4 w^T eps + eps^T eps with
        the error eps of the measured rate. It lacks one eps^T eps.

    Returns
    -------
    ndarray, shape (..., 5)
        Coefficients, highest power first, in powers of rad/s.

    See Also
    --------
    exact_roots : Its roots.

    Notes
    -----
    With the true rate w and the measured rate w_hat the polynomial is

    .. math:: s^4 + 2(|w|^2 + |\hat w|^2) s^2 + (|\hat w|^2 - |w|^2)^2.

    Examples
    --------
    >>> characteristic_polynomial([0, 0, 1], [0, 0, 3])
    array([ 1.,  0., 20.,  0., 64.])
    >>> characteristic_polynomial([0, 0, 1], [0, 0, 3], as_copied=True)
    array([ 1.,  0., 16.,  0., 64.])
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    error = measured_rate - rate
    rate_squared, along, error_squared = (
        np.einsum("...i,...i->...", a, b) for a, b in ((rate, rate), (rate, error), (error, error))
    )
    factor = 1 if truth_value(as_copied, "as_copied") else 2
    quadratic = 4 * rate_squared + 4 * along + factor * error_squared
    constant = (2 * along + error_squared) ** 2
    zero = np.zeros_like(quadratic)
    return np.stack([zero + 1, zero, quadratic, zero, constant], axis=-1)


def exact_roots(rate: ArrayLike, measured_rate: ArrayLike) -> ComplexArray:
    r"""Exact roots of the characteristic equation: the four eigenvalues of Omega_e.

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s.

    Returns
    -------
    ndarray of complex, shape (..., 4)
        Purely imaginary, rad/s, in the order given under Notes.

    See Also
    --------
    asymptotic_roots : For a small error matrix.

    Notes
    -----
    The roots of Larin (2.1) are the sum and the difference of the two lengths, because Omega_e
    consists of two commuting parts:

    .. math:: \pm i(|\hat w| + |w|), \quad \pm i(|\hat w| - |w|).

    Examples
    --------
    >>> exact_roots([0, 0, 1], [0, 0, 3]).imag
    array([ 4., -4., 2., -2.])
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    total = norms(measured_rate) + norms(rate)
    # |w_hat| - |w| without the loss of digits that the subtraction would bring.
    middle = (measured_rate + rate) / np.where(total == 0, 1.0, total)[..., np.newaxis]
    difference = np.einsum("...i,...i->...", middle, measured_rate - rate)
    return 1j * np.stack([total, -total, difference, -difference], axis=-1)


def asymptotic_roots(rate: ArrayLike, error_matrix: ArrayLike, *, order: int = 1) -> ComplexArray:
    r"""Roots of the characteristic equation for a small error matrix; Larin (2.2).

    Parameters
    ----------
    rate : array_like, shape (..., 3)
        True angular rate in body axes, rad/s, not zero.
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of the errors of the triad, mu T in the paper, which measures (I + M) rate.
    order : {1, 2}
        Highest power of M that is kept. Larin's formula is the first order.

    Returns
    -------
    ndarray of complex, shape (..., 4)
        rad/s, in the order of `exact_roots`.

    See Also
    --------
    drift_per_revolution : What the small roots leave after a whole turn.

    Notes
    -----
    With n the direction of the rate and rho = n^T M n, the two pairs of first order are
    |w|(2 + rho) and |w| rho. The second order adds to both

    .. math:: |w| (|M n|^2 - \rho^2) / 2.

    The error of the first order is the same for both pairs. With r the length of the part of M n
    across n, :math:`|\hat w|/|w| = \sqrt{(1+\rho)^2 + r^2}`, and if :math:`1 + \rho > 0`,

    .. math::
        0 \le \frac{|\hat w|}{|w|} - 1 - \rho
        = \frac{r^2}{\sqrt{(1+\rho)^2 + r^2} + 1 + \rho}
        \le \frac{r^2}{2(1+\rho)} \le \frac{m^2}{2(1-m)},

    where m < 1 is the spectral norm of M: :math:`|\rho| \le m` and :math:`r \le m`. From the same
    fraction, as :math:`||\hat w|/|w| - 1| \le m`, the second order leaves at most
    :math:`r^2 m/(2(1-m))`.

    Examples
    --------
    Measured and true rate differ across the axis only, which shows in the second order:

    >>> error_matrix = np.array([[0, 0, 0.01], [0, 0, 0], [0, 0, 0]])
    >>> for order in (1, 2):
    ...     print(f"{asymptotic_roots([0, 0, 1], error_matrix, order=order)[2].imag:.3e}")
    0.000e+00
    5.000e-05
    """
    order = chosen_number(order, (1, 2), "order")
    rate, error_matrix = finite_arrays(rate=(rate, 3), error_matrix=(error_matrix, 3, 3))
    plausible_error_matrix(error_matrix, "error_matrix")
    direction, norm = nonzero_vectors(rate, "rate")
    coefficient, across = _along_and_across(direction, error_matrix)
    if order == 2:
        coefficient = coefficient + 0.5 * across
    fast, slow = norm * (2 + coefficient), norm * coefficient
    return 1j * np.stack([fast, -fast, slow, -slow], axis=-1)


def split_error_rate_matrix(
    rate: ArrayLike, measured_rate: ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Split Omega_e into a periodic part and the systematic drift; Larin, between (2.2) and (2.3).

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s, not zero.

    Returns
    -------
    periodic, systematic : ndarray, shape (..., 4, 4)
        V and W, rad/s: V + W = Omega_e and VW = WV.

    Notes
    -----
    The exponential of V t/2 is the unit matrix after each whole turn, t = 2 pi j/|w|. Larin gives V
    and W to first order. In this form they hold exactly: W is right multiplication by the part
    (|w_hat| - |w|)/|w_hat| of the measured rate.

    Examples
    --------
    >>> from scipy.linalg import expm
    >>> from driftlab.drift.error_kinematics import error_rate_matrix
    >>> rate, measured_rate = [0.0, 0.0, 1.0], [0.01, 0.0, 1.02]
    >>> periodic, systematic = split_error_rate_matrix(rate, measured_rate)
    >>> np.allclose(periodic + systematic, error_rate_matrix(rate, measured_rate))
    True
    >>> np.allclose(expm(periodic * np.pi), np.eye(4))  # after one turn
    True
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    n, norm = nonzero_vectors(rate, "rate")
    n_hat, _ = nonzero_vectors(measured_rate, "measured_rate")
    drift_rate = exact_roots(rate, measured_rate)[..., 2].imag
    turning = right_matrix(pure(norm[..., np.newaxis] * n_hat))
    periodic = turning - left_matrix(pure(norm[..., np.newaxis] * n))
    return periodic, right_matrix(pure(drift_rate[..., np.newaxis] * n_hat))
