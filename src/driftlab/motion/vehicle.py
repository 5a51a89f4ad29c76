"""A vehicle on a spherical Earth, under way or at rest: motion and increments of ideal sensors.

A motion is given at equally spaced times: level velocity, heading, pitch and roll. Between two
times the velocity changes at a constant rate and the body turns at a constant rate, by the
shorter rotation. The angle increments then belong to the motion exactly, and the velocity
increments up to small terms: the fourth power of the angle of one interval, and the square of the
change of velocity over R.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_arrays,
    finite_number,
    one_pull,
    positive_number,
    unit_quaternions,
)
from driftlab.core.earth import local_axes
from driftlab.core.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)
from driftlab.earth import (
    EARTH_RADIUS,
    EARTH_RATE,
    checked_gravity,
    checked_latitude,
    gravity as normal_gravity,
)
from driftlab.frames import FROM_EAST_NORTH_UP, from_euler_angles, navigation_frame_rate
from driftlab.increments import Increments

from .trajectory import Trajectory


def vehicle_trajectory(
    latitude: float,
    velocity: ArrayLike,
    heading: ArrayLike,
    pitch: ArrayLike = 0.0,
    roll: ArrayLike = 0.0,
    *,
    interval: float,
    gravity: float | None = None,
    radius: float = EARTH_RADIUS,
) -> Trajectory:
    """Increments of ideal sensors on a vehicle that moves level over a spherical Earth.

    Parameters
    ----------
    latitude : float
        Latitude at the start, rad.
    velocity : array_like, shape (n + 1, 2)
        Velocity to the North and to the East at the ends of the intervals, m/s.
    heading : array_like, shape (n + 1,) or ()
        Angle about Up, from North to West, at the same times, rad.
    pitch : array_like, shape (n + 1,) or ()
        Angle of the forward axis above the horizon, rad.
    roll : array_like, shape (n + 1,) or ()
        Angle about the forward axis, rad.
    interval : float
        Sample interval, s.
    gravity : float, optional
        m/s^2, constant along the way; normal gravity of the start if not given.
    radius : float
        Radius of the Earth, m.

    Returns
    -------
    Trajectory
        True motion and increments.

    Raises
    ------
    ValueError
        Also if the way comes within 0.1 degrees of a pole.

    Examples
    --------
    Sixty seconds to the North at 10 m/s:

    >>> ride = vehicle_trajectory(0.7, np.tile([10.0, 0.0], (7, 1)), heading=0.0, interval=10.0)
    >>> print(f"{(ride.latitude[-1] - ride.latitude[0]) * EARTH_RADIUS:.3f}")
    600.000
    >>> print(f"{ride.increments.velocity[0, 2]:.4f}")  # to the East, against the Coriolis term
    -0.0094
    """
    seconds = positive_number(interval, "interval")
    radius = positive_number(radius, "radius")
    start = float(checked_latitude(finite_number(latitude, "latitude")))
    speed, *angles = finite_arrays(
        velocity=(velocity, 2), heading=(heading,), pitch=(pitch,), roll=(roll,)
    )
    if speed.ndim != 2 or len(speed) < 2:
        raise ValueError(f"velocity: expected shape (n + 1, 2), n > 0, got shape {speed.shape}.")
    for name, values in zip(("heading", "pitch", "roll"), angles, strict=True):
        if values.ndim > 1:
            raise ValueError(f"{name}: expected shape (n + 1,) or (), got shape {values.shape}.")
    attitude = from_euler_angles(*(np.broadcast_to(a, len(speed)) for a in angles))
    mean = 0.5 * (speed[1:] + speed[:-1])
    place = start + seconds / radius * _sums(mean[:, 0])
    checked_latitude(place)
    middle = 0.5 * (place[1:] + place[:-1])
    longitude = _sums(seconds * (mean[:, 1] / (radius * np.cos(middle)) + EARTH_RATE))
    to_inertial = multiply(
        multiply(local_axes(place, longitude), conjugate(FROM_EAST_NORTH_UP)), attitude
    )
    angle = to_rotation_vector(multiply(conjugate(to_inertial[:-1]), to_inertial[1:]))
    pull = float(normal_gravity(start)) if gravity is None else one_pull(gravity)
    force = _specific_force(middle, mean, np.diff(speed, axis=0) / seconds, pull, radius)
    halfway = multiply(to_inertial[:-1], from_rotation_vector(0.5 * angle))
    # Local axes in the middle of the interval, at whose components the force is known.
    centre = multiply(
        local_axes(middle, 0.5 * (longitude[1:] + longitude[:-1])), conjugate(FROM_EAST_NORTH_UP)
    )
    push = seconds * rotate(multiply(conjugate(halfway), centre), force)
    # The mean over an interval of a force that is constant in local axes while the body turns.
    push = push + np.cross(angle, np.cross(angle, push)) / 24
    return Trajectory(
        Increments(seconds, angle, push), attitude, place, speed.copy(), "North, Up, East"
    )


def _sums(values: FloatArray) -> FloatArray:
    """Running sums (n + 1,) of values (n,), zero first."""
    return np.concatenate([[0.0], np.cumsum(values)])


def _specific_force(
    latitude: FloatArray, velocity: FloatArray, rate: FloatArray, gravity: float, radius: float
) -> FloatArray:
    """Specific force (n, 3) in North, Up, East of a level motion with the velocity's `rate`."""
    # Local axes turn with the Earth and along the way, and the velocity is relative to the Earth.
    turn = navigation_frame_rate(latitude, velocity, radius) + navigation_frame_rate(latitude)
    moving = np.stack([velocity[:, 0], np.zeros(len(velocity)), velocity[:, 1]], axis=-1)
    change = np.stack([rate[:, 0], np.full(len(rate), gravity), rate[:, 1]], axis=-1)
    return change + np.cross(turn, moving)


