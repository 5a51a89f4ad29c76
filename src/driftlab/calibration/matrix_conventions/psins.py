"""Calibration matrices of PSINS, to and from `ImuErrors`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from numpy.typing import ArrayLike

from driftlab.calibration.matrix_conventions.forms import (
    bias_behind_matrix,
    matrix_before_bias,
    refuse_unless_zero,
)
from driftlab.imu import ImuErrors


@dataclass(frozen=True, eq=False)
class PsinsMatrices:
    """PSINS: ``true = Kg measured - eb`` and ``true = Ka measured - db``, in SI units.

    Attributes
    ----------
    Kg, Ka : array_like, shape (..., 3, 3)
        Calibration matrices, after `sf` has made SI units of the pulses.
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
        refuse_unless_zero(
            Ka2=self.Ka2,
            Kap=self.Kap,
            rx=self.rx,
            ry=self.ry,
            rz=self.rz,
            tGA=self.tGA,
            gSens=self.gSens,
        )
        return bias_behind_matrix(Kg=self.Kg, eb=self.eb, Ka=self.Ka, db=self.db)

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """PSINS' matrices of a unit, in the body axes that it has."""
        return cls(*matrix_before_bias(imu_errors))
