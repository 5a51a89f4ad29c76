"""An inertial unit on a turntable: its true motion, and the increments of ideal sensors.

The table stands on the rotating Earth; its centre does not move. The integrals of angular rate and
specific force over any interval are known in closed form, so nothing here is an integration of
anything else.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_number, one_quaternion, positive_number, whole_number
from driftlab.core.earth import gravity_north
from driftlab.core.quaternion import conjugate, from_rotation_vector, multiply, rotate
from driftlab.core.vectors import left_jacobian
from driftlab.earth import checked_latitude, earth_rate, gravity
from driftlab.increments import Increments

from .scheme import Scheme, checked_scheme
from .trajectory import Trajectory

_MOST = 2**31 - 1  # samples of a segment


class Segment(NamedTuple):
    """One pause or rotation of the table, with a constant rate against the Earth.

    Attributes
    ----------
    axis : ndarray, shape (3,)
        Unit vector in body axes.
    rate : float
        Rate about the axis, rad/s; zero in a pause.
    duration : float
        s.
    attitude : ndarray, shape (4,)
        Attitude at the beginning, body to East, North, Up.
    """

    axis: FloatArray
    rate: float
    duration: float
    attitude: FloatArray


def segments(scheme: Scheme | str, interval: float) -> list[Segment]:
    """Pauses and rotations of a scheme, each as long as a whole number of intervals.

    A rotation is slowed down, and a pause prolonged, until it ends with an interval.

    Parameters
    ----------
    scheme : Scheme or str
        The rotations.
    interval : float
        s.

    Returns
    -------
    list of Segment
        Pauses and rotations in turn, beginning and ending with a pause.

    Examples
    --------
    A pause of 1 s and a rotation of 9 s, in intervals of 2 s:

    >>> [segment.duration for segment in segments(Scheme("+90Z", dwell=1.0), interval=2.0)]
    [2.0, 10.0, 2.0]
    """
    seconds = positive_number(interval, "interval")

    def whole(duration: float) -> float:
        # A duration that is a whole number of intervals, but for rounding, is kept.
        return seconds * max(1, int(np.ceil(duration / seconds - 1e-6)))

    scheme = checked_scheme(scheme)
    attitude, row = scheme.start_attitude, []
    pause = whole(scheme.dwell)
    for axis, angle in scheme.turns:
        duration = whole(abs(angle) / scheme.rate)
        row.append(Segment(axis, 0.0, pause, attitude))
        row.append(Segment(axis, angle / duration, duration, attitude))
        attitude = multiply(attitude, from_rotation_vector(angle * axis))
    row.append(Segment(np.array([0.0, 0.0, 1.0]), 0.0, pause, attitude))
    return row


def turntable_trajectory(
    scheme: Scheme | str,
    latitude: float,
    interval: float,
    *,
    multiple_of: int = 1,
    altitude: float = 0.0,
) -> Trajectory:
    """Increments of ideal gyros and accelerometers on a turntable, in closed form.

    Parameters
    ----------
    scheme : Scheme or str
        Pauses and rotations of the table.
    latitude : float
        Latitude of the table, rad; not a pole.
    interval : float
        Sample interval, s.
    multiple_of : int
        Each pause and rotation is prolonged to a multiple of so many sample intervals.
    altitude : float
        Altitude of the table, m.

    Returns
    -------
    Trajectory
        Increments and attitudes of all intervals.

    Examples
    --------
    A quarter turn about Up lasts 9 s, and with the two pauses the Earth turns for 11 s:

    >>> latitude = np.radians(45.0)
    >>> turned = turntable_trajectory(Scheme("+90Z", dwell=1.0), latitude, interval=0.5)
    >>> print(f"{turned.increments.angle[:, 2].sum() - np.pi / 2:.6f}")
    0.000567
    >>> print(f"{11 * earth_rate(latitude)[2]:.6f}")
    0.000567
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    seconds = positive_number(interval, "interval")
    row = segments(scheme, whole_number(multiple_of, "multiple_of") * seconds)
    earth = earth_rate(place)
    force = _force(place, finite_number(altitude, "altitude"))
    parts = [_sense(segment, earth, force, seconds) for segment in row]
    angles, velocities, attitudes = (np.concatenate(part) for part in zip(*parts, strict=True))
    first = row[0].attitude[np.newaxis]
    return _at_one_place(
        Increments(seconds, angles, velocities), np.concatenate([first, attitudes]), place
    )


def _sense(
    segment: Segment, earth: FloatArray, force: FloatArray, interval: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Increments (n, 3) and (n, 3), and attitudes (n, 4) after them, of one segment."""
    count = segment.duration / interval
    if count > _MOST:
        raise ValueError(
            f"interval: expected at most {_MOST} samples of {segment.duration:g} s, "
            f"got {interval:g} s."
        )
    count = round(count)
    angles = segment.rate * interval * np.arange(count + 1)
    attitude = multiply(
        segment.attitude, from_rotation_vector(angles[:, np.newaxis] * segment.axis)
    )
    # A vector fixed to the Earth turns backwards in body axes, by the angle x in an interval.
    to_body = conjugate(attitude[:-1])
    x = segment.rate * interval
    seen = left_jacobian(-x * segment.axis)
    turned = (x * segment.axis) + interval * rotate(to_body, earth) @ seen.T
    pushed = interval * rotate(to_body, force) @ seen.T
    return turned, pushed, attitude[1:]


def static_trajectory(
    attitude: ArrayLike, latitude: float, interval: float, count: int, altitude: float = 0.0
) -> Trajectory:
    """Increments of ideal sensors of a unit at rest on the Earth, in one attitude.

    Parameters
    ----------
    attitude : array_like or Rotation, shape (4,)
        Body to East, North, Up; the quaternion need not be of unit norm.
    latitude : float
        rad; not a pole.
    interval : float
        Sample interval, s.
    count : int
        Number n of intervals.
    altitude : float
        m.

    Returns
    -------
    Trajectory
        n equal angle increments and n equal velocity increments.

    Examples
    --------
    >>> still = static_trajectory([0, 0, 0, 1], np.radians(30.0), interval=3600.0, count=1)
    >>> print(np.degrees(still.increments.angle[0]).round(3))  # one hour of the Earth's rotation
    [ 0.    13.026  7.521]
    """
    seconds = positive_number(interval, "interval")
    stood = one_quaternion(attitude, "attitude")
    up_axis = np.array([0.0, 0.0, 1.0])
    standing = Segment(up_axis, 0.0, whole_number(count, "count") * seconds, stood)
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    force = _force(place, finite_number(altitude, "altitude"))
    turned, pushed, attitudes = _sense(standing, earth_rate(place), force, seconds)
    return _at_one_place(
        Increments(seconds, turned, pushed),
        np.concatenate([standing.attitude[np.newaxis], attitudes]),
        place,
    )


def _force(latitude: float, altitude: float) -> FloatArray:
    """Specific force (3,) of what stands still, East, North, Up: gravity's opposite."""
    north = gravity_north(np.array(latitude), np.array(altitude))
    return -np.array([0.0, north, -gravity(latitude, altitude)])


def _at_one_place(increments: Increments, attitude: FloatArray, latitude: float) -> Trajectory:
    count = len(attitude)
    return Trajectory(
        increments,
        attitude,
        np.full(count, latitude),
        np.zeros((count, 2)),
        "East, North, Up",
    )
