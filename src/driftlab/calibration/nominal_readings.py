"""What a reading of a sensor nominally is, in SI units, and what no reading can be."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, keep, positive_array
from driftlab.imu import ImuErrors, checked_imu_errors


@dataclass(frozen=True, eq=False)
class NominalReadings:
    """Nominal SI value of a reading: ``scale (reading - zero)``.

    The errors of a unit are what remains beyond that, so the same unit has other errors with other
    nominal scales.

    Attributes
    ----------
    gyro_scale : array_like, shape () or (3,)
        rad/s a reading, of all gyros or of each.
    gyro_zero : array_like, shape () or (3,)
        Reading of a gyro that does not turn.
    accelerometer_scale : array_like, shape () or (3,)
        m/s^2 a reading.
    accelerometer_zero : array_like, shape () or (3,)
        Reading of an accelerometer without specific force.

    Examples
    --------
    Counts of a converter with 16 bits, whose middle is zero:

    >>> counts = NominalReadings(1 / 4778, 32768, 1 / 415, 32768)
    >>> errors = counts.imu_errors(
    ...     4778 * np.eye(3), [32768] * 3, 415 * np.eye(3), [33183] * 3
    ... )
    >>> errors.accelerometer_bias
    array([1., 1., 1.])
    """

    gyro_scale: ArrayLike = 1.0
    gyro_zero: ArrayLike = 0.0
    accelerometer_scale: ArrayLike = 1.0
    accelerometer_zero: ArrayLike = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            array = finite_array(getattr(self, field.name), field.name)
            if array.shape not in ((), (3,)):
                raise ValueError(
                    f"{field.name}: expected shape () or (3,), got shape {array.shape}."
                )
            if field.name.endswith("scale"):
                positive_array(array, field.name)
            plain = array.tolist()  # so that readings can be compared, and nobody changes them
            keep(self, **{field.name: tuple(plain) if array.ndim else plain})

    def imu_errors(
        self,
        gyro_matrix: ArrayLike,
        gyro_offset: ArrayLike,
        accelerometer_matrix: ArrayLike,
        accelerometer_offset: ArrayLike,
    ) -> ImuErrors:
        """Errors of a unit whose readings are a matrix times the true values, and an offset.

        Parameters
        ----------
        gyro_matrix : array_like, shape (..., 3, 3)
            Readings per rad/s.
        gyro_offset : array_like, shape (..., 3)
            Readings.
        accelerometer_matrix : array_like, shape (..., 3, 3)
            Readings per m/s^2.
        accelerometer_offset : array_like, shape (..., 3)
            Readings.

        Returns
        -------
        ImuErrors
            Relative to the nominal values.

        Raises
        ------
        ValueError
            If a sensor reads less than a fifth or more than five times its nominal value, or with
            the other sign: a wrong unit, or matrices of another kind.

        Examples
        --------
        >>> errors = SI_READINGS.imu_errors(1.1 * np.eye(3), np.zeros(3), np.eye(3), np.zeros(3))
        >>> float(errors.gyro_error[0, 0].round(3))
        0.1
        """
        gyro_scale, gyro_zero, scale, zero = self._threes()
        gyro = gyro_scale[:, np.newaxis] * finite_array(gyro_matrix, "gyro_matrix", 3, 3)
        accelerometer = scale[:, np.newaxis] * finite_array(
            accelerometer_matrix, "accelerometer_matrix", 3, 3
        )
        for name, triad in (("gyro", gyro), ("accelerometer", accelerometer)):
            gains = np.einsum("...ii->...i", triad)
            if not ((gains >= 0.2) & (gains <= 5)).all():
                worst = gains.flat[np.argmax(np.abs(np.log(np.clip(gains, 1e-9, None))))]
                raise ValueError(
                    f"{name}_matrix: expected sensors that read 0.2 to 5 times their nominal "
                    f"value, got {worst:.3g} times; give the scale of the readings, or turn the "
                    "axes round."
                )
        gyro_offset = finite_array(gyro_offset, "gyro_offset", 3)
        accelerometer_offset = finite_array(accelerometer_offset, "accelerometer_offset", 3)
        return checked_imu_errors(
            ImuErrors(
                gyro_scale * (gyro_offset - gyro_zero),
                gyro - np.eye(3),
                scale * (accelerometer_offset - zero),
                accelerometer - np.eye(3),
            )
        )

    def triads(
        self, imu_errors: ImuErrors
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Matrix and offset of the readings of the gyros, then of the accelerometers.

        Parameters
        ----------
        imu_errors : ImuErrors
            Relative to the nominal values.

        Returns
        -------
        gyro_matrix, gyro_offset, accelerometer_matrix, accelerometer_offset : ndarray
            The arguments of `imu_errors`, which is the way back.

        Examples
        --------
        >>> from driftlab.imu import NO_ERRORS
        >>> NominalReadings(gyro_scale=0.5, gyro_zero=7).triads(NO_ERRORS)[:2]
        (array([[2., 0., 0.],
               [0., 2., 0.],
               [0., 0., 2.]]), array([7., 7., 7.]))
        """
        gyro_scale, gyro_zero, scale, zero = self._threes()
        imu_errors = checked_imu_errors(imu_errors)
        return (
            (np.eye(3) + imu_errors.gyro_error) / gyro_scale[:, np.newaxis],
            imu_errors.gyro_bias / gyro_scale + gyro_zero,
            (np.eye(3) + imu_errors.accelerometer_error) / scale[:, np.newaxis],
            imu_errors.accelerometer_bias / scale + zero,
        )

    def _threes(self) -> list[FloatArray]:
        """Scales and zeros, three each."""
        return [np.broadcast_to(getattr(self, field.name), 3) for field in fields(self)]


SI_READINGS = NominalReadings()
"""Readings that are rad/s and m/s^2 already."""


def checked_inverse(matrix: FloatArray, name: str) -> FloatArray:
    """Return the inverses of matrices (..., 3, 3), refusing a singular one by name."""
    if not (np.linalg.cond(matrix) < 1e12).all():
        raise ValueError(f"{name}: expected a matrix with an inverse, got a singular one.")
    return np.linalg.inv(matrix).astype(np.float64, copy=False)


def checked_zeros(**effects: ArrayLike) -> None:
    """Refuse effects, given by name, that a matrix and a bias for each triad cannot represent."""
    for name, effect in effects.items():
        size = np.abs(finite_array(effect, name)).max()
        if size > 0:
            raise ValueError(
                f"{name}: expected zeros, because ImuErrors has no place for it, got up to "
                f"{size:.3g}; take its effect out of the readings first, or give zeros and live "
                "with it."
            )
