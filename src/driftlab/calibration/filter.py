"""Wu et al., section 4: calibrating a whole unit on a turntable with a Kalman filter.

The unit navigates while the table turns it. Its centre does not move, so any computed velocity is
an error, and a filter traces it back to the sensors. The estimates are fed back at once: into
attitude and velocity, and into the compensation of the increments that follow.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    finite_number,
    unit_quaternions,
    whole_number,
)
from driftlab.core import kalman, quaternion
from driftlab.core.attitude import step_quaternions
from driftlab.core.strapdown import last_of, navigate
from driftlab.earth import checked_latitude, earth_rate
from driftlab.imu import ImuErrors, ImuNoise, PriorDeviations
from driftlab.increments import Increments, checked_increments, without_errors
from driftlab.strapdown import ALGORITHM, at_rest, checked_interval

from .error_dynamics import free_transition, process_noise, transition_of_increments
from .error_model import ErrorModel
from .linearization import checked_model


class Calibration(NamedTuple):
    """History of a calibration, at k of its updates.

    Attributes
    ----------
    model : ErrorModel
        The states.
    times : ndarray, shape (k,)
        Since the start, s.
    state : ndarray, shape (..., k, size)
        Estimated sensor errors, in the model's own body axes; attitude and velocity errors are zero
        here, because they are fed back.
    covariance : ndarray, shape (..., k, size, size)
        Of the estimation errors, as the filter computes it.
    attitude : ndarray, shape (..., k, 4)
        Estimated attitude of the model's own axes, body to East, North, Up.
    velocity : ndarray, shape (..., k, 3)
        Estimated velocity, East, North, Up, m/s.
    nis : ndarray, shape (..., updates)
        Squared normalised innovations (NIS) of all updates. Their mean is near three if the
        filter's assumptions are true; a mean much larger shows that they are not.

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
        return self.model.imu_errors(self.state[..., -1, :])


