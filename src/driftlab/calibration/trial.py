"""A calibration beside the truth: the errors that remain, and how large they should be."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, checked_instance, finite_array
from driftlab.higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS,
    HigherOrderErrors,
    checked_higher_order_errors,
)
from driftlab.imu import ImuErrors

from .body_axes import attitude_error, attitude_of_axes, imu_errors_in_frame
from .calibration_history import Calibration
from .kalman import nees


class Trial(NamedTuple):
    """A calibration and the true errors of the unit.

    Attributes
    ----------
    calibration : Calibration
        What the filter found.
    imu_errors : ImuErrors
        The true errors, in the table's axes; `imu_errors_in_frame` brings them to the filter's.
    errors : ndarray, shape (..., k, size)
        Errors of the estimated states, in the filter's axes, at the times of the calibration.
    higher_order : HigherOrderErrors
        The true errors beyond bias and matrix.

    Examples
    --------
    >>> from driftlab.calibration import TableTrial
    >>> from driftlab.motion.scheme import Scheme
    >>> trial = TableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
    >>> found = trial.run(np.random.default_rng(1))
    >>> within = np.abs(found.errors[-1]) < 3 * found.calibration.deviations[-1]
    >>> f"{within.sum()} of {within.size} errors are within three standard deviations"
    '27 of 27 errors are within three standard deviations'
    """

    calibration: Calibration
    imu_errors: ImuErrors
    errors: FloatArray
    higher_order: HigherOrderErrors = NO_HIGHER_ORDER_ERRORS

    @property
    def nees(self) -> FloatArray:
        """Squared errors, normalised by the covariance that the filter computes (NEES).

        States that were known from the beginning, with a spread of zero, do not count.

        Returns
        -------
        ndarray, shape (..., k)
            Without unit. Of a consistent filter the mean over many trials is the number of states.

        Examples
        --------
        >>> from driftlab.calibration import TableTrial
        >>> from driftlab.motion.scheme import Scheme
        >>> trial = TableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
        >>> trial.run(np.random.default_rng(2), runs=5).nees[:, -1].round(0)
        array([18., 29., 22., 32., 35.])
        """
        return nees(self.errors, self.calibration.covariance)


def estimation_errors(
    calibration: Calibration,
    imu_errors: ImuErrors,
    attitude: ArrayLike,
    higher_order: HigherOrderErrors | None = None,
) -> FloatArray:
    """Errors of the states that a calibration estimated.

    Parameters
    ----------
    calibration : Calibration
        What the filter found.
    imu_errors : ImuErrors
        The true errors (...), in the table's axes.
    attitude : array_like or Rotation, shape (k, 4)
        True attitudes of the table's axes at the calibration's times, body to East, North, Up.
    higher_order : HigherOrderErrors, optional
        The true errors beyond bias and matrix; zero if not given.

    Returns
    -------
    ndarray, shape (..., k, size)
        True minus estimated sensor errors, computed minus true attitude and velocity.

    Examples
    --------
    A calibration that found nothing leaves all errors as they were:

    >>> from driftlab.calibration import FULL
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> level, none = np.array([[0.0, 0.0, 0.0, 1.0]]), np.zeros((1, 30))
    >>> nothing = Calibration(FULL, none[0], none, np.eye(30), level, none[:, :3], none[0])
    >>> errors = estimation_errors(nothing, TYPICAL_ERRORS, level)
    >>> bool(np.allclose(errors, FULL.state(TYPICAL_ERRORS)))
    True
    """
    model = checked_instance(calibration, Calibration, "calibration").model
    if higher_order is not None:
        checked_higher_order_errors(higher_order)
    shape, count = finite_array(attitude, "attitude", 4).shape, calibration.state.shape[-2]
    if shape != (count, 4):
        raise ValueError(
            f"attitude: expected shape ({count}, 4), one for each of the calibration's times, got "
            f"shape {shape}."
        )
    true, turn = imu_errors_in_frame(imu_errors, model.frame)
    errors = model.state(true, higher_order)[..., np.newaxis, :] - calibration.state
    true_attitude = attitude_of_axes(attitude, turn[..., np.newaxis, :, :])
    errors[..., :3] = attitude_error(calibration.attitude, true_attitude)
    errors[..., 3:6] = calibration.velocity
    return errors
