"""One step of a Kalman filter whose measurement is a velocity."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

_UNIT = np.eye(3)  # made once, for the many steps of a filter


class Update(NamedTuple):
    """Result of one step of the filter.

    Attributes
    ----------
    correction : ndarray, shape (..., size)
        Estimate of the state.
    covariance : ndarray, shape (..., size, size)
        After the step.
    nis : ndarray, shape (...)
        Squared innovation, normalised by its covariance (NIS).

    Examples
    --------
    >>> step = velocity_update(np.eye(6), np.eye(6), np.zeros((6, 6)), np.array([1.0, 0, 0]), 1.0)
    >>> step.correction
    array([0. , 0. , 0. , 0.5, 0. , 0. ])
    """

    correction: FloatArray
    covariance: FloatArray
    nis: FloatArray


def velocity_update(
    covariance: FloatArray,
    transition: FloatArray,
    noise: FloatArray,
    velocity_error: FloatArray,
    velocity_variance: float,
) -> Update:
    """One prediction and update of an error-state filter whose state was reset to zero.

    Parameters
    ----------
    covariance : ndarray, shape (..., size, size)
        Before the step.
    transition : ndarray, shape (..., k, size)
        Rows of the transition matrix over the step for the first k states; the others stay as
        they are. At least the six of attitude and velocity.
    noise : ndarray, shape (..., k, k)
        Covariance of the process noise of the step in those states.
    velocity_error : ndarray, shape (..., 3)
        Computed minus measured velocity, m/s: states 3, 4, 5 plus noise. Wu (51), (52).
    velocity_variance : float
        Variance of that noise in each component, (m/s)^2.

    Returns
    -------
    Update
        Estimate of the state, covariance after the step, and normalised innovation.

    Examples
    --------
    Prior and measurement of a velocity are equally good, so half of the innovation is believed:

    >>> step = velocity_update(np.eye(6), np.eye(6), np.zeros((6, 6)), np.array([1.0, 0, 0]), 1.0)
    >>> float(step.correction[3]), float(step.covariance[3, 3]), float(step.nis)
    (0.5, 0.5, 0.5)
    """
    after, gain, weights = covariance_update(covariance, transition, noise, velocity_variance)
    column = velocity_error[..., np.newaxis]
    correction = (gain @ column)[..., 0]
    nis = (velocity_error[..., np.newaxis, :] @ weights @ column)[..., 0, 0]
    return Update(correction, after, nis)


def covariance_update(
    covariance: FloatArray, transition: FloatArray, noise: FloatArray, velocity_variance: float
) -> tuple[FloatArray, NDArray[Any], NDArray[Any]]:
    """Covariance and gain of `velocity_update`, which do not depend on the measurement.

    Parameters
    ----------
    covariance : ndarray, shape (..., size, size)
        Before the step.
    transition : ndarray, shape (..., k, size)
        Rows of the transition matrix over the step for the first k states; the others stay as
        they are. At least the six of attitude and velocity.
    noise : ndarray, shape (..., k, k)
        Covariance of the process noise of the step in those states.
    velocity_variance : float
        Variance of the measured velocity in each component, (m/s)^2.

    Returns
    -------
    covariance : ndarray, shape (..., size, size)
        After the step.
    gain : ndarray, shape (..., size, 3)
        Kalman gain.
    weights : ndarray, shape (..., 3, 3)
        Inverse of the innovation's covariance, (s/m)^2.

    Notes
    -----
    The short form P - K H P needs half the work of Joseph's form. Rounding makes it asymmetric and
    then, in filters with badly scaled states, indefinite, so it is made symmetric at each step.

    Examples
    --------
    >>> _, gain, weights = covariance_update(np.eye(6), np.eye(6), np.zeros((6, 6)), 3.0)
    >>> float(gain[3, 0]), float(weights[0, 0])
    (0.25, 0.25)
    """
    moving = transition.shape[-2]
    rows = transition @ covariance
    lead = np.broadcast_shapes(rows.shape[:-2], noise.shape[:-2])
    predicted = np.broadcast_to(covariance, (*lead, *covariance.shape[-2:])).copy()
    predicted[..., :moving, :moving] = rows @ transition.mT + noise
    predicted[..., :moving, moving:] = rows[..., moving:]
    predicted[..., moving:, :moving] = rows[..., moving:].mT
    seen = predicted[..., 3:6]
    weights = np.linalg.inv(seen[..., 3:6, :] + velocity_variance * _UNIT)
    gain = seen @ weights
    predicted -= gain @ seen.mT
    return 0.5 * (predicted + predicted.mT), gain, weights
