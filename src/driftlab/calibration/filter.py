"""Calibrating a whole unit on a turntable with a Kalman filter; Wu et al., section 4.

The unit navigates while the table turns it. Its centre does not move, so any computed velocity is
an error, and a filter traces it back to the sensors. The estimates are fed back at once: into
attitude and velocity, and into the compensation of the increments that follow.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from driftlab.checks import (
    FloatArray,
    UnusualWarning,
    checked_instance,
    finite_array,
    finite_number,
    positive_number,
    shown,
    speed_of_body,
    truth_value,
    unit_quaternions,
    whole_number,
)
from driftlab.core import kalman, loops, quaternion
from driftlab.core.strapdown import final_state
from driftlab.earth import checked_latitude
from driftlab.higher_order_errors import _rate_changes
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments, checked_increments
from driftlab.motion.scheme import Scheme
from driftlab.strapdown import ALGORITHM, checked_interval, stationary_state

from ._filter_inputs import LARGER, FilterInputs, assumed_noise_contradictions
from .calibration_history import Calibration, InconsistentCalibrationWarning, checked_about
from .error_dynamics import (
    _covariance_before,
    _moving_states,
    _states_of_model,
    checked_model,
    checked_noise,
    free_transition,
    transition_of_increments,
)
from .error_model import ErrorModel

LARGE_BIAS = 1e-3
"""Deviation of the gyros' biases with which a filter that is linear in them may go astray, rad/s:
in a minute such a bias turns by three degrees."""
TAKE_THE_MEAN = (
    "Gyro biases as large as the prior says lead the filter astray: take the mean at rest out of "
    "the gyros first, then say in the prior what is left"
)


class FilterFailure(ValueError):
    """Error of a filter that could not go on to the end of a record.

    Its `inputs` are the arguments of `calibrate`, for `driftlab.diagnosis.diagnose`.
    """

    def __init__(self, sentence: str, inputs: FilterInputs | None = None) -> None:
        super().__init__(sentence)
        self.inputs = inputs


def calibrate(
    increments: Increments,
    reference_velocity: ArrayLike | None = None,
    *,
    latitude: float,
    start: ArrayLike,
    model: ErrorModel | str,
    prior: PriorStandardDeviations,
    noise: ImuNoise,
    reference_times: ArrayLike | None = None,
    update_interval: float | None = None,
    keep: int = 10,
    linearization_point: Calibration | None = None,
    check: bool = True,
) -> Calibration:
    r"""Estimate the sensor errors of a unit from its increments on a turntable.

    Parameters
    ----------
    increments : Increments
        Measured, arrays of shape (..., n, 3); several units or runs along the leading axes.
    reference_velocity : array_like, shape (..., updates, 3), optional
        Measured velocity of the table's centre, m/s, at the end of each update interval. The number
        of updates divides n into an even number of increments each, or `reference_times` says when.
        Not given for a table that stands: zeros.
    latitude : float
        Of the table, rad.
    start : array_like or Rotation, shape (..., 4)
        Attitude at the start as the table shows it, body to East, North, Up: nearly the same for
        all runs.
    model : ErrorModel or str
        The states, one of `driftlab.calibration.ERROR_MODELS`.
    prior : PriorStandardDeviations
        Standard deviations of the errors before the calibration, as the filter assumes them.
    noise : ImuNoise
        Noise of the sensors and of the reference velocity, as the filter assumes it. With a bias
        instability, six Gauss-Markov processes are estimated in addition to the states of `model`
        and not reported: the biases found are the constant (turn-on) ones. A table that
        stands moves by micrometres a second: with the usual 0.01 m/s the stated deviations come out
        too large, see `innovation_test`.
    reference_times : array_like, shape (updates,), optional
        When the reference velocities were measured, s since the start; they may lie as they like.
        The filter looks at the end of the nearest pair of increments. What comes after the last of
        them is not used; a warning says so if it is longer than the longest time between two.
    update_interval : float, optional
        Of a table that stands without `reference_times`, s: usually 1. The last update takes what
        is left over.
    keep : int
        The history keeps every `keep`-th update, and the last.
    linearization_point : Calibration, optional
        What an earlier pass over the same record found, with the same model. The error equations
        are then linearised about it, and not about the errors estimated so far.
    check : bool
        Whether to compare the record with gravity and the Earth's rate before, to test the
        innovations after, and to keep a copy of the arguments for `driftlab.diagnosis.diagnose`.

    Returns
    -------
    Calibration
        Estimates, their covariance and the innovations.

    Raises
    ------
    ValueError
        If shapes do not fit, the place is a pole, there are fewer than four increments, the
        reference velocity is said to be without noise, or `linearization_point` is of another
        model.
    FilterFailure
        If the record contradicts what was told so much that the filter cannot go on.

    Warns
    -----
    InconsistentCalibrationWarning
        If gravity or the Earth's rate contradict what was told, the innovations are too large or
        have a mean, the errors found are beyond what the prior allows or too large for one pass, or
        the rests show other noise than told. `driftlab.diagnosis.diagnose` looks for the cause.

    See Also
    --------
    innovation_test : Whether what the filter was told is true.
    driftlab.diagnosis.diagnose : What may have gone wrong.
    covariance_analysis : The accuracy to be expected, without data.
    unobservable_subspace : What a scheme does not show.
    calibrate_multi_position : Without a turntable.

    Notes
    -----
    Wu, section 4; the filter's model is (45)-(52). The sensors measure, with constant K, L and b,

    .. math:: (I + K)\, \omega + b_g, \qquad (I + L) f + b_a,

    and what is left of these errors drives those of attitude and velocity in local axes,

    .. math::

        \dot\varphi &= -\Omega \times \varphi + F \delta v
            - C (\delta K \omega + \delta b_g) - C n_g, \\
        \dot{\delta v} &= f^l \times \varphi - 2\, \Omega \times \delta v
            + C (\delta L f + \delta b_a) + C n_a,

    with the Earth's rate :math:`\Omega`, the turn F of the local axes by a velocity, the attitude C
    and white noise n. Measured is the velocity: computed less reference it is :math:`\delta v` and
    white noise.

    One state cannot be both a constant of unknown size and a process that returns to zero, so what
    varies of a bias has a state of its own: a first-order Gauss-Markov process, from one update to
    the next :math:`m' = e^{-t/T} m + w`, with noise w of variance :math:`s^2 (1 - e^{-2t/T})`. It
    is held over an update; if an update is longer than the correlation time T, the filter is too
    cautious. A filter of constants states standard deviations that are too small, and its
    innovations may not show it.

    The first pass feeds its estimates back at once; what it learnt while they were far off it has
    learnt with the wrong derivatives. A pass about a result navigates with that from the
    beginning and feeds nothing back. It starts from the same prior about the same mean, so nothing
    counts twice: a step of Gauss and Newton.

    References
    ----------
    - R. E. Kalman, *A new approach to linear filtering and prediction problems*, Journal of Basic
      Engineering 82(1), 1960.
    - D. H. Titterton, J. L. Weston, *Strapdown Inertial Navigation Technology*, 2nd edition, The
      Institution of Electrical Engineers, 2004.

    Examples
    --------
    Standard deviations of the accelerometer biases after two minutes at rest, relative to those
    before. The level ones cannot be separated from a tilt:

    >>> from driftlab.calibration import ERROR_MODELS
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> from driftlab.increments import measure
    >>> from driftlab.motion import Scheme, turntable_trajectory
    >>> true = turntable_trajectory(Scheme(""), latitude=0.7, interval=0.5)
    >>> found = calibrate(
    ...     measure(true.increments, TYPICAL_ERRORS), np.zeros((12, 3)), latitude=0.7,
    ...     start=true.attitude[0], model=ERROR_MODELS["averaged"], prior=PriorStandardDeviations(),
    ...     noise=ImuNoise(),
    ... )
    >>> biases = [found.model.names.index(f"accelerometer bias {axis}") for axis in "xyz"]
    >>> prior = PriorStandardDeviations().accelerometer_bias
    >>> (found.standard_deviations[-1, biases] / prior).round(2)
    array([0.76, 0.76, 0.32])
    """
    model = checked_model(model)
    checked_instance(prior, PriorStandardDeviations, "prior")
    checked_noise(noise)
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    if isinstance(start, Scheme):
        raise ValueError(
            "start: expected a quaternion (..., 4), got a Scheme: hand in scheme.start_attitude."
        )
    truth_value(check, "check")
    measured = checked_increments(increments)
    speed_of_body(measured.velocity, "increments.velocity")
    attitude = unit_quaternions(start, "start")
    interval = checked_interval(measured.interval)
    ends, reference = _updates(
        measured.angle.shape[-2], interval, reference_velocity, reference_times, update_interval
    )
    speed_of_body(reference, "reference_velocity")
    keep = whole_number(keep, "keep")
    inputs = FilterInputs(
        increments=measured,
        start=attitude,
        latitude=place,
        model=model,
        prior=prior,
        noise=noise,
        reference=reference,
        ends=ends,
        first=linearization_point is None,
    )
    if linearization_point is not None:
        checked_about(linearization_point, model, inputs.lead)
    doubted = _warn(seen[1:]) if check and (seen := inputs.impossible()) else None
    try:
        found = _filtered(inputs, keep, linearization_point)
    except (ValueError, np.linalg.LinAlgError) as failure:
        if doubted is None and prior.gyro_bias <= LARGE_BIAS:
            raise
        if doubted is None:
            sentence = (
                "prior: expected errors that the filter can follow, got a gyro_bias of "
                f"{prior.gyro_bias:.3g} rad/s, and it could not go on: {failure} {TAKE_THE_MEAN}."
            )
            raise FilterFailure(sentence, inputs.copied()) from failure
        sentence = (
            "increments: expected a record that the filter can follow to its end, got one that "
            f"contradicts what was told, so that it could not go on: {failure} "
            "driftlab.diagnosis.diagnose, given this error, looks for the cause."
        )
        raise FilterFailure(sentence, inputs.copied()) from doubted
    if check and doubted is None:
        run, said = found._contradictions(inputs)
        if not said and (noise_seen := assumed_noise_contradictions(inputs.run(run))[0]):
            said = [
                f"expected noise within a factor of {LARGER:g} of what was told, got "
                + "; ".join(noise_seen)
            ]
        # What a slip makes of the errors is no reason for a second pass.
        _warn(said or (found._too_large() if inputs.first else []))
    return found._replace(inputs=inputs.copied()) if check else found


def _warn(said: Sequence[str]) -> InconsistentCalibrationWarning | None:
    """Warn of contradictions, if there are any, where `calibrate` was called."""
    if not said:
        return None
    warning = InconsistentCalibrationWarning(
        f"calibration: {'. Besides, '.join(part.rstrip('?') for part in said)}; "
        "driftlab.diagnosis.diagnose(found) looks for the cause."
    )
    warnings.warn(warning, stacklevel=3)
    return warning


def _filtered(
    inputs: FilterInputs, keep: int, linearization_point: Calibration | None
) -> Calibration:
    """The filter itself."""
    measured, attitude, place, model, prior, noise, reference, ends, _ = inputs
    lead, interval = inputs.lead, measured.interval
    kept = {*range(keep, len(ends), keep), len(ends)}
    lengths = np.diff(ends, prepend=0)
    free = {each: free_transition(place, each * interval) for each in set(lengths.tolist())}
    # The estimate: errors that are navigated with, and the mean of what is left of them.
    state = np.zeros((*lead, model.size))
    believed = np.broadcast_to(attitude, (*lead, 4))
    # The starts of all runs are nearly one attitude; any of them gives the states' correlations.
    before = _covariance_before(model, prior, noise, attitude.reshape(-1, 4)[0])
    covariance = np.broadcast_to(before, (*lead, *before.shape))
    # Bias instabilities are not fed back: they stay in the mean.
    own, mean = _states_of_model(model, noise), np.zeros((*lead, len(before)))
    if linearization_point is not None:
        state, start_found = linearization_point._linearization_point(
            measured.part(0, ends[-1]), place
        )
        mean[..., own] = -state
        back = quaternion.multiply(believed, quaternion.conjugate(start_found))
        mean[..., :3] = quaternion.to_rotation_vector(back)
        believed = start_found
    changes = _rate_changes(measured.interval, measured.angle) if model.higher_order else None
    # Wu (51), (52): of all states the velocity error is seen, with noise.
    observed, spread = np.eye(3, len(before), 3), noise.reference_velocity**2 * np.eye(3)
    now = home = stationary_state(place, believed)
    nis_history, seen, history = [], [], []
    for k, (end, each) in enumerate(zip(ends.tolist(), lengths.tolist(), strict=True)):
        change = None if changes is None else changes[..., end - each : end, :]
        true = model._corrected(measured.part(end - each, end), state, change)
        way = loops.navigate(
            now, true.angle, true.velocity, true.interval, ALGORITHM, calls=len(ends)
        )
        attitudes = np.concatenate([now.attitude[..., np.newaxis, :], way.attitude], axis=-2)
        growth = transition_of_increments(model, free[each], attitudes, true, change)
        arrived = final_state(way)
        rows, added = _moving_states(model, noise, growth, each * interval)
        moving = rows.shape[-2]
        mean[..., :moving] = (rows @ mean[..., np.newaxis])[..., 0]
        covariance = kalman.predict(covariance, rows, added)
        innovation = arrived.velocity - reference[..., k, :] - mean[..., 3:6]
        seen.append((innovation, covariance[..., 3:6, 3:6]))
        correction, covariance, nis = kalman.correct(covariance, innovation, observed, spread)
        mean = mean + correction
        found = state + mean[..., own]
        found[..., :6] = 0.0
        back = quaternion.from_rotation_vector(mean[..., :3])
        corrected = arrived._replace(
            velocity=arrived.velocity - mean[..., 3:6],
            attitude=quaternion.multiply(back, arrived.attitude),
        )
        if linearization_point is None:  # fed back
            state, arrived = found, corrected
            mean[..., own] = 0.0
        now = home._replace(velocity=arrived.velocity, attitude=arrived.attitude)
        nis_history.append(nis)
        if k + 1 in kept:
            stated = covariance[..., own[:, np.newaxis], own]
            history.append((found, stated, corrected.attitude, corrected.velocity))
    states, covariances, attitudes, velocities = (
        np.stack(row, axis=len(lead)) for row in zip(*history, strict=True)
    )
    nis = np.stack(nis_history, axis=-1)
    innovations, predicted = (np.stack(row, axis=len(lead)) for row in zip(*seen, strict=True))
    whitened = _normalised_innovations(innovations, predicted, noise.reference_velocity**2)
    times = interval * ends[[k - 1 for k in sorted(kept)]]
    return Calibration(
        model=model,
        times=times,
        state=states,
        covariance=covariances,
        attitude=attitudes,
        velocity=velocities,
        nis=nis,
        innovations=whitened,
    )


USUAL_INTERVAL = 1.0
"""Of the updates at a table that stands, if nothing else is said, s."""
_LEAST = 4


def _updates(
    count: int,
    interval: float,
    reference_velocity: ArrayLike | None,
    reference_times: ArrayLike | None,
    update_interval: float | None,
) -> tuple[NDArray[Any], FloatArray]:
    """Ends (k,) of the updates, as numbers of increments, and the velocities (..., k, 3) there."""
    if count < _LEAST:
        raise ValueError(f"increments: expected at least {_LEAST}, two pairs, got {count}.")
    if update_interval is not None and (
        reference_velocity is not None or reference_times is not None
    ):
        raise ValueError(
            "update_interval: expected with a table that stands, without reference_velocity and "
            f"reference_times, got {shown(update_interval)}."
        )
    if reference_times is not None:
        ends = _nearest_pairs(count, interval, reference_times)
        if reference_velocity is None:
            return ends, np.zeros((len(ends), 3))
        reference = finite_array(reference_velocity, "reference_velocity", 3)
        if reference.ndim < 2 or reference.shape[-2] != len(ends):
            raise ValueError(
                f"reference_velocity: expected shape (..., {len(ends)}, 3), as many as "
                f"reference_times, got shape {reference.shape}."
            )
        return ends, reference
    if reference_velocity is None:
        seconds = USUAL_INTERVAL if update_interval is None else update_interval
        pairs = max(round(positive_number(seconds, "update_interval") / (2 * interval)), 1)
        inner = np.arange(2 * pairs, count - 1, 2 * pairs)
        # The last update takes what is left, but for one increment of an odd number.
        ends = np.append(inner[inner < count - count % 2], count - count % 2)
        if 2 * pairs > count:
            warnings.warn(
                f"update_interval: {seconds:g} s is longer than the record, {interval * count:g} s:"
                " there is one update only, and little is learnt beyond the prior.",
                UnusualWarning,
                stacklevel=3,
            )
        return ends, np.zeros((len(ends), 3))
    reference = finite_array(reference_velocity, "reference_velocity", 3)
    number = reference.shape[-2] if reference.ndim > 1 else 0
    if number == 0 or count % (2 * number):
        raise ValueError(
            "reference_velocity: expected shape (..., updates, 3), with a number of updates that "
            f"divides {count} increments into even parts, got shape {reference.shape}. "
            "Velocities of other moments go with their reference_times."
        )
    return np.arange(1, number + 1) * (count // number), reference


def _nearest_pairs(count: int, interval: float, reference_times: ArrayLike) -> NDArray[Any]:
    """Even numbers of increments nearest to times since the start, s."""
    times = finite_array(reference_times, "reference_times")
    end = interval * count
    if times.ndim != 1 or times.min() < interval / 2 or times.max() > end + interval:
        raise ValueError(
            "reference_times: expected times (k,) since the start, from half an interval, "
            f"{interval / 2:g} s, to {end:g} s, got shape {times.shape}, {times.min():g} to "
            f"{times.max():g} s."
        )
    ends = np.clip(2 * np.round(times / (2 * interval)).astype(int), 2, count - count % 2)
    if (np.diff(ends) <= 0).any():
        raise ValueError(
            "reference_times: expected times that rise by more than a pair of increments, "
            f"{2 * interval:g} s, got a step of {np.diff(times).min():g} s."
        )
    if count - ends[-1] > np.diff(ends, prepend=0).max():
        warnings.warn(
            f"reference_times: the record goes on for {interval * (count - ends[-1]):g} s after "
            "the last of them; that is not used.",
            stacklevel=4,
        )
    return ends


def _normalised_innovations(
    innovation: FloatArray, predicted: FloatArray, variance: float
) -> FloatArray:
    """Innovations (..., 3) with covariance I; `predicted` (..., 3, 3) is before the update."""
    root = np.linalg.cholesky(predicted + variance * np.eye(3))
    return np.linalg.solve(root, innovation[..., np.newaxis])[..., 0]
