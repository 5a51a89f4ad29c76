"""Calibration matrices of kalibr, to and from `ImuErrors`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from driftlab.body_frames import body_frame_rotation
from driftlab.calibration.matrix_conventions.forms import refuse_unless_zero
from driftlab.calibration.matrix_conventions.nominal_readings import SI_READINGS
from driftlab.checks import finite_array
from driftlab.imu import ImuErrors, checked_imu_errors

_ROUNDING = 1e-12  # of an error matrix, which has no unit


@dataclass(frozen=True, eq=False)
class KalibrMatrices:
    """kalibr, scale-misalignment: ``f = M f + b``, ``w = M_g C_gyro_i w + A C_gyro_i f + b``.

    On the left stands what is measured: kalibr's matrices make errors, as ours do. Whoever
    multiplies his readings by M has each error twice.

    Attributes
    ----------
    accelerometers_M, gyroscopes_M : array_like, shape (..., 3, 3)
        Scale and non-orthogonality; zero above the diagonal.
    gyroscopes_C_gyro_i : array_like, shape (..., 3, 3)
        Rotation from the axes of the accelerometers to those of the gyros.
    gyroscopes_A : array_like, shape (..., 3, 3)
        What the gyros feel of specific force, (rad/s)/(m/s^2); refused if not zero.
    gyro_bias, accelerometer_bias : array_like, shape (..., 3)
        rad/s and m/s^2; not in its files, for kalibr's biases wander during the recording.
    rx_i, ry_i, rz_i : array_like, shape (..., 3)
        Places of the accelerometers in its model with size effect, m; refused if not zero.

    Notes
    -----
    ethz-asl/kalibr at 1f60227, ``IccSensors.py`` of ``kalibr_imu_camera_calibration``:
    `IccScaledMisalignedImu`. Asked for in its issues 189, 334, 436 and 603. The accelerometers fix
    its body axes (our "accelerometers"): x lies along the x accelerometer, y in the plane of x and
    y.

    Examples
    --------
    >>> lower = np.array([[0.99, 0, 0], [0.02, 1.01, 0], [0, 0, 1.0]])
    >>> kalibr = KalibrMatrices(lower, lower, np.eye(3))
    >>> float(kalibr.imu_errors.accelerometer_error[0, 0].round(3))  # reads one per cent too little
    -0.01
    """

    accelerometers_M: ArrayLike
    gyroscopes_M: ArrayLike
    gyroscopes_C_gyro_i: ArrayLike
    gyroscopes_A: ArrayLike = ((0.0,) * 3,) * 3
    gyro_bias: ArrayLike = (0.0,) * 3
    accelerometer_bias: ArrayLike = (0.0,) * 3
    rx_i: ArrayLike = (0.0,) * 3
    ry_i: ArrayLike = (0.0,) * 3
    rz_i: ArrayLike = (0.0,) * 3

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        refuse_unless_zero(
            gyroscopes_A=self.gyroscopes_A, rx_i=self.rx_i, ry_i=self.ry_i, rz_i=self.rz_i
        )
        turn = finite_array(self.gyroscopes_C_gyro_i, "gyroscopes_C_gyro_i", 3, 3)
        if not np.allclose(turn @ np.swapaxes(turn, -1, -2), np.eye(3), rtol=0, atol=1e-6):
            raise ValueError("gyroscopes_C_gyro_i: expected a rotation matrix, got another one.")
        return SI_READINGS.imu_errors(
            finite_array(self.gyroscopes_M, "gyroscopes_M", 3, 3) @ turn,
            finite_array(self.gyro_bias, "gyro_bias", 3),
            finite_array(self.accelerometers_M, "accelerometers_M", 3, 3),
            finite_array(self.accelerometer_bias, "accelerometer_bias", 3),
        )

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """kalibr's matrices of a unit that has kalibr's body axes."""
        errors = checked_imu_errors(imu_errors)
        above = np.abs(np.triu(errors.accelerometer_error, 1)).max()
        if above > _ROUNDING:
            raise ValueError(
                "accelerometer_error: expected zeros above the diagonal, as kalibr's body axes "
                f"have it, got up to {above:.3g}; change them by imu_errors_in_accelerometer_axes."
            )
        turn = body_frame_rotation(errors.gyro_error, frame="upper triangle")
        return cls(
            np.eye(3) + errors.accelerometer_error,
            np.tril((np.eye(3) + errors.gyro_error) @ np.swapaxes(turn, -1, -2)),
            turn,
            gyro_bias=errors.gyro_bias,
            accelerometer_bias=errors.accelerometer_bias,
        )
