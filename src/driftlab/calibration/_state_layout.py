"""What the numbers of a state vector are: attitude, velocity, sensor errors.

The order is that of Wu (45)-(48); states of higher order stand behind the others.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array
from driftlab.higher_order_errors import NO_HIGHER_ORDER_ERRORS, HigherOrderErrors
from driftlab.imu import ImuErrors
from driftlab.increments import Increments, without_errors

from . import _higher_order_states as higher
from ._triad_bases import combined


@dataclass(frozen=True, eq=False)
class StateLayout:
    """States of a calibration filter, and the sensor errors that they describe.

    Its attributes are those of `ErrorModel`, which says what they are.

    Examples
    --------
    >>> from driftlab.calibration import FULL
    >>> isinstance(FULL, StateLayout)
    True
    """

    frame: str | None
    gyro_basis: FloatArray
    accelerometer_basis: FloatArray
    names: tuple[str, ...]
    higher_order: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """Number of states.

        Returns
        -------
        int
            27, or 30 for the model of all states; more with states by choice.

        Examples
        --------
        >>> from driftlab.calibration import ERROR_MODELS, FULL
        >>> ERROR_MODELS["upper triangle"].size, FULL.size
        (27, 30)
        """
        return len(self.names)

    @property
    def triad_states(self) -> int:
        """Number of states before those of higher order: 27 or 30.

        Returns
        -------
        int

        Examples
        --------
        >>> from driftlab.calibration import FULL
        >>> FULL.with_states("time skew").triad_states
        30
        """
        return 12 + len(self.gyro_basis) + len(self.accelerometer_basis)

    def imu_errors(self, state: ArrayLike) -> ImuErrors:
        """Sensor errors that a state vector describes.

        Parameters
        ----------
        state : array_like, shape (..., size)
            Its attitude and velocity errors are ignored.

        Returns
        -------
        ImuErrors
            Biases (..., 3) in rad/s and m/s^2 and error matrices (..., 3, 3), in the model's own
            body axes.

        Examples
        --------
        The off-diagonal states of averaged axes are symmetric in the gyros' matrix:

        >>> from driftlab.calibration import ERROR_MODELS
        >>> model = ERROR_MODELS["averaged"]
        >>> model.imu_errors(np.arange(27.0)).gyro_error
        array([[ 9., 12., 13.],
               [12., 10., 14.],
               [13., 14., 11.]])
        """
        return self._imu_errors(finite_array(state, "state", self.size))

    def _imu_errors(self, state: FloatArray) -> ImuErrors:
        """`imu_errors` of a state that is computed, whatever has become of it."""
        middle = 9 + len(self.gyro_basis)
        return ImuErrors(  # nothing of the state itself, which who reads it could change
            state[..., 6:9].copy(),
            combined(state[..., 9:middle], self.gyro_basis),
            state[..., middle : middle + 3].copy(),
            combined(state[..., middle + 3 : self.triad_states], self.accelerometer_basis),
        )

    def higher_order_errors(self, state: ArrayLike) -> HigherOrderErrors:
        """Return what a state vector says of the errors of higher order.

        Parameters
        ----------
        state : array_like, shape (..., size)

        Returns
        -------
        HigherOrderErrors
            Zero where the model has no states for them.

        Examples
        --------
        >>> from driftlab.calibration import FULL
        >>> late = FULL.with_states("time skew")
        >>> float(late.higher_order_errors(np.arange(31.0)).time_skew)
        30.0
        """
        return self._higher_order_errors(finite_array(state, "state", self.size))

    def _higher_order_errors(self, state: FloatArray) -> HigherOrderErrors:
        return higher.unpacked(state[..., self.triad_states :].copy(), self.higher_order)

    def corrected(
        self, measured: Increments, state: FloatArray, rate_change: FloatArray | None = None
    ) -> Increments:
        """Take the errors that a state vector describes out of increments.

        Parameters
        ----------
        measured : Increments
            Arrays of shape (..., n, 3).
        state : ndarray, shape (..., size)
        rate_change : ndarray, shape (..., n, 3), optional
            As for `driftlab.increments.without_errors`.

        Returns
        -------
        Increments

        Examples
        --------
        >>> from driftlab.calibration import FULL
        >>> biased = Increments(1.0, np.ones((1, 3)), np.zeros((1, 3)))
        >>> bias = np.where(np.arange(30) == 6, 0.25, 0.0)
        >>> FULL.corrected(biased, bias).angle
        array([[0.75, 1.  , 1.  ]])
        """
        more = self._higher_order_errors(state) if self.higher_order else None
        return without_errors(measured, self._imu_errors(state), more, rate_change)

    def state(
        self, imu_errors: ImuErrors, higher_order: HigherOrderErrors | None = None
    ) -> FloatArray:
        """State vector of given sensor errors, with attitude and velocity errors zero.

        Parameters
        ----------
        imu_errors : ImuErrors
            Sensor errors (...) in the model's own body axes. Whatever part of a matrix is outside
            the span of the model's basis is dropped.
        higher_order : HigherOrderErrors, optional
            Zero if not given; what the model has no states for is dropped.

        Returns
        -------
        ndarray, shape (..., size)
            In the order of `names`; SI units.

        Examples
        --------
        >>> from driftlab.calibration import FULL
        >>> from driftlab.imu import TYPICAL_ERRORS
        >>> state = FULL.state(TYPICAL_ERRORS)
        >>> again = FULL.imu_errors(state)
        >>> state.shape, bool(np.allclose(again.gyro_error, TYPICAL_ERRORS.gyro_error))
        ((30,), True)
        """
        of_gyros, of_accelerometers = (
            # The matrices of a basis have no entries in common.
            np.tensordot(matrix, basis, ([-2, -1], [1, 2])) / (basis**2).sum(axis=(1, 2))
            for matrix, basis in (
                (imu_errors.gyro_error, self.gyro_basis),
                (imu_errors.accelerometer_error, self.accelerometer_basis),
            )
        )
        parts = [np.zeros(6), imu_errors.gyro_bias, of_gyros]
        parts += [imu_errors.accelerometer_bias, of_accelerometers]
        if self.higher_order:
            more = NO_HIGHER_ORDER_ERRORS if higher_order is None else higher_order
            parts.append(higher.packed(more, self.higher_order))
        lead = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
        return np.concatenate([np.broadcast_to(x, (*lead, x.shape[-1])) for x in parts], axis=-1)
