"""Wu et al., section 4: calibrating a whole unit on a turntable with a Kalman filter.

The unit navigates while the table turns it. Its centre stays where it is, so whatever velocity the
computation shows is an error, and a filter that knows how errors grow traces it back to the
sensors. What the filter finds is fed back at once: into attitude and velocity, and into the
correction of the increments that follow. So the filter always works near zero error, where its
linear model holds.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    unit_quaternions,
    whole_number,
)
from driftlab.core.quaternion import from_rotation_vector, multiply
from driftlab.core.strapdown import last_of, navigate
from driftlab.earth import checked_latitude
from driftlab.imu import Noise, Spread, Unit, increment_rows, without_errors
from driftlab.strapdown import ALGORITHM, at_rest

from .error_dynamics import free_growth, process_noise, transition_of_increments
from .error_model import ErrorModel
from .kalman import kalman_step


class Calibration(NamedTuple):
    """History of a calibration, every so many updates.

    Attributes
    ----------
    model : ErrorModel
    times : ndarray, shape (k,)
        s since the start.
    state : ndarray, shape (..., k, size)
        Sensor errors found, in the model's own body axes; attitude and velocity are zero here.
    covariance : ndarray, shape (..., k, size, size)
    attitude : ndarray, shape (..., k, 4)
        Attitude found of the model's own axes, body to East, North, Up.
    velocity : ndarray, shape (..., k, 3)
        Velocity found, m/s.
    surprise : ndarray, shape (..., updates)
        Squared normalised innovations of all updates. Their mean is near three if what the filter
        is told is true; much more says that it is not.
    """

    model: ErrorModel
    times: FloatArray
    state: FloatArray
    covariance: FloatArray
    attitude: FloatArray
    velocity: FloatArray
    surprise: FloatArray

    @property
    def deviations(self) -> FloatArray:
        """Standard deviations (..., k, size) that the filter states."""
        return np.sqrt(np.einsum("...ii->...i", self.covariance))

    @property
    def unit(self) -> Unit:
        """Sensor errors found at the end, in the model's own body axes.

        `calibration_trial.unit_in_axes` turns known errors into the same axes.
        """
        return self.model.unit(self.state[..., -1, :])


def calibrate(
    angle_increments: ArrayLike,
    velocity_increments: ArrayLike,
    reference_velocity: ArrayLike,
    *,
    interval: float,
    latitude: float,
    start: ArrayLike,
    model: ErrorModel,
    spread: Spread,
    noise: Noise,
    keep: int = 10,
) -> Calibration:
    """Find the errors of a unit from what it said on a turntable.

    Parameters
    ----------
    angle_increments, velocity_increments : array_like, shape (..., n, 3)
        Measured increments; several units or runs along the leading axes.
    reference_velocity : array_like, shape (..., updates, 3)
        Measured velocity of the table's centre, m/s, at the end of each update interval. Their
        number divides n, into an even number of increments each.
    interval : float
        Sample interval, s.
    latitude : float
        Of the table, rad.
    start : array_like, shape (..., 4)
        Attitude at the start as the table tells it, body to East, North, Up: nearly the same for
        all runs.
    model : ErrorModel
        The states, one of `driftlab.calibration.error_model.ERROR_MODELS`.
    spread, noise : Spread, Noise
        What the filter is told about the unit.
    keep : int
        The history keeps each `keep`-th update, and the last.
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    angle, velocity = increment_rows(angle_increments, velocity_increments)
    reference = finite_array(reference_velocity, "reference_velocity", 3)
    attitude = unit_quaternions(start, "start")
    updates = reference.shape[-2] if reference.ndim > 1 else 0
    count = angle.shape[-2]
    if updates == 0 or count % (2 * updates):
        raise ValueError(
            "reference_velocity: expected shape (..., updates, 3), with a number of updates that "
            f"divides {count} increments into even parts, got shape {reference.shape}."
        )
    if noise.velocity <= 0:
        raise ValueError(
            f"noise: expected a deviation of the velocity above 0, got {noise.velocity!r} m/s."
        )
    kept = [*range(whole_number(keep, "keep"), updates, keep), updates]
    each = count // updates
    seconds = finite_number(interval, "interval")
    duration = each * seconds
    free = free_growth(place, duration)
    lead = np.broadcast_shapes(
        angle.shape[:-2], velocity.shape[:-2], reference.shape[:-2], attitude.shape[:-1]
    )
    state = np.zeros((*lead, model.size))
    # The starts of all runs are nearly one attitude; any of them says how the states hang together.
    before = model.covariance(spread, attitude.reshape(-1, 4)[0])
    covariance = np.broadcast_to(before, (*lead, model.size, model.size))
    home = at_rest(place, np.broadcast_to(attitude, (*lead, 4)))
    now = home
    surprises, history = [], []
    for k in range(updates):
        rows = np.s_[..., k * each : (k + 1) * each, :]
        true_angle, true_velocity = without_errors(
            angle[rows], velocity[rows], model.unit(state), seconds
        )
        way = navigate(now, true_angle, true_velocity, seconds, ALGORITHM)
        attitudes = np.concatenate([now.attitude[..., np.newaxis, :], way.attitude], axis=-2)
        growth = transition_of_increments(
            model, free, attitudes, true_angle, true_velocity, seconds
        )
        arrived = last_of(way)
        step = kalman_step(
            covariance,
            growth,
            process_noise(noise, growth[..., 3:6, :3], np.asarray(duration), model.size),
            arrived.velocity - reference[..., k, :],
            noise.velocity**2,
        )
        covariance = step.covariance
        state = state + step.correction
        state[..., :6] = 0.0
        # Fed back: attitude and velocity are put right, the place is known anyway.
        now = home._replace(
            velocity=arrived.velocity - step.correction[..., 3:6],
            attitude=multiply(from_rotation_vector(step.correction[..., :3]), arrived.attitude),
        )
        surprises.append(step.surprise)
        if k + 1 in kept:
            history.append((state, covariance, now.attitude, now.velocity))
    # The history is an axis after those of the runs.
    states, covariances, attitudes, velocities = (
        np.stack(row, axis=len(lead)) for row in zip(*history, strict=True)
    )
    return Calibration(
        model,
        duration * np.array(kept),
        states,
        covariances,
        attitudes,
        velocities,
        np.stack(surprises, axis=-1),
    )
