"""Simulation of a gyrocompass on board: its errors while a ship rests, accelerates and turns.

The paper's formula is evaluated with the tilts and the yaw error that occur in the simulation.
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
    nonnegative_number,
    positive_number,
    truth_value,
)
from driftlab.core.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.frames import navigation_frame_rate, to_euler_angles
from driftlab.increments import Increments, checked_increments
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.vehicle import static_imu

from .alignment import align
from .heading_error import (
    OperatingHeadingError,
    coriolis_correction,
    operating_heading_error,
    speed_error,
)
from .levelling import LevelFrame, LevellingHistory, initial_level_frame, propagate_level_frame
from .levelling_loop import Gains

_MOST_TILT = 0.1  # rad: what an alignment leaves is small
_MOST_BIAS = 10 * EARTH_RATE  # no compass sees the Earth beside it


class HeadingErrors(NamedTuple):
    """Errors of a compass under way, computed minus true, at n times.

    Attributes
    ----------
    times : ndarray, shape (n,)
        From the start, s.
    heading_error : ndarray, shape (..., n)
        rad; the speed error is removed: the true one, or with a log the one that it tells.
    speed_error : ndarray, shape (n,)
        The true speed error, rad.
    formula : OperatingHeadingError
        The paper's formula for the heading error, less the proportional part; each term (..., n).
    tilt : ndarray, shape (..., n, 2)
        Of the horizon about North and about East, rad.
    yaw_error, compass_error : ndarray, shape (..., n)
        Errors of the two parts of the heading, yaw and compass angle, rad. From the latter the
        speed error is removed.
    """

    times: FloatArray
    heading_error: FloatArray
    speed_error: FloatArray
    formula: OperatingHeadingError
    tilt: FloatArray
    yaw_error: FloatArray
    compass_error: FloatArray


def simulate_gyrocompass(
    trajectory: Trajectory,
    gyro_bias_body: ArrayLike,
    accelerometer_bias_body: ArrayLike = (0.0, 0.0, 0.0),
    *,
    tuning_factor: float = 1.0,
    damping: float = 0.0,
    tilt: float = 0.0,
    speed_log: bool = False,
    speed_log_error: ArrayLike = (0.0, 0.0),
) -> HeadingErrors:
    """Align a compass at the start of a voyage, operate it under way, and return its errors.

    Parameters
    ----------
    trajectory : Trajectory
        Of a vehicle: true motion, and the increments of ideal sensors.
    gyro_bias_body : array_like, shape (..., n, 3) or (3,)
        In body axes, for each interval or for all, rad/s. A bias may drift. In the mean at most
        ten times the Earth's rate, 150 deg/h.
    accelerometer_bias_body : array_like, shape (3,)
        In body axes, m/s^2.
    tuning_factor : float
        k2 R: 1 is Schuler's tuning.
    damping : float
        Damping ratio of the horizon.
    tilt : float
        Error of the aligned horizon about East, rad, at most 0.1.
    speed_log : bool
        Whether a log tells the velocity, and the latitude is known. The computation then subtracts
        `coriolis_correction` from the specific force and rotates in azimuth with the meridian. It
        damps by the specific force less that which the log explains (velocity damping), so that
        accelerations do not disturb the horizon.
    speed_log_error : array_like, shape (n + 1, 2) or (2,)
        Of the log's velocity, North and East, at each of the trajectory's times or at all, m/s.

    Returns
    -------
    HeadingErrors
        Errors (..., n) at the end of each interval.

    Raises
    ------
    ValueError
        If the shapes of the biases or of the log's error do not fit the trajectory, if there is an
        error and no log, if bias or tilt are too large, if the axes are not North, Up, East, and as
        in `propagate_level_frame`.

    See Also
    --------
    operating_heading_error : The formula beside it.
    driftlab.motion.vehicle_trajectory : Makes the voyage.
    marine_type_test : The tests of the standards.

    Examples
    --------
    An east gyro with a bias of 0.01 degrees per hour makes the same heading error at rest as the
    formula says, here in arc minutes:

    >>> from driftlab.motion.vehicle import vehicle_trajectory
    >>> still = vehicle_trajectory(np.radians(60.0), np.zeros((101, 2)), 0.0, interval=1.0)
    >>> errors = simulate_gyrocompass(still, np.radians([0.0, 0.0, 0.01]) / 3600)
    >>> found = errors.heading_error, errors.formula.heading
    >>> [round(60 * float(np.degrees(error[-1])), 2) for error in found]
    [4.57, 4.57]
    """
    checked_instance(trajectory, Trajectory, "trajectory")
    if trajectory.local_axes != "North, Up, East":
        raise ValueError(
            "trajectory: expected local axes North, Up, East, as of vehicle_trajectory, "
            f"got {trajectory.local_axes}."
        )
    interval, angle, velocity = checked_increments(trajectory.increments)
    gyro_bias = finite_array(gyro_bias_body, "gyro_bias_body", 3)
    accelerometer_bias = finite_array(accelerometer_bias_body, "accelerometer_bias_body", 3)
    if (gyro_bias.ndim > 1 and gyro_bias.shape[-2:] != angle.shape) or accelerometer_bias.ndim > 1:
        raise ValueError(
            "gyro_bias_body, accelerometer_bias_body: expected shapes "
            f"(..., {len(angle)}, 3) or (3,) and (3,), "
            f"got {gyro_bias.shape} and {accelerometer_bias.shape}."
        )
    biases = np.broadcast_to(gyro_bias, (*gyro_bias.shape[:-2], *angle.shape))
    largest = float(np.abs(biases.mean(axis=-2)).max())
    if largest > _MOST_BIAS:
        raise ValueError(
            "gyro_bias_body: expected rad/s, in the mean at most ten times the Earth's rate, "
            f"{_MOST_BIAS:.3g}, got {largest:.3g}. Is it in deg/h?"
        )
    stiffness = positive_number(tuning_factor, "tuning_factor")
    ratio = nonnegative_number(damping, "damping")
    lean = finite_number(tilt, "tilt")
    if abs(lean) > _MOST_TILT:
        raise ValueError(f"tilt: expected rad, at most {_MOST_TILT:g}, got {lean:g}.")
    truth_value(speed_log, "speed_log")
    latitude = float(trajectory.latitude[0])
    pull = float(gravity(latitude))
    rate, up = static_imu(trajectory.attitude[0], latitude)
    # Whoever puts errors in need not be warned of them.
    aligned = align(rate + biases[..., 0, :], up + accelerometer_bias, heading_tolerance=np.inf)
    start = initial_level_frame(aligned)
    leaning = np.array([0.0, 0.0, -lean])
    bent = multiply(from_rotation_vector(leaning), start.attitude)
    swing = float(np.sqrt(pull / EARTH_RADIUS * stiffness))
    gains = Gains(2 * ratio * swing / pull, stiffness / EARTH_RADIUS)
    pushed = velocity + interval * accelerometer_bias
    azimuth_rate = np.broadcast_to(
        (EARTH_RATE * np.sin(aligned.latitude))[..., np.newaxis], biases.shape[:-1]
    )
    told = trajectory.velocity + _checked_log_error(speed_log_error, speed_log, trajectory)
    if speed_log:
        turning = navigation_frame_rate(trajectory.latitude, told)
        azimuth_rate = 0.5 * (turning[1:, 1] + turning[:-1, 1])
        # The force that turns a tuned horizon as the log tells; in the main the acceleration.
        north, _, east = np.diff(turning, axis=0).T * EARTH_RADIUS / interval
        wanted = np.stack([-east, north], axis=-1)
        known = coriolis_correction(trajectory.latitude, told)
        hidden = _hidden_from_damping(wanted, gains, interval)
        # In body axes, like the specific force; the mean of both ends is that of the interval.
        to_body = conjugate(trajectory.attitude)
        begin, end = (
            rotate(to_body[part], np.insert(known[part] + hidden, 1, 0.0, axis=-1))
            for part in (slice(-1), slice(1, None))
        )
        pushed = pushed - interval * 0.5 * (begin + end)
    found = propagate_level_frame(
        LevelFrame(bent, start.rate),
        Increments(interval, angle + interval * biases, pushed),
        gains,
        azimuth_rate,
    )
    if speed_log:
        # The instrument integrates all of W, and its damping sees W - a: the same sum.
        integral = gains.integral * interval * np.cumsum(hidden, axis=0)
        found = found._replace(
            rate=found.rate + _turning(integral),
            proportional_rate=found.proportional_rate
            + _turning(gains.proportional * (hidden - wanted)),
        )
    return _errors_of(found, trajectory, biases, told)


def _turning(force: FloatArray) -> FloatArray:
    """Rates about North and East, (n, 2), by which a level force (n, 2) turns the horizon."""
    return np.stack([force[:, 1], -force[:, 0]], axis=-1)


def _checked_log_error(
    speed_log_error: ArrayLike, speed_log: bool, trajectory: Trajectory
) -> FloatArray:
    error = finite_array(speed_log_error, "speed_log_error", 2)
    if error.ndim > 1 and error.shape != trajectory.velocity.shape:
        raise ValueError(
            f"speed_log_error: expected shape {trajectory.velocity.shape} or (2,), "
            f"got {error.shape}."
        )
    if error.any() and not speed_log:
        raise ValueError("speed_log_error: expected zeros without a log, got an error of one.")
    return error


def _hidden_from_damping(wanted: FloatArray, gains: Gains, interval: float) -> FloatArray:
    """Return the part c (n, 2) of a wanted force a that the damping must not see.

    With c subtracted from the specific force W, the correction k1 (W - c) + k2 ∫(W - c) dt shall
    be k1 (W - a) + k2 ∫W dt. Hence k1 c + k2 ∫c dt = k1 a: c is a through a high-pass filter, here
    in the steps in which `propagate_level_frame` sums.
    """
    from scipy.signal import lfilter  # takes a third of a second to be loaded

    k1, k2 = gains
    now = k1 + 0.5 * interval * k2
    fading = [1.0, interval * k2 / now - 1.0]
    hidden: FloatArray = lfilter([k1 / now, -k1 / now], fading, wanted, axis=0)
    return hidden


def _errors_of(
    found: LevellingHistory, trajectory: Trajectory, gyro_bias: FloatArray, told: FloatArray
) -> HeadingErrors:
    """Errors of the computed heading and horizon, and those that the formula predicts."""
    true = trajectory.attitude[1:]
    # Turned by minus the vector that turns the components.
    tilt = -to_rotation_vector(multiply(found.attitude, conjugate(true)))[..., [0, 2]]
    heading, pitch, _ = to_euler_angles(true)
    speed_errors = speed_error(trajectory.latitude[1:], trajectory.velocity[1:])
    removed = speed_error(trajectory.latitude[1:], told[1:])
    compass_error = wrap_angle(found.compass_angle - removed)
    yaw_error = wrap_angle(found.yaw_pitch_roll.heading - heading)
    # Of means over intervals those at their ends, like the central differences of the tilt.
    unread = found.proportional_rate.copy()
    unread[..., :-1, :] = 0.5 * (unread[..., :-1, :] + unread[..., 1:, :])
    formula = operating_heading_error(
        trajectory.latitude[1:],
        trajectory.velocity[1:],
        tilt,
        np.gradient(tilt, trajectory.increments.interval, axis=-2),
        rotate(true, gyro_bias)[..., [0, 2]],
        yaw_error,
        heading=heading,
        pitch=pitch,
        proportional_rate=unread,
    )
    return HeadingErrors(
        times=trajectory.times[1:],
        heading_error=yaw_error + compass_error,
        speed_error=speed_errors,
        formula=formula,
        tilt=tilt,
        yaw_error=yaw_error,
        compass_error=compass_error,
    )
