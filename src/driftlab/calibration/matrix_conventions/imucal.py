"""Calibration matrices of imucal, to and from `ImuErrors`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree

from driftlab.calibration.matrix_conventions.forms import refuse_unless_zero
from driftlab.calibration.matrix_conventions.nominal_readings import SI_READINGS, NominalReadings
from driftlab.checks import finite_array
from driftlab.imu import ImuErrors, checked_imu_errors


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
        refuse_unless_zero(K_ga=self.K_ga)
        return self.readings.imu_errors(
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
        gyro, b_g, acc, b_a = readings.triads(checked_imu_errors(imu_errors))
        gyro = gyro * degree
        K_g, K_a = (np.linalg.norm(m, axis=-1)[..., np.newaxis] * np.eye(3) for m in (gyro, acc))
        R_g, R_a = np.linalg.inv(K_g) @ gyro, np.linalg.inv(K_a) @ acc
        return cls(K_a, R_a, b_a, K_g, R_g, b_g, readings=readings)
