"""What the conventions share: inverses, biases behind a matrix, and what has no place."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.calibration.matrix_conventions.nominal_readings import SI_READINGS
from driftlab.checks import FloatArray, finite_array
from driftlab.core.vectors import transform
from driftlab.imu import ImuErrors, checked_imu_errors


def inverse(matrix: FloatArray, name: str) -> FloatArray:
    """Return the inverses of matrices, refusing singular ones by name.

    Parameters
    ----------
    matrix : ndarray, shape (..., 3, 3)
        Of finite numbers.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Examples
    --------
    >>> inverse(np.zeros((3, 3)), "gyro_T")
    Traceback (most recent call last):
        ...
    ValueError: gyro_T: expected a matrix with an inverse, got a singular one.
    """
    if not (np.linalg.cond(matrix) < 1e12).all():
        raise ValueError(f"{name}: expected a matrix with an inverse, got a singular one.")
    inverted: FloatArray = np.linalg.inv(matrix)  # NumPy's own type is wider
    return inverted


def refuse_unless_zero(**effects: ArrayLike) -> None:
    """Refuse what a matrix and a bias for each triad cannot say.

    Parameters
    ----------
    **effects : array_like
        By name; all zero if the program knows nothing of them.

    Returns
    -------
    None

    Examples
    --------
    >>> refuse_unless_zero(gyroscopes_A=np.zeros((3, 3)), rx_i=[0.0, 0.02, 0.0])
    Traceback (most recent call last):
        ...
    ValueError: rx_i: expected zeros, because ImuErrors has no place for it, got up to 0.02; take
    its effect out of the readings first, or give zeros and live with it.
    """
    for name, effect in effects.items():
        size = np.abs(finite_array(effect, name)).max()
        if size > 0:
            raise ValueError(
                f"{name}: expected zeros, because ImuErrors has no place for it, got up to "
                f"{size:.3g}; take its effect out of the readings first, or give zeros and live "
                "with it."
            )


def bias_behind_matrix(**triads: ArrayLike) -> ImuErrors:
    """Errors of a unit whose true values are a matrix times what is measured, less a bias.

    Parameters
    ----------
    **triads : array_like, shapes (..., 3, 3), (..., 3), (..., 3, 3), (..., 3)
        Matrix and bias of the gyros, then of the accelerometers, by their names.

    Returns
    -------
    ImuErrors
        With the biases of the sensors.

    Examples
    --------
    >>> half = bias_behind_matrix(Kg=0.5 * np.eye(3), eb=np.ones(3), Ka=np.eye(3), db=np.zeros(3))
    >>> half.gyro_bias
    array([2., 2., 2.])
    """
    forward: list[FloatArray] = []
    names = list(triads)
    for matrix, bias in (names[:2], names[2:]):
        triad = inverse(finite_array(triads[matrix], matrix, 3, 3), matrix)
        forward += [triad, transform(triad, finite_array(triads[bias], bias, 3))]
    return SI_READINGS.imu_errors(*forward)


def matrix_before_bias(
    imu_errors: ImuErrors,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Matrices and biases such that true is a matrix times what is measured, less a bias.

    Parameters
    ----------
    imu_errors : ImuErrors
        Errors of a unit (...).

    Returns
    -------
    gyro_matrix, gyro_bias, accelerometer_matrix, accelerometer_bias : ndarray
        Shapes (..., 3, 3) and (..., 3); `bias_behind_matrix` is the way back.

    Examples
    --------
    >>> from driftlab.imu import NO_ERRORS
    >>> errors = NO_ERRORS._replace(gyro_error=np.eye(3), gyro_bias=np.ones(3))
    >>> matrix_before_bias(errors)[1]
    array([0.5, 0.5, 0.5])
    """
    gyro, gyro_bias, accelerometer, bias = SI_READINGS.triads(checked_imu_errors(imu_errors))
    gyro = inverse(gyro, "gyro_error")
    accelerometer = inverse(accelerometer, "accelerometer_error")
    return gyro, transform(gyro, gyro_bias), accelerometer, transform(accelerometer, bias)
