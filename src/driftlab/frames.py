"""Axes and angles of Part IV: North, Up, East; forward, up, right; heading, pitch, roll.

Heading is positive *about Up*, from North to West, as in the paper of Plotnikov and others; pitch
lifts the bow; roll is about the forward axis. The attitude is their product in this order and maps
body components to local ones. Most of the field counts headings the other way.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.core.quaternion import conjugate, rotate

from .checks import FloatArray, finite_arrays, positive_number, unit_quaternions
from .earth import EARTH_RADIUS, EARTH_RATE, checked_latitude

FROM_EAST_NORTH_UP: FloatArray = np.array([-0.5, -0.5, -0.5, 0.5])
"""Quaternion from East, North, Up to North, Up, East: every axis takes the next one's place."""
FROM_EAST_NORTH_UP.setflags(write=False)

_MOST_PITCH = np.radians(89.9)


class Angles(NamedTuple):
    """Heading, pitch and roll, each (...), rad; heading and roll within pi, pitch within pi/2."""

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray


def geographic_rate(
    latitude: ArrayLike, velocity: ArrayLike = (0.0, 0.0), radius: float = EARTH_RADIUS
) -> FloatArray:
    """Rate (..., 3) of the local axes against inertial space, in North, Up, East, rad/s.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad, not a pole.
    velocity : array_like, shape (..., 2)
        North and East, m/s.
    radius : float
        Of the Earth, m.
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


def attitude_from_angles(heading: ArrayLike, pitch: ArrayLike, roll: ArrayLike) -> FloatArray:
    """Quaternion (..., 4), body to North, Up, East, of angles (...) in rad."""
    angles = finite_arrays(heading=(heading,), pitch=(pitch,), roll=(roll,))
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


def angles_from_attitude(attitude: ArrayLike) -> Angles:
    """Heading, pitch and roll of attitudes (..., 4), body to North, Up, East.

    In a vertical body heading and roll turn about one line. Each alone is then arbitrary, and the
    three together are still the attitude.
    """
    turned = unit_quaternions(attitude, "attitude")
    up = rotate(conjugate(turned), np.array([0.0, 1.0, 0.0]))
    pitch, roll = pitch_and_roll(up)
    # With the roll taken out, the right axis is level and turned by the heading alone.
    level = np.stack([np.zeros_like(roll), np.sin(roll), np.cos(roll)], axis=-1)
    right = rotate(turned, level)
    return Angles(np.arctan2(right[..., 0], right[..., 2]), pitch, roll)


def pitch_and_roll(up: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pitch and roll (...) in rad from the direction Up (..., 3) in body axes."""
    # Not arcsin, which loses half of the digits near the vertical.
    pitch = np.arctan2(up[..., 0], np.hypot(up[..., 1], up[..., 2]))
    return pitch, np.arctan2(-up[..., 2], up[..., 1])


def refuse_vertical(pitch: FloatArray) -> None:
    """Refuse pitches (...) in rad within 0.1 degrees of the vertical."""
    worst = float(np.abs(pitch).max())
    if worst > _MOST_PITCH:
        raise ValueError(
            "pitch: expected at most 89.9 degrees, because heading and roll are one turn in a "
            f"vertical body, got {np.degrees(worst):.6g} degrees."
        )
