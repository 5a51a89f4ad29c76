"""Calibrating a unit by hand: rests in many poses, and the moves between them.

At rest the accelerometers must measure gravity, whatever the pose; and gravity, carried by the
gyros from one rest to the next, must be what the accelerometers find there. That is the method of
IMU-TK (Tedaldi, Pretto, Menegatti 2014). Where the unit is known to have come back to its attitude
the gyros alone must find no turn: this is Larin's test, and three components count instead of two.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.body_frames import BODY_FRAMES, body_frame_rotation, change_body_frame
from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_arrays,
    one_of,
    one_pull,
    truth_value,
    whole_pairs,
)
from driftlab.core import poses as core
from driftlab.earth import gravity as normal_gravity
from driftlab.imu import ImuErrors, ImuNoise, PriorDeviations
from driftlab.recordings.recording import Recording
from driftlab.recordings.rest_detection import Rests

from ._pose_fit import fit_poses
from ._rest_noise import noise_of_rests, warn_of_gravity
from .error_model import FULL
from .pose_results import PoseCalibration

POSE_AXES = (*BODY_FRAMES, "lower triangle accelerometers")
"""Choices of body axes: those of `driftlab.body_frames`, and one more.

``accelerometers`` has axis x along the x accelerometer, and L is zero above its diagonal: one of
the two triangles in which IMU-TK's matrices are in circulation. ``lower triangle accelerometers``
has axis z along the z accelerometer, and L is zero below: the other, IMU-TK's own.
"""


def calibrate_by_poses(
    recording: Recording,
    rests: Rests | Sequence[tuple[int, int]],
    *,
    gravity: float | None = None,
    body_axes: str = "accelerometers",
    closed: Sequence[tuple[int, int]] = (),
    noise: ImuNoise | None = None,
    prior: PriorDeviations | None = None,
    gyro_bias: ArrayLike | None = None,
    sensitivity: bool = False,
) -> PoseCalibration:
    r"""Estimate the errors of a unit from rests in several poses and the moves between them.

    Parameters
    ----------
    recording : Recording
        With accelerometers; rates or increments.
    rests : Rests or sequence of (int, int)
        From `driftlab.recordings.rests`, or the first row of each rest and the first after it.
    gravity : float, optional
        m/s^2. If not given, the record's own, or normal gravity at its latitude.
    body_axes : str
        One of `POSE_AXES`: which of the numbers are zero by choice.
    closed : sequence of (int, int), optional
        Pairs of rests, counted from 0, at which the unit had the same attitude.
    noise : ImuNoise, optional
        White noise of the sensors. If not given, it is taken from the rests: from means over half a
        second, which know of slow noise what white noise hides.
    prior : PriorDeviations, optional
        How large the errors may be, if that is known: for records with too few poses. Its
        `attitude` is not used.
    gyro_bias : array_like, shape (3,), optional
        rad/s, if it is known; IMU-TK takes the mean of the first rest. Else it is fitted too, to
        the moves and to all rests.
    sensitivity : bool
        Whether the gyros may feel force: measured = (I + K) true + bias + G force, nine numbers
        more. Many small ones do, by a milliradian a second for 1 g.

    Returns
    -------
    PoseCalibration
        Estimates with their covariance, residuals and tests.

    Raises
    ------
    ValueError
        If the record has no accelerometers or no gravity, a rest or pair is not one of the record,
        the poses leave some numbers in the dark and no `prior` is given, or the fit does not
        settle.

    Warns
    -----
    InconsistentWarning
        If the accelerometers show quite another gravity at rest.

    See Also
    --------
    driftlab.recordings.rests : The rests of a record.
    calibrate : On a turntable.
    to_json : Keep what was found.

    Notes
    -----
    Least squares for 21 numbers at once: L (6 numbers, three being fixed by the choice of axes) and
    the accelerometers' bias from :math:`|(I + L)^{-1} (f - b)| = g` at each rest; K and the gyros'
    bias from the two components of

    .. math:: C_{ij}^T u_i - u_j

    across the gravity u for each move from i to j; the bias from the gyros at rest as well. The
    attitude C over a move is integrated from the compensated increments, and errors dK, db that are
    left turn it by the vector (in the axes of the beginning)

    .. math:: -\int C\,(I + K)^{-1} (dK\,\omega + db)\, dt.

    The covariance of the residuals counts that a rest takes part in two moves. Where the residuals
    of one kind are larger than noise allows (0.975 quantile), a deviation is added to each of that
    kind, so that they fit (random effects, as Paule and Mandel have it); without this the stated
    deviations of real units would be many times too small. See `PoseCalibration.consistency`.

    Over a closed path the turn itself must vanish, all three components. For k whole turns about
    one axis n, C turns about n, so that all in the integral that stands across n adds up to
    nothing, and along n it is :math:`-2 \pi k\, n^T dK\, n`: the turn left over, by
    :math:`2 \pi k`, is the estimate of n^T Sigma n of `driftlab.drift.turn_estimate`, Larin (3.3).

    The Earth's rate is in all rests and moves, one vector of known size and unknown direction, and
    the covariance counts it as that: turned into the body as the gyros have it, with a variance of
    a third of its square along each axis of the first rest. So neither the bias nor K takes it for
    its own; the bias is that of the gyros without the Earth.

    Noise is taken for white from half a second on. If it is slower, the deviations of K and L are
    too small: by some ten per cent in most simulations, L's by half in some. The biases are means
    over the session, and so are their deviations: of another session's they say nothing.

    References
    ----------
    - F. Ferraris, U. Grimaldi, M. Parvis, *Procedure for effortless in-field calibration of
      three-axis rate gyros and accelerometers*, Sensors and Materials 7, 1995.
    - D. Tedaldi, A. Pretto, E. Menegatti, *A robust and easy to implement method for IMU
      calibration without external equipments*, IEEE International Conference on Robotics and
      Automation, 2014.

    Examples
    --------
    Twelve turns by hand about random axes, with a rest of two seconds before each and at the end:

    >>> from driftlab.attitude import integrate
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> from driftlab.increments import Increments, measure
    >>> from driftlab.quaternion import rotate
    >>> rng, dt, second = np.random.default_rng(1), 0.01, np.arange(100) / 100
    >>> angle = np.zeros((3800, 3))
    >>> for begin in range(200, 3800, 300):
    ...     turn = rng.uniform(-2.5, 2.5, 3)  # rad
    ...     angle[begin : begin + 100] = dt * turn * (1 - np.cos(2 * np.pi * second))[:, np.newaxis]
    >>> attitude = integrate(angle, "memory-4")
    >>> velocity = dt * rotate(attitude * [-1, -1, -1, 1], [0, 0, 9.81])
    >>> unit = TYPICAL_ERRORS._replace(gyro_error=0.01 * rng.standard_normal((3, 3)))
    >>> _, angle, velocity = measure(Increments(dt, angle, velocity), unit, ImuNoise(), rng)
    >>> log = Recording(angle, velocity, dt, "increments")
    >>> rows = [(begin, begin + 190) for begin in range(5, 3800, 300)]
    >>> found = calibrate_by_poses(log, rows, gravity=9.81, body_axes="averaged accelerometers")
    >>> error = found.imu_errors.gyro_error - unit.gyro_error
    >>> bool(np.abs(error).max() < 1e-4), found.consistency["moves"].holds
    (True, True)
    """
    checked_instance(recording, Recording, "recording")
    one_of(body_axes, POSE_AXES, "body_axes")
    truth_value(sensitivity, "sensitivity")
    rows = _checked_rows(recording, rests)
    pairs = _checked_pairs(closed, len(rows))
    assumed = _gravity(recording, gravity)
    poses = _poses(recording, rows, assumed, pairs, sensitivity)
    warn_of_gravity(poses)
    variances, colour = noise_of_rests(recording, rows, poses, noise)
    known = None if gyro_bias is None else finite_arrays(gyro_bias=(gyro_bias, 3))[0]
    if known is not None and known.ndim != 1:
        raise ValueError(f"gyro_bias: expected shape (3,), got shape {known.shape}.")
    fit = fit_poses(poses, variances, prior, known)
    state = _state(fit.unknowns, body_axes)
    step = 1e-6
    moved = fit.unknowns + step * np.concatenate([np.eye(core.UNKNOWNS), -np.eye(core.UNKNOWNS)])
    ahead, back = np.split(_state(moved, body_axes), 2)
    change = (ahead - back).T / (2 * step)
    covariance = change @ fit.covariance @ change.T
    force_error, _, gyro_error, _, felt = core.matrices(fit.unknowns)
    return PoseCalibration(
        _imu_errors(state),
        body_axes,
        FULL.names[6:],
        covariance,
        _imu_errors(np.sqrt(np.maximum(covariance.diagonal(), 0.0))),
        felt @ _turn(force_error, gyro_error, body_axes).T,
        np.sqrt(fit.covariance.diagonal()[core.SENSITIVITY]).reshape(3, 3),
        assumed,
        fit.force,
        fit.turn,
        fit.rate,
        fit.consistency,
        colour,
        float(np.diff(poses.edges).max() * poses.interval),
        fit.iterations,
    )


def _state(unknowns: FloatArray, body_axes: str) -> FloatArray:
    """The 24 numbers in the chosen axes, of unknowns (..., 21)."""
    force_error, force_bias, gyro_error, gyro_bias, _ = core.matrices(unknowns)
    turn = _turn(force_error, gyro_error, body_axes)
    errors = ImuErrors(
        gyro_bias,
        change_body_frame(gyro_error, turn),
        force_bias,
        change_body_frame(force_error, turn),
    )
    return FULL.state(errors)[..., 6:]


def _turn(force_error: FloatArray, gyro_error: FloatArray, body_axes: str) -> FloatArray:
    if body_axes == "lower triangle accelerometers":
        return body_frame_rotation(force_error, frame="lower triangle")
    return body_frame_rotation(gyro_error, force_error, body_axes)


def _imu_errors(numbers: FloatArray) -> ImuErrors:
    return FULL.imu_errors(np.concatenate([np.zeros(6), numbers]))


def _gravity(recording: Recording, given: float | None) -> float:
    if given is not None:
        return one_pull(given)
    if recording.gravity is not None:
        return recording.gravity
    if recording.latitude is not None:
        return float(normal_gravity(recording.latitude))
    raise ValueError(
        "gravity: expected m/s^2, because the record knows neither gravity nor latitude, got none."
    )


def _checked_rows(
    recording: Recording, rests: Rests | Sequence[tuple[int, int]]
) -> list[tuple[int, int]]:
    if recording.accelerometer is None:
        raise ValueError("recording: expected one with accelerometers, got one without.")
    given = rests.rows if isinstance(rests, Rests) else rests
    rows = [(int(begin), int(end)) for begin, end in whole_pairs(given, "rests")]
    if len(rows) < 2:
        raise ValueError(
            f"rests: expected at least two, with a move between them, got {len(rows)}."
        )
    after = 0
    for begin, end in rows:
        if not after <= begin < end - 1 < len(recording):
            raise ValueError(
                f"rests: expected rows in order, two at least each, of the {len(recording)} of the "
                f"record, got {begin} to {end} after {after}."
            )
        after = end
    return rows


def _checked_pairs(closed: Sequence[tuple[int, int]], count: int) -> list[tuple[int, int]]:
    pairs = []
    for i, j in whole_pairs(closed, "closed").tolist():
        if not 0 <= i < j < count:
            raise ValueError(
                f"closed: expected pairs of rests 0 to {count - 1}, the earlier one first, "
                f"got ({i}, {j})."
            )
        pairs.append((i, j))
    return pairs


def _poses(
    recording: Recording,
    rows: list[tuple[int, int]],
    gravity: float,
    closed: list[tuple[int, int]],
    sensitivity: bool,
) -> core.Poses:
    assert recording.accelerometer is not None
    share = 1.0 if recording.kind == "rates" else 1 / recording.interval
    begin, end = np.array(rows).T
    if recording.kind == "rates":
        # Increments of rates lie between samples, equally spaced even where the stamps are not.
        end = end - 1
        if recording.times is not None:
            since = (recording.times - recording.times[0]) / recording.interval
            begin, end = np.rint(since[begin]).astype(int), np.rint(since[end]).astype(int)
    moves = [slice(first, last) for first, last in zip(end[:-1], begin[1:], strict=True)]
    angle = recording.angles()
    velocity = recording.increments().velocity if sensitivity else None
    way, algorithm = np.concatenate([angle[move] for move in moves]), CONING_ALGORITHMS["memory-4"]
    if len(way) < algorithm.window:
        raise ValueError(f"rests: expected moves between them, got {len(way)} rows of moves.")
    at_once = [i for i, j in closed if j == i + 1]
    return core.Poses(
        np.array([share * recording.accelerometer[b:e].mean(axis=0) for b, e in rows]),
        np.array([share * recording.gyro[b:e].mean(axis=0) for b, e in rows]),
        way,
        None if velocity is None else np.concatenate([velocity[move] for move in moves]),
        recording.interval,
        np.cumsum([0, *(len(angle[move]) for move in moves)]),
        gravity,
        np.array(closed, int).reshape(-1, 2),
        np.setdiff1d(np.arange(len(rows) - 1), at_once),
        algorithm.steps,
    )
