"""Calibration matrices of PSINS, ROS and RealSense, to and from `ImuErrors`.

Their biases stand behind the matrix that takes the errors out, ``true = K measured - b``, so they
are not the sensors' but along the body axes; see `driftlab.calibration.matrix_conventions`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from numpy.typing import ArrayLike

from driftlab.calibration.nominal_readings import (
    SI_READINGS,
    checked_inverse,
    checked_zeros,
)
from driftlab.checks import FloatArray, finite_array
from driftlab.core.vectors import transform
from driftlab.imu import ImuErrors, checked_imu_errors


@dataclass(frozen=True, eq=False)
class PsinsMatrices:
    """PSINS: ``true = Kg measured - eb`` and ``true = Ka measured - db``, in SI units.

    Attributes
    ----------
    Kg, Ka : array_like, shape (..., 3, 3)
        Calibration matrices, after ``sf`` has made SI units of the pulses.
    eb, db : array_like, shape (..., 3)
        Biases *behind* the matrix, rad/s and m/s^2; its files have degrees per hour and micro-g.
    Ka2, Kap, rx, ry, rz, tGA, gSens : array_like
        Squares and signs of the accelerometers, their places, the delay between the triads, what
        the gyros feel of specific force; refused if not zero.

    Notes
    -----
    WangShanpeng/PSINS at c1706f1, ``base/imu/imuclbt.m``, ``clbtfile.m``. Its simulation
    ``imuadderr.m`` is ours with dKg = K, so Kg is near I - dKg. The accelerometers fix the body
    axes of ``base/kf/sysclbt.m``: Ka is zero above the diagonal (our "accelerometers").

    Examples
    --------
    >>> import numpy as np
    >>> psins = PsinsMatrices(0.5 * np.eye(3), np.ones(3), np.eye(3), np.zeros(3))
    >>> psins.imu_errors.gyro_bias  # two at the sensor are one behind the matrix
    array([2., 2., 2.])
    """

    Kg: ArrayLike
    eb: ArrayLike
    Ka: ArrayLike
    db: ArrayLike
    Ka2: ArrayLike = 0.0
    Kap: ArrayLike = 0.0
    rx: ArrayLike = 0.0
    ry: ArrayLike = 0.0
    rz: ArrayLike = 0.0
    tGA: ArrayLike = 0.0
    gSens: ArrayLike = 0.0

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        checked_zeros(
            Ka2=self.Ka2,
            Kap=self.Kap,
            rx=self.rx,
            ry=self.ry,
            rz=self.rz,
            tGA=self.tGA,
            gSens=self.gSens,
        )
        return _bias_behind_matrix(Kg=self.Kg, eb=self.eb, Ka=self.Ka, db=self.db)

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """PSINS' matrices of a unit, in the body axes that it has."""
        return cls(*_matrix_before_bias(imu_errors))


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
    >>> import numpy as np
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
        return _bias_behind_matrix(
            gyro_SM=self.gyro_SM, gyro_bias=self.gyro_bias, SM=self.SM, bias=self.bias
        )

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """Both matrices of a unit; imu_calib itself can use them if `gyro_SM` is the unit one."""
        gyro_SM, gyro_bias, SM, bias = _matrix_before_bias(imu_errors)
        return cls(SM, bias, gyro_bias, gyro_SM)


def _bias_behind_matrix(**triads: ArrayLike) -> ImuErrors:
    """Errors of a unit whose true values are a matrix times what is measured, less a bias."""
    forward: list[FloatArray] = []
    names = list(triads)
    for matrix, bias in (names[:2], names[2:]):
        triad = checked_inverse(finite_array(triads[matrix], matrix, 3, 3), matrix)
        forward += [triad, transform(triad, finite_array(triads[bias], bias, 3))]
    return SI_READINGS.imu_errors(*forward)


def _matrix_before_bias(
    imu_errors: ImuErrors,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Matrices and biases such that true is a matrix times what is measured, less a bias."""
    gyro, gyro_bias, accelerometer, bias = SI_READINGS.triads(checked_imu_errors(imu_errors))
    gyro = checked_inverse(gyro, "gyro_error")
    accelerometer = checked_inverse(accelerometer, "accelerometer_error")
    return gyro, transform(gyro, gyro_bias), accelerometer, transform(accelerometer, bias)
