"""Larin, section 1: how true and measured rates become an attitude and an attitude error.

The true attitude obeys lambda' = lambda∘omega/2; the computer integrates the same equation with
the measured rate. The error conj(lambda)∘lambda_star then obeys lambda_e' = Omega_e lambda_e / 2,
and Omega_e is *right* multiplication by the measured rate minus *left* multiplication by the true
one. The two halves commute, whatever the rates. For constant rates this gives every solution in
closed form.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_arrays
from driftlab.core.quaternion import (
    conjugate,
    from_rotation_vector,
    left_matrix,
    multiply,
    pure,
    right_matrix,
)
from driftlab.core.vectors import norms


def rate_matrix(rate: ArrayLike) -> FloatArray:
    """Omega (..., 4, 4) of the kinematic equation lambda' = Omega lambda / 2; Larin (1.1).

    Parameters
    ----------
    rate : array_like, shape (..., 3)
        Angular rate in body axes, rad/s.
    """
    return right_matrix(pure(finite_array(rate, "rate", 3)))


def error_composition_matrix(attitude: ArrayLike) -> FloatArray:
    """Lambda (..., 4, 4) that turns the apparent attitude into the error quaternion; Larin (1.3).

    ``error_composition_matrix(attitude) @ apparent`` is ``conj(attitude)∘apparent``, the rotation
    from the body frame R to the frame B that the computer believes in.
    """
    return left_matrix(conjugate(finite_array(attitude, "attitude", 4)))


def error_rate_matrix(rate: ArrayLike, measured_rate: ArrayLike) -> FloatArray:
    """Omega_e (..., 4, 4) of the error equation lambda_e' = Omega_e lambda_e / 2; Larin (1.4).

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s.
    """
    rate, measured_rate = finite_arrays(rate=(rate, 3), measured_rate=(measured_rate, 3))
    return right_matrix(pure(measured_rate)) - left_matrix(pure(rate))


def attitude_quaternion(rate: ArrayLike, time: ArrayLike) -> FloatArray:
    """Attitude (..., 4) at `time` (...) in s under a constant `rate` (..., 3), from [0, 0, 0, 1].

    The exact solution of Larin (1.1), or of (1.2) when given the measured rate.
    """
    rate, time = finite_arrays(rate=(rate, 3), time=(time,))
    return from_rotation_vector(rate * time[..., np.newaxis])


def error_quaternion(rate: ArrayLike, measured_rate: ArrayLike, time: ArrayLike) -> FloatArray:
    """Exact error quaternion for constant rates: the solution of Larin (1.4) from [0, 0, 0, 1].

    Parameters
    ----------
    rate, measured_rate : array_like, shape (..., 3)
        True and measured angular rate in body axes, rad/s.
    time : array_like, shape (...)
        Times in s; broadcasts against the leading axes of the rates.

    Returns
    -------
    ndarray, shape (..., 4)

    Notes
    -----
    With n and m the unit vectors of the two rates, the solution is (cos a - n sin a)∘(cos b + m sin
    b), a and b half the two angles turned. Multiplied out, four products of a sine and a cosine
    weigh four constant quaternions, so a long row of times costs one small matrix product.
    """
    rate, measured_rate, time = finite_arrays(
        rate=(rate, 3), measured_rate=(measured_rate, 3), time=(time,)
    )
    cosine_true, sine_true, n = _half_turn(rate, time)
    cosine_measured, sine_measured, m = _half_turn(measured_rate, time)
    weights = np.stack(
        [
            cosine_true * cosine_measured,
            cosine_true * sine_measured,
            -sine_true * cosine_measured,
            -sine_true * sine_measured,
        ],
        axis=-1,
    )
    n, m = pure(n), pure(m)
    one = np.broadcast_to(np.array([0.0, 0.0, 0.0, 1.0]), np.broadcast_shapes(n.shape, m.shape))
    constants = np.stack(np.broadcast_arrays(one, m, n, multiply(n, m)), axis=-2)
    if constants.ndim == 2:
        return weights @ constants
    return np.einsum("...i,...ij->...j", weights, constants)


def _half_turn(rate: FloatArray, time: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Cosine and sine of half the angle turned, and the unit axis (zero where the rate is zero)."""
    norm = norms(rate)
    axis = rate / np.where(norm == 0, 1.0, norm)[..., np.newaxis]
    return np.cos(0.5 * norm * time), np.sin(0.5 * norm * time), axis


def error_transition_matrix(
    rate: ArrayLike, measured_rate: ArrayLike, time: ArrayLike
) -> FloatArray:
    """exp(Omega_e t / 2), shape (..., 4, 4): carries any initial error over `time` (...) in s.

    The exponential of two commuting halves is the product of two quaternion multiplications, one
    from each side; no series and no squaring. Larin, between (2.2) and (2.3).
    """
    rate, measured_rate, time = finite_arrays(
        rate=(rate, 3), measured_rate=(measured_rate, 3), time=(time,)
    )
    left = conjugate(attitude_quaternion(rate, time))
    right = attitude_quaternion(measured_rate, time)
    weights = left[..., :, np.newaxis] * right[..., np.newaxis, :]
    return (weights.reshape(*weights.shape[:-2], 16) @ _TWO_SIDED).reshape(weights.shape)


# Sixteen matrices, flattened: multiplication by one unit from the left and one from the right.
_TWO_SIDED = (left_matrix(np.eye(4))[:, np.newaxis] @ right_matrix(np.eye(4))).reshape(16, 16)
