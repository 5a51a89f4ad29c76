"""Calibration matrices of imu_calib for ROS, and of RealSense, to and from `ImuErrors`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from numpy.typing import ArrayLike

from driftlab.calibration.matrix_conventions.forms import bias_behind_matrix, matrix_before_bias
from driftlab.imu import ImuErrors


@dataclass(frozen=True, eq=False)
class RosMatrices:
    """imu_calib of ROS: ``true = SM measured - bias``, and gyros that lose their bias only.

    Attributes
    ----------
    SM : array_like, shape (..., 3, 3)
        Of the accelerometers; its file has the nine numbers row by row.
    bias : array_like, shape (..., 3)
        Of the accelerometers behind the matrix, m/s^2.
    gyro_bias : array_like, shape (..., 3)
        Behind the gyros' matrix, rad/s.
    gyro_SM : array_like, shape (..., 3, 3)
        Of the gyros: imu_calib has none, which is the unit matrix.

    Notes
    -----
    dpkoch/imu_calib at 59f5d17, ``src/accel_calib/accel_calib.cpp`` and ``src/apply_calib.cpp``.
    Its body axes are those of the six rests. A driver itself should publish what the device says,
    in m/s^2 (+g upward at rest) and rad/s: REP 145, ros-infrastructure/rep, ``rep-0145.rst``.

    RealSense corrects both triads by the same formula (librealsense at cacc8e7,
    ``src/proc/motion-transform.cpp``). In the ``calibration.json`` of its tool
    ``rs-imu-calibration.py`` the nine numbers stand column by column:
    ``SM = np.reshape(nine, (3, 3)).T``.

    Examples
    --------
    >>> ros = RosMatrices(np.diag([1.25, 1, 1]), [0.25, 0, 0], np.zeros(3))
    >>> float(ros.imu_errors.accelerometer_bias[0])
    0.2
    """

    SM: ArrayLike
    bias: ArrayLike
    gyro_bias: ArrayLike
    gyro_SM: ArrayLike = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        return bias_behind_matrix(
            gyro_SM=self.gyro_SM, gyro_bias=self.gyro_bias, SM=self.SM, bias=self.bias
        )

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """Both matrices of a unit; imu_calib itself can use them if `gyro_SM` is the unit one."""
        gyro_SM, gyro_bias, SM, bias = matrix_before_bias(imu_errors)
        return cls(SM, bias, gyro_bias, gyro_SM)
