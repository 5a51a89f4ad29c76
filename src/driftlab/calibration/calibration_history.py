"""What a calibration on a turntable found, update by update."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.imu import ImuErrors

from .error_model import ErrorModel


class Calibration(NamedTuple):
    """History of a calibration, at k of its updates.

    Attributes
    ----------
    model : ErrorModel
        The states.
    times : ndarray, shape (k,)
        Since the start, s.
    state : ndarray, shape (..., k, size)
        Estimated sensor errors in the order of ``model.names``, in the model's own body axes: gyro
        biases in rad/s, accelerometer biases in m/s^2, entries of the matrices without unit (rad
        off the diagonal), states of `ErrorModel.with_states` in the SI units of
        `HigherOrderErrors`. Attitude and velocity errors (rad, m/s) are zero here, because they are
        fed back.
    covariance : ndarray, shape (..., k, size, size)
        Of the estimation errors, as the filter computes it: in the products of the units of two
        states, so (rad/s)^2 for the variance of a gyro bias.
    attitude : ndarray, shape (..., k, 4)
        Estimated attitude of the model's own axes, body to East, North, Up.
    velocity : ndarray, shape (..., k, 3)
        Estimated velocity, East, North, Up, m/s.
    nis : ndarray, shape (..., updates)
        Squared normalised innovations (NIS) of all updates. Their mean is near three if all that
        the filter was told is true. A mean near three proves nothing: of a table that stands it is
        far below if the noise of its velocity was told too large, and a slip can make up for that.
        `innovation_test` looks at more.
    innovations : ndarray, shape (..., updates, 3)
        Innovations with covariance I, which `nis` are the sums of squares of.

    Examples
    --------
    >>> from driftlab.calibration import TableTrial
    >>> from driftlab.motion.scheme import Scheme
    >>> trial = TableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
    >>> found = trial.run(np.random.default_rng(1)).calibration
    >>> found.state.shape, found.nis.shape, round(float(found.nis.mean()), 1)
    ((4, 27), (64,), 2.6)
    """

    model: ErrorModel
    times: FloatArray
    state: FloatArray
    covariance: FloatArray
    attitude: FloatArray
    velocity: FloatArray
    nis: FloatArray
    innovations: FloatArray = np.zeros((0, 3))

    @property
    def deviations(self) -> FloatArray:
        """Standard deviations of the states, as the filter computes them.

        Returns
        -------
        ndarray, shape (..., k, size)
            In the units of the states.

        Examples
        --------
        >>> from driftlab.calibration import ERROR_MODELS
        >>> from driftlab.imu import PriorDeviations
        >>> model = ERROR_MODELS["averaged"]
        >>> at_start = model.covariance(PriorDeviations(scale=1e-4), [0, 0, 0, 1])
        >>> none = np.zeros((1, 27))
        >>> known = Calibration(model, none[0], none, at_start[np.newaxis], none, none, none[0])
        >>> f"{known.deviations[-1, model.names.index('gyro scale x')]:.1e}"
        '1.0e-04'
        """
        return np.sqrt(np.einsum("...ii->...i", self.covariance))

    @property
    def imu_errors(self) -> ImuErrors:
        """Sensor errors found at the end, in the model's own body axes.

        `driftlab.calibration.imu_errors_in_frame` brings known errors to the same axes.

        Returns
        -------
        ImuErrors
            Biases (..., 3) in rad/s and m/s^2, error matrices (..., 3, 3).

        Examples
        --------
        >>> from driftlab.calibration import FULL
        >>> from driftlab.imu import TYPICAL_ERRORS
        >>> state, none = FULL.state(TYPICAL_ERRORS)[np.newaxis], np.zeros((1, 3))
        >>> found = Calibration(FULL, none[0], state, none, none, none, none[0])
        >>> bool(np.allclose(found.imu_errors.gyro_bias, TYPICAL_ERRORS.gyro_bias))
        True
        """
        return self.model._imu_errors(self.state[..., -1, :])
