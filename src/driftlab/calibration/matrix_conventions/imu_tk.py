"""Calibration matrices of IMU-TK, to and from `ImuErrors`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from driftlab.calibration.matrix_conventions.forms import inverse
from driftlab.calibration.matrix_conventions.nominal_readings import SI_READINGS, NominalReadings
from driftlab.checks import finite_array
from driftlab.imu import ImuErrors, checked_imu_errors


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
    Kyle-ak/imu_tk at 7780270, ``include/imu_tk/calibration.h``: `unbiasNormalize`. The
    accelerometers fix its body axes, T being zero below the diagonal: z lies along the z
    accelerometer, y in the plane of y and z (`MultiPosAccResidual`, ``src/calibration.cpp``).
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
        return self.readings.imu_errors(
            inverse(gyro, "gyro_T"),
            finite_array(self.gyro_b, "gyro_b", 3),
            inverse(acc, "acc_T"),
            finite_array(self.acc_b, "acc_b", 3),
        )

    @classmethod
    def from_imu_errors(
        cls, imu_errors: ImuErrors, readings: NominalReadings = SI_READINGS
    ) -> Self:
        """IMU-TK's matrices of a unit, in the body axes that it has."""
        gyro, gyro_b, acc, acc_b = readings.triads(checked_imu_errors(imu_errors))
        gyro, acc = inverse(gyro, "gyro_error"), inverse(acc, "accelerometer_error")
        gyro_K, acc_K = gyro * np.eye(3), acc * np.eye(3)
        gyro_T, acc_T = gyro @ np.linalg.inv(gyro_K), acc @ np.linalg.inv(acc_K)
        return cls(acc_T, acc_K, acc_b, gyro_T, gyro_K, gyro_b, readings)