def static_imu(
    attitude: ArrayLike, latitude: ArrayLike, gravity: ArrayLike | None = None
) -> tuple[FloatArray, FloatArray]:
    """Angular rate and specific force of a body at rest on the Earth, in body axes.

    Parameters
    ----------
    attitude : array_like or Rotation, shape (..., 4)
        Body to North, Up, East; the quaternions need not be of unit norm.
    latitude : array_like, shape (...)
        rad.
    gravity : array_like, shape (...), optional
        m/s^2; normal gravity of the latitude if not given.

    Returns
    -------
    rate : ndarray, shape (..., 3)
        rad/s.
    specific_force : ndarray, shape (..., 3)
        m/s^2.

    Examples
    --------
    >>> rate, force = static_imu([0, 0, 0, 1], np.radians(30.0))
    >>> print((np.degrees(rate[:2]) * 3600).round(3))  # North and Up, degrees per hour
    [13.026  7.521]
    >>> print(f"{force[1]:.4f}")
    9.7932
    """
    body, place, pull = finite_arrays(
        attitude=(unit_quaternions(attitude, "attitude"), 4),
        latitude=(latitude,),
        gravity=(normal_gravity(latitude) if gravity is None else gravity,),
    )
    checked_gravity(pull)
    lead = np.broadcast_shapes(body.shape[:-1], place.shape, pull.shape)
    to_body = np.broadcast_to(conjugate(body), (*lead, 4))
    up = pull[..., np.newaxis] * np.array([0.0, 1.0, 0.0])
    return rotate(to_body, navigation_frame_rate(place)), rotate(to_body, up)


def smooth_step(times: ArrayLike, begin: float, duration: float) -> FloatArray:
    """Rise from 0 to 1 with continuous first and second derivatives.

    Parameters
    ----------
    times : array_like, shape (...)
        s.
    begin : float
        Time at which the rise begins, s.
    duration : float
        Duration of the rise, s, positive.

    Returns
    -------
    ndarray, shape (...)
        0 before the rise and 1 after it, without unit.

    Examples
    --------
    >>> smooth_step([0.0, 10.0, 15.0, 20.0, 30.0], begin=10.0, duration=10.0)
    array([0. , 0. , 0.5, 1. , 1. ])
    """
    (time,) = finite_arrays(times=(times,))
    length = positive_number(duration, "duration")
    x = np.clip((time - finite_number(begin, "begin")) / length, 0.0, 1.0)
    return x**3 * (10 - 15 * x + 6 * x**2)
