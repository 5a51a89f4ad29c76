"""Error kinematics: from true and measured rates to attitude and attitude error; Larin, section 1.

The true attitude obeys lambda' = lambda∘omega/2; the computer integrates the same equation with
the measured rate. The error conj(lambda)∘lambda_star then obeys lambda_e' = Omega_e lambda_e / 2,
and Omega_e is *right* multiplication by the measured rate minus *left* multiplication by the true
one. The two parts commute, whatever the rates. For constant rates this gives every solution in
closed form.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_arrays
from driftlab.core.quaternion import conjugate, left_matrix, multiply, pure, right_matrix
from driftlab.core.vectors import norms


def rate_matrix(rate: ArrayLike) -> FloatArray:
    """Matrix Omega of the kinematic equation lambda' = Omega lambda / 2; Larin (1.1).

    Parameters
    ----------
    rate : array_like, shape (..., 3)
        Angular rate in body axes, rad/s.

    Returns
    -------
    ndarray, shape (..., 4, 4)
        Omega, skew-symmetric, rad/s.

    Examples
    --------
    >>> rate_matrix([0, 0, 2]) @ [0, 0, 0, 1] / 2  # derivative of the unit quaternion
    array([0., 0., 1., 0.])
    """
    return right_matrix(pure(finite_array(rate, "rate", 3)))


def error_composition_matrix(attitude: ArrayLike) -> FloatArray:
    """Matrix Lambda from the apparent attitude to the error quaternion; Larin (1.3).

    Parameters
    ----------
    attitude : array_like or Rotation, shape (..., 4)
        True attitude, unit quaternion, body to reference.

    Returns
    -------
    ndarray, shape (..., 4, 4)
        ``error_composition_matrix(attitude) @ apparent`` is ``conj(attitude)∘apparent``, the
        rotation from the body frame R to the frame B that the computer takes for it.

    Examples
    --------
    An apparent attitude without error gives the unit quaternion:

    >>> attitude = [0.6, 0.0, 0.0, 0.8]
    >>> (error_composition_matrix(attitude) @ attitude).round(9)
    array([0., 0., 0., 1.])
    """
    return left_matrix(conjugate(finite_array(attitude, "attitude", 4)))


def error_rate_matrix(rate: ArrayLike, measured_rate: ArrayLike) -> FloatArray:
    """Matrix Omega_e of the error equation lambda_e' = Omega_e lambda_e / 2; Larin (1.4).

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s.

    Returns
    -------
    ndarray, shape (..., 4, 4)
        Omega_e, skew-symmetric, rad/s.

    Examples
    --------
    From zero error, its vector part grows at half the error of the measured rate:

    >>> error_rate_matrix([0, 0, 1], [0, 0, 3]) @ [0, 0, 0, 1] / 2
    array([0., 0., 1., 0.])
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    return right_matrix(pure(measured_rate)) - left_matrix(pure(rate))


def error_quaternion(rate: ArrayLike, measured_rate: ArrayLike, time: ArrayLike) -> FloatArray:
    r"""Error quaternion for constant rates: the exact solution of Larin (1.4) from [0, 0, 0, 1].

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s. Of a triad whose errors are known,
        `driftlab.triad.measured_rate` gives the latter.
    time : array_like, shape (...)
        Times in s; broadcasts against the leading axes of the rates.

    Returns
    -------
    ndarray, shape (..., 4)
        Unit quaternions conj(lambda)∘lambda_star.

    See Also
    --------
    drift_per_revolution : The angle of it after a whole turn.

    Notes
    -----
    With n and n-hat the unit vectors of the two rates, and a and b half the two angles turned,

    .. math:: \lambda_e = (\cos a - n \sin a) \circ (\cos b + \hat n \sin b).

    Examples
    --------
    A scale-factor error of 0.1 % after one whole turn:

    >>> error = error_quaternion([0, 0, 1], [0, 0, 1.001], 2 * np.pi)
    >>> print(f"{error[2]:.6f} {np.sin(0.001 * np.pi):.6f}")
    0.003142 0.003142
    """
    rate, measured_rate, time = finite_arrays(
        rate=(rate, 3), measured_rate=(measured_rate, 3), time=(time,)
    )
    # Four products of a sine and a cosine multiply four constant quaternions, so a long row of
    # times costs one small matrix product.
    cosine_true, sine_true, n = _half_turn(rate, time)
    cosine_measured, sine_measured, n_hat = _half_turn(measured_rate, time)
    weights = np.stack(
        [
            cosine_true * cosine_measured,
            cosine_true * sine_measured,
            -sine_true * cosine_measured,
            -sine_true * sine_measured,
        ],
        axis=-1,
    )
    n, n_hat = pure(n), pure(n_hat)
    shape = np.broadcast_shapes(n.shape, n_hat.shape)
    one = np.broadcast_to(np.array([0.0, 0.0, 0.0, 1.0]), shape)
    constants = np.stack(np.broadcast_arrays(one, n_hat, n, multiply(n, n_hat)), axis=-2)
    if constants.ndim == 2:
        return weights @ constants
    return np.einsum("...i,...ij->...j", weights, constants)


def _half_turn(rate: FloatArray, time: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Cosine and sine of half the angle turned, and the unit axis (zero where the rate is zero)."""
    norm = norms(rate)
    axis = rate / np.where(norm == 0, 1.0, norm)[..., np.newaxis]
    return np.cos(0.5 * norm * time), np.sin(0.5 * norm * time), axis
