"""One step of a Kalman filter whose measurement is a velocity."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

_UNIT = np.eye(3)  # made once, for the many steps of a filter


class Update(NamedTuple):
    """What one step of the filter gives."""

    correction: FloatArray  # (..., size): estimate of the state
    covariance: FloatArray  # (..., size, size)
    surprise: FloatArray  # (...): squared innovation in units of its variance


def kalman_step(
    covariance: FloatArray,
    transition: FloatArray,
    noise: FloatArray,
    velocity_error: FloatArray,
    velocity_variance: float,
) -> Update:
    """One prediction and one update of an error-state filter whose state was fed back to zero.

    Parameters
    ----------
    covariance, transition, noise : ndarray, shape (..., size, size)
        Covariance before the step, transition matrix, process noise.
    velocity_error : ndarray, shape (..., 3)
        Computed minus measured velocity: states 3, 4, 5 and noise. Wu (51), (52).
    velocity_variance : float
        Of that noise, (m/s)^2 in each component.
    """
    after, gain, weights = covariance_step(covariance, transition, noise, velocity_variance)
    column = velocity_error[..., np.newaxis]
    correction = (gain @ column)[..., 0]
    surprise = (velocity_error[..., np.newaxis, :] @ weights @ column)[..., 0, 0]
    return Update(correction, after, surprise)


def covariance_step(
    covariance: FloatArray, transition: FloatArray, noise: FloatArray, velocity_variance: float
) -> tuple[FloatArray, NDArray[Any], NDArray[Any]]:
    """What `kalman_step` does whatever is measured.

    Returns
    -------
    covariance : ndarray, shape (..., size, size)
        After the step.
    gain : ndarray, shape (..., size, 3)
    weights : ndarray, shape (..., 3, 3)
        Inverse of the innovation's covariance.

    Notes
    -----
    The short form P - K H P needs half the work of Joseph's. Rounding makes it lopsided, and in
    filters with badly scaled states then negative, so it is made symmetric each time.
    """
    predicted = transition @ covariance @ transition.mT
    predicted += noise
    seen = predicted[..., 3:6]
    weights = np.linalg.inv(seen[..., 3:6, :] + velocity_variance * _UNIT)
    gain = seen @ weights
    predicted -= gain @ seen.mT
    return 0.5 * (predicted + predicted.mT), gain, weights
