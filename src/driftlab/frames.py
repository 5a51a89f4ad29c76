"""Axes and angles of Part IV: North, Up, East; forward, up, right; heading, pitch, roll.

Heading is positive *about Up*, from North to West, as in the paper of Plotnikov and others; pitch
lifts the bow; roll is about the forward axis. The attitude is their product in this order and maps
body components to local ones. Most of the field counts headings the other way, from North to East,
and has other axes: `driftlab.axes` and `driftlab.conventions` convert.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.core.quaternion import conjugate, rotate

from .checks import FloatArray, finite_arrays, positive_number, turned_angle, unit_quaternions
from .earth import EARTH_RADIUS, EARTH_RATE, checked_latitude

FROM_EAST_NORTH_UP: FloatArray = np.array([-0.5, -0.5, -0.5, 0.5])
"""Quaternion from East, North, Up to North, Up, East: every axis takes the next one's place."""
FROM_EAST_NORTH_UP.setflags(write=False)

_MOST_PITCH = np.radians(89.9)


class EulerAngles(NamedTuple):
    """Heading, pitch and roll of a body.

    Attributes
    ----------
    heading : ndarray, shape (...)
        Angle about Up, from North to West, rad, -pi to pi.
    pitch : ndarray, shape (...)
        Angle of the forward axis above the horizon, rad, -pi/2 to pi/2.
    roll : ndarray, shape (...)
        Angle about the forward axis, rad, -pi to pi.
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray


def navigation_frame_rate(
    latitude: ArrayLike, velocity: ArrayLike = (0.0, 0.0), radius: float = EARTH_RADIUS
) -> FloatArray:
    """Angular rate of the local axes against inertial space, in North, Up, East.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad, not a pole.
    velocity : array_like, shape (..., 2)
        To the North and to the East, m/s.
    radius : float
        Of the Earth, m.

    Returns
    -------
    ndarray, shape (..., 3)
        Earth rate and transport rate together, rad/s.

    Examples
    --------
    At rest it is the rate of the Earth; a vehicle that goes North turns about West:

    >>> rate = navigation_frame_rate(np.radians(30.0), [[0.0, 0.0], [100.0, 0.0]])
    >>> (np.degrees(rate[1]) * 3600).round(2)  # degrees per hour
    array([13.03,  7.52, -3.24])
    """
    place, speed = finite_arrays(latitude=(latitude,), velocity=(velocity, 2))
    checked_latitude(place)
    speed = speed / positive_number(radius, "radius")
    north, east = speed[..., 0], speed[..., 1]
    return np.stack(
        np.broadcast_arrays(
            EARTH_RATE * np.cos(place) + east,
            EARTH_RATE * np.sin(place) + east * np.tan(place),
            -north,
        ),
        axis=-1,
    )


def from_euler_angles(heading: ArrayLike, pitch: ArrayLike, roll: ArrayLike) -> FloatArray:
    """Attitude of a body with a given heading, pitch and roll.

    Parameters
    ----------
    heading : array_like, shape (...)
        Angle about Up, from North to West, rad.
    pitch : array_like, shape (...)
        Angle of the forward axis above the horizon, rad.
    roll : array_like, shape (...)
        Angle about the forward axis, rad.

    Returns
    -------
    ndarray, shape (..., 4)
        Unit quaternions, body (forward, up, right) to North, Up, East.

    Examples
    --------
    With a heading of a quarter turn the forward axis points to the West:

    >>> attitude = from_euler_angles(np.pi / 2, 0.0, 0.0)
    >>> rotate(attitude, np.array([1.0, 0.0, 0.0])).round(9)
    array([ 0.,  0., -1.])
    """
    angles = finite_arrays(heading=(heading,), pitch=(pitch,), roll=(roll,))
    for name, angle in zip(("heading", "pitch", "roll"), angles, strict=True):
        turned_angle(angle, name)
    (c1, s1), (c2, s2), (c3, s3) = ((np.cos(a / 2), np.sin(a / 2)) for a in angles)
    # About Up by the heading, about the right axis by the pitch, about the forward one by the roll.
    return np.stack(
        [
            c1 * c2 * s3 + s1 * s2 * c3,
            s1 * c2 * c3 + c1 * s2 * s3,
            c1 * s2 * c3 - s1 * c2 * s3,
            c1 * c2 * c3 - s1 * s2 * s3,
        ],
        axis=-1,
    )


def to_euler_angles(attitude: ArrayLike) -> EulerAngles:
    """Heading, pitch and roll of an attitude.

    Parameters
    ----------
    attitude : array_like or Rotation, shape (..., 4)
        Quaternions, body (forward, up, right) to North, Up, East; they need not be of unit norm.

    Returns
    -------
    EulerAngles
        rad. In a vertical body heading and roll turn about the same line: each alone is then
        arbitrary, and the three together are still the attitude.

    Examples
    --------
    >>> angles = to_euler_angles([0, 1, 0, 1])  # a quarter turn about Up
    >>> print(f"{angles.heading:.4f}")
    1.5708
    """
    turned = unit_quaternions(attitude, "attitude")
    up = rotate(conjugate(turned), np.array([0.0, 1.0, 0.0]))
    pitch, roll = _pitch_and_roll(up)
    # With the roll taken out, the right axis is level and turned by the heading alone.
    level = np.stack([np.zeros_like(roll), np.sin(roll), np.cos(roll)], axis=-1)
    right = rotate(turned, level)
    return EulerAngles(np.arctan2(right[..., 0], right[..., 2]), pitch, roll)


def _pitch_and_roll(up: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pitch and roll (...), rad, from the direction Up (..., 3) in body axes, of any length."""
    # Not arcsin, which loses half of the digits near the vertical.
    pitch = np.arctan2(up[..., 0], np.hypot(up[..., 1], up[..., 2]))
    return pitch, np.arctan2(-up[..., 2], up[..., 1])


def checked_pitch(pitch: FloatArray) -> FloatArray:
    """Return pitch angles, rad, refusing the vertical, where heading is not defined."""
    worst = float(np.abs(pitch).max())
    if worst > _MOST_PITCH:
        raise ValueError(
            "pitch: expected at most 89.9 degrees, because heading and roll are one turn in a "
            f"vertical body, got {np.degrees(worst):.6g} degrees."
        )
    return pitch
