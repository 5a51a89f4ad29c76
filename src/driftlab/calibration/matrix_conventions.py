"""Calibration matrices of IMU-TK, kalibr and imucal, to and from `ImuErrors`.

Here ``measured = (I + K) true + bias``: the matrix makes errors, and the bias is the sensors'.
Most programs write the matrix that takes the errors out, its inverse. A bias is subtracted either
before their matrix, and is then ours, or behind it, and is then one of the body axes:
`driftlab.calibration.biases_behind_matrix`.

What a program knows beyond a matrix and a bias for each triad, such as gyros that feel acceleration
or accelerometers that sit apart, is refused if it is not zero, not dropped.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree

from driftlab.body_frames import body_frame_rotation
from driftlab.calibration.nominal_readings import (
    SI_READINGS,
    NominalReadings,
    checked_inverse,
    checked_zeros,
)
from driftlab.checks import checked_instance, finite_array
from driftlab.imu import ImuErrors, checked_imu_errors

_ROUNDING = 1e-12  # of an error matrix, which has no unit


@dataclass(frozen=True, eq=False)
class ImuTkMatrices:
    """IMU-TK: ``true = T K (reading - b)``, in SI units.

    Attributes
    ----------
    acc_T, acc_K, acc_b, gyro_T, gyro_K, gyro_b : array_like, shapes (..., 3, 3) and (..., 3)
        Misalignment with ones on its diagonal and with the signs it is written with, scale (a
        diagonal matrix), and bias in readings.
    readings : NominalReadings
        What its readings are; the biases and errors of `imu_errors` are relative to it.

    Notes
    -----
    Kyle-ak/imu_tk at 7780270, ``include/imu_tk/calibration.h``: ``unbiasNormalize``. The
    accelerometers fix its body axes, T being zero below the diagonal: z lies along the z
    accelerometer, y in the plane of y and z (``MultiPosAccResidual``, ``src/calibration.cpp``).
    Others changed that to zero above; see `imu_errors_in_accelerometer_axes`. The gyros' b is their
    mean over the first rest, so the Earth's rotation is in it.

    Fusion of x-io Technologies has the same formula, ``M s (u - b)`` with the sensitivities s
    (xioTechnologies/Fusion at d69784c, ``Fusion/FusionModel.h``), in degrees per second and g:
    give it as K = s times pi/180 and times 9.80665.

    Examples
    --------
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> matrices = ImuTkMatrices.from_imu_errors(TYPICAL_ERRORS)
    >>> float(matrices.gyro_K[0, 0].round(7))  # the x gyro reads 10 ppm too much
    0.99999
    >>> np.allclose(matrices.imu_errors.gyro_error, TYPICAL_ERRORS.gyro_error, atol=1e-15)
    True
    """

    acc_T: ArrayLike
    acc_K: ArrayLike
    acc_b: ArrayLike
    gyro_T: ArrayLike
    gyro_K: ArrayLike
    gyro_b: ArrayLike
    readings: NominalReadings = SI_READINGS

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        acc = finite_array(self.acc_T, "acc_T", 3, 3) @ finite_array(self.acc_K, "acc_K", 3, 3)
        gyro = finite_array(self.gyro_T, "gyro_T", 3, 3) @ finite_array(self.gyro_K, "gyro_K", 3, 3)
        return checked_instance(self.readings, NominalReadings, "readings").imu_errors(
            checked_inverse(gyro, "gyro_T"),
            finite_array(self.gyro_b, "gyro_b", 3),
            checked_inverse(acc, "acc_T"),
            finite_array(self.acc_b, "acc_b", 3),
        )

    @classmethod
    def from_imu_errors(
        cls, imu_errors: ImuErrors, readings: NominalReadings = SI_READINGS
    ) -> Self:
        """IMU-TK's matrices of a unit, in the body axes that it has."""
        gyro, gyro_b, acc, acc_b = checked_instance(readings, NominalReadings, "readings").triads(
            imu_errors
        )
        gyro, acc = checked_inverse(gyro, "gyro_error"), checked_inverse(acc, "accelerometer_error")
        gyro_K, acc_K = gyro * np.eye(3), acc * np.eye(3)
        gyro_T, acc_T = gyro @ np.linalg.inv(gyro_K), acc @ np.linalg.inv(acc_K)
        return cls(acc_T, acc_K, acc_b, gyro_T, gyro_K, gyro_b, readings)


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
    ``IccScaledMisalignedImu``. Asked for in its issues 189, 334, 436 and 603. The accelerometers
    fix its body axes (our "accelerometers"): x lies along the x accelerometer, y in the plane of x
    and y.

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
        checked_zeros(
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


@dataclass(frozen=True, eq=False)
class ImucalMatrices:
    """imucal, after Ferraris: ``reading = K R true + b``, the true rate in degrees per second.

    Attributes
    ----------
    K_a, R_a, b_a, K_g, R_g, b_g : array_like, shapes (..., 3, 3) and (..., 3)
        Scale (a diagonal matrix), rows of unit length, and bias in readings. K_g is in readings
        per degree per second, K_a in readings per m/s^2.
    K_ga : array_like, shape (..., 3, 3)
        What the gyros feel of specific force, in readings per m/s^2; refused if not zero.
    readings : NominalReadings
        What its readings are; SI unless told, for degrees per second say
        ``NominalReadings(gyro_scale=degree)``.

    Notes
    -----
    mad-lab-fau/imucal at 8716e4c, ``imucal/ferraris_calibration_info.py``: `calibrate`, which
    applies the inverse. Its body axes are those of the hands: along the six rests for the
    accelerometers, along the three turns for the gyros.

    Examples
    --------
    >>> readings = NominalReadings(gyro_scale=degree)
    >>> ferraris = ImucalMatrices(np.eye(3), np.eye(3), np.zeros(3),
    ...                           1.03 * np.eye(3), np.eye(3), np.zeros(3), readings=readings)
    >>> float(ferraris.imu_errors.gyro_error[0, 0].round(3))
    0.03
    """

    K_a: ArrayLike
    R_a: ArrayLike
    b_a: ArrayLike
    K_g: ArrayLike
    R_g: ArrayLike
    b_g: ArrayLike
    K_ga: ArrayLike = ((0.0,) * 3,) * 3
    readings: NominalReadings = SI_READINGS

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        checked_zeros(K_ga=self.K_ga)
        return checked_instance(self.readings, NominalReadings, "readings").imu_errors(
            finite_array(self.K_g, "K_g", 3, 3) @ finite_array(self.R_g, "R_g", 3, 3) / degree,
            finite_array(self.b_g, "b_g", 3),
            finite_array(self.K_a, "K_a", 3, 3) @ finite_array(self.R_a, "R_a", 3, 3),
            finite_array(self.b_a, "b_a", 3),
        )

    @classmethod
    def from_imu_errors(
        cls, imu_errors: ImuErrors, readings: NominalReadings = SI_READINGS
    ) -> Self:
        """Imucal's matrices of a unit, in the body axes that it has."""
        gyro, b_g, acc, b_a = checked_instance(readings, NominalReadings, "readings").triads(
            imu_errors
        )
        gyro = gyro * degree
        K_g, K_a = (np.linalg.norm(m, axis=-1)[..., np.newaxis] * np.eye(3) for m in (gyro, acc))
        R_g, R_a = np.linalg.inv(K_g) @ gyro, np.linalg.inv(K_a) @ acc
        return cls(K_a, R_a, b_a, K_g, R_g, b_g, readings=readings)
