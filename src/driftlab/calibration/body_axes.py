"""Attitudes and sensor errors in the body axes of a choice, and the error of an attitude."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from driftlab.body_frames import BODY_FRAMES, body_frame_rotation, change_body_frame
from driftlab.checks import FloatArray, finite_arrays, one_of, unit_quaternions
from driftlab.core.quaternion import conjugate, multiply, to_rotation_vector
from driftlab.imu import ImuErrors, checked_imu_errors

POSE_AXES = (*BODY_FRAMES, "lower triangle accelerometers")
"""Choices of body axes: those of `driftlab.body_frames`, and one more.

``accelerometers`` has axis x along the x accelerometer, and L is zero above its diagonal: one of
the two triangles in which IMU-TK's matrices are in circulation. ``lower triangle accelerometers``
has axis z along the z accelerometer, and L is zero below: the other, IMU-TK's own.
"""


def attitude_of_axes(attitude: ArrayLike, rotation: FloatArray) -> FloatArray:
    """Attitude of rotated body axes.

    Parameters
    ----------
    attitude : array_like or Rotation, shape (..., 4)
        Of the given body axes, body to reference; brought to unit norm.
    rotation : ndarray, shape (..., 3, 3)
        Rotation matrix from components in the given axes to components in the rotated ones.

    Returns
    -------
    ndarray, shape (..., 4)
        Rotated body axes to reference.

    Examples
    --------
    >>> swap = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    >>> attitude_of_axes([0, 0, 0, 1], swap).round(6)
    array([0.5, 0.5, 0.5, 0.5])
    """
    back = np.array(np.swapaxes(rotation, -1, -2))  # a copy: SciPy 1.14 takes no read-only array
    turned = Rotation.from_matrix(back.reshape(-1, 3, 3)).as_quat().reshape(*back.shape[:-2], 4)
    return multiply(unit_quaternions(attitude, "attitude"), turned)


def attitude_error(computed: ArrayLike, true: ArrayLike) -> FloatArray:
    """Error phi of a computed attitude: the computed axes are (I - [phi×]) C.

    Parameters
    ----------
    computed, true : array_like or Rotation, shape (..., 4)
        Unit quaternions, body to East, North, Up.

    Returns
    -------
    ndarray, shape (..., 3)
        rad about East, North, Up.

    Examples
    --------
    >>> attitude_error([0, 0, -0.5e-3, 1], [0, 0, 0, 1]).round(6)
    array([-0.   , -0.   ,  0.001])
    """
    computed, true = finite_arrays(
        computed=(unit_quaternions(computed, "computed"), 4),
        true=(unit_quaternions(true, "true"), 4),
    )
    return -to_rotation_vector(multiply(computed, conjugate(true)))


def imu_errors_in_frame(imu_errors: ImuErrors, frame: str | None) -> tuple[ImuErrors, FloatArray]:
    """Sensor errors in the axes of a frame, as a filter for it should find them, and the rotation.

    Parameters
    ----------
    imu_errors : ImuErrors
        Sensor errors (...) in given body axes.
    frame : str or None
        One of `POSE_AXES`, or None to keep the axes.

    Returns
    -------
    imu_errors : ImuErrors
        Sensor errors (...) in the axes of the frame.
    turn : ndarray, shape (..., 3, 3)
        Rotation matrix from components in the given axes to components in those of the frame.

    Raises
    ------
    ValueError
        If the frame is unknown, or a triad is left-handed or flat.

    Examples
    --------
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> turned, _ = imu_errors_in_frame(TYPICAL_ERRORS, "averaged")
    >>> bool(np.allclose(turned.gyro_error_matrix, turned.gyro_error_matrix.T, atol=1e-15))
    True
    """
    errors = checked_imu_errors(imu_errors)
    if frame is None:
        own = ImuErrors(*(array.copy() for array in errors))
        return own, np.broadcast_to(np.eye(3), errors.gyro_error_matrix.shape).copy()
    if one_of(frame, POSE_AXES, "frame") == POSE_AXES[-1]:
        turn = body_frame_rotation(errors.accelerometer_error_matrix, frame="lower triangle")
    else:
        turn = body_frame_rotation(
            errors.gyro_error_matrix, errors.accelerometer_error_matrix, frame
        )
    turned = ImuErrors(
        errors.gyro_bias.copy(),
        change_body_frame(errors.gyro_error_matrix, turn),
        errors.accelerometer_bias.copy(),
        change_body_frame(errors.accelerometer_error_matrix, turn),
    )
    return turned, turn