def calibrate(
    increments: Increments,
    reference_velocity: ArrayLike,
    *,
    latitude: float,
    start: ArrayLike,
    model: ErrorModel,
    prior: PriorDeviations,
    noise: ImuNoise,
    keep: int = 10,
    about: Calibration | None = None,
) -> Calibration:
    """Estimate the sensor errors of a unit from its increments on a turntable.

    Parameters
    ----------
    increments : Increments
        Measured, arrays of shape (..., n, 3); several units or runs along the leading axes.
    reference_velocity : array_like, shape (..., updates, 3)
        Measured velocity of the table's centre, m/s, at the end of each update interval. The number
        of updates divides n into an even number of increments each.
    latitude : float
        Of the table, rad.
    start : array_like, shape (..., 4)
        Attitude at the start as the table shows it, body to East, North, Up: nearly the same for
        all runs.
    model : ErrorModel
        The states, one of `driftlab.calibration.ERROR_MODELS`.
    prior : PriorDeviations
        Standard deviations of the errors before the calibration, as the filter assumes them.
    noise : ImuNoise
        Noise of the sensors and of the reference velocity, as the filter assumes it.
    keep : int
        The history keeps every `keep`-th update, and the last.
    about : Calibration, optional
        What an earlier pass over the same record found, with the same model. The error equations
        are then linearised about it, and not about the errors estimated so far.

    Returns
    -------
    Calibration
        Estimates, their covariance and the innovations.

    Raises
    ------
    ValueError
        If shapes do not fit, the place is a pole, the reference velocity is said to be without
        noise, or `about` is of another model.

    Notes
    -----
    Wu, section 4; the filter's model is (45)-(52).

    The first pass feeds its estimates back at once; what it learnt while they were far off it has
    learnt with the wrong derivatives. A pass `about` a result navigates with that from the
    beginning and feeds nothing back. It starts from the same prior about the same mean, so nothing
    counts twice: a step of Gauss and Newton.

    Examples
    --------
    Standard deviations of the accelerometer biases after two minutes at rest, relative to those
    before. The level ones cannot be separated from a tilt:

    >>> from driftlab.calibration import ERROR_MODELS
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> from driftlab.increments import measure
    >>> from driftlab.motion import Scheme, table_trajectory
    >>> true = table_trajectory(Scheme(""), latitude=0.7, interval=0.5)
    >>> found = calibrate(
    ...     measure(true.increments, TYPICAL_ERRORS), np.zeros((12, 3)), latitude=0.7,
    ...     start=true.attitude[0], model=ERROR_MODELS["averaged"], prior=PriorDeviations(),
    ...     noise=ImuNoise(),
    ... )
    >>> biases = [found.model.names.index(f"accelerometer bias {axis}") for axis in "xyz"]
    >>> (found.deviations[-1, biases] / PriorDeviations().accelerometer_bias).round(2)
    array([0.76, 0.76, 0.32])
    """
    checked_model(model)
    checked_instance(prior, PriorDeviations, "prior")
    checked_instance(noise, ImuNoise, "noise")
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    measured = checked_increments(increments)
    reference = finite_array(reference_velocity, "reference_velocity", 3)
    attitude = unit_quaternions(start, "start")
    updates = reference.shape[-2] if reference.ndim > 1 else 0
    count = measured.angle.shape[-2]
    if updates == 0 or count % (2 * updates):
        raise ValueError(
            "reference_velocity: expected shape (..., updates, 3), with a number of updates that "
            f"divides {count} increments into even parts, got shape {reference.shape}."
        )
    if noise.reference_velocity <= 0:
        raise ValueError(
            "noise: expected a deviation of the reference velocity above 0, "
            f"got {noise.reference_velocity!r} m/s."
        )
    kept = [*range(whole_number(keep, "keep"), updates, keep), updates]
    each = count // updates
    duration = each * checked_interval(measured.interval)
    free = free_transition(place, duration)
    lead = np.broadcast_shapes(
        measured.angle.shape[:-2],
        measured.velocity.shape[:-2],
        reference.shape[:-2],
        attitude.shape[:-1],
    )
    # The estimate: errors that are navigated with, and the mean of what is left of them.
    state = mean = np.zeros((*lead, model.size))
    believed = np.broadcast_to(attitude, (*lead, 4))
    # The starts of all runs are nearly one attitude; any of them gives the states' correlations.
    before = model.covariance(prior, attitude.reshape(-1, 4)[0])
    covariance = np.broadcast_to(before, (*lead, model.size, model.size))
    if about is not None:
        _check_about(about, model, lead)
        state, start_found = _linearization_point(measured, place, about)
        mean = -state
        back = quaternion.multiply(believed, quaternion.conjugate(start_found))
        mean[..., :3] = quaternion.to_rotation_vector(back)
        believed = start_found
    # Wu (51), (52): of all states the velocity error is seen, with noise.
    observed, spread = np.eye(3, model.size, 3), noise.reference_velocity**2 * np.eye(3)
    now = home = at_rest(place, believed)
    nis_history, history = [], []
    for k in range(updates):
        true = without_errors(measured.part(k * each, (k + 1) * each), model.imu_errors(state))
        way = navigate(now, true.angle, true.velocity, true.interval, ALGORITHM)
        attitudes = np.concatenate([now.attitude[..., np.newaxis, :], way.attitude], axis=-2)
        growth = transition_of_increments(model, free, attitudes, true)
        arrived = last_of(way)
        mean = (growth @ mean[..., np.newaxis])[..., 0]
        added = process_noise(noise, growth[..., 3:6, :3], np.asarray(duration))
        covariance = kalman.predict(covariance, growth[..., :6, :], added)
        innovation = arrived.velocity - reference[..., k, :] - mean[..., 3:6]
        correction, covariance, nis = kalman.correct(covariance, innovation, observed, spread)
        mean = mean + correction
        found = state + mean
        found[..., :6] = 0.0
        back = quaternion.from_rotation_vector(mean[..., :3])
        corrected = arrived._replace(
            velocity=arrived.velocity - mean[..., 3:6],
            attitude=quaternion.multiply(back, arrived.attitude),
        )
        if about is None:  # fed back
            state, mean, arrived = found, np.zeros_like(mean), corrected
        now = home._replace(velocity=arrived.velocity, attitude=arrived.attitude)
        nis_history.append(nis)
        if k + 1 in kept:
            history.append((found, covariance, corrected.attitude, corrected.velocity))
    states, covariances, attitudes, velocities = (
        np.stack(row, axis=len(lead)) for row in zip(*history, strict=True)
    )
    times, nis = duration * np.array(kept), np.stack(nis_history, axis=-1)
    return Calibration(model, times, states, covariances, attitudes, velocities, nis)


def _check_about(about: Calibration, model: ErrorModel, lead: tuple[int, ...]) -> None:
    """Refuse an earlier pass that is of another model or of other runs."""
    checked_instance(about, Calibration, "about")
    if about.model is not model or about.state.shape[:-2] != lead:
        raise ValueError(
            f"about: expected runs {lead} with the model {model.frame!r}, "
            f"got {about.state.shape[:-2]} with {about.model.frame!r}."
        )


def _linearization_point(
    measured: Increments, latitude: float, about: Calibration
) -> tuple[FloatArray, FloatArray]:
    """State (..., size) that a pass found, and the attitude (..., 4) that it found for the start:
    that at the end is known best, and the corrected gyros lead back from it."""
    state = about.state[..., -1, :]
    angle = without_errors(measured, about.imu_errors).angle
    turned = quaternion.cumulative_product(step_quaternions(ALGORITHM, angle))[..., -1, :]
    # In axes that do not turn with the Earth: those of the beginning.
    at_end = quaternion.from_rotation_vector(about.times[-1] * earth_rate(latitude))
    return state, quaternion.multiply(
        quaternion.multiply(at_end, about.attitude[..., -1, :]), quaternion.conjugate(turned)
    )
