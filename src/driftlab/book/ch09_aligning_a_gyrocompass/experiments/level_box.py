"""A level box carried from the equator to the North, and what one gyro's error does to it there."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_number
from driftlab.frames import from_euler_angles, navigation_frame_rate
from driftlab.gyrocompass.alignment import align
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import rotate
from driftlab.vectors import wrap_angle

FARTHEST = float(np.radians(88.0))
"""Latitude at which the way ends, rad."""
MAGNIFIED = 200
"""How many times too large the gyro's error is where it is drawn beside the Earth's rate."""


class LevelBox(NamedTuple):
    """A level box at n latitudes."""

    latitude: FloatArray  # (n,), rad
    attitude: FloatArray  # (4,), body to North, Up, East, everywhere
    earth_rate: FloatArray  # (n, 3), in North, Up, East, rad/s
    gyro_bias: FloatArray  # (3,), in North, Up, East, rad/s
    heading_error: FloatArray  # (n,), of the alignment, computed minus true, rad
    magnified_error: FloatArray  # (n,), the same with the gyros' error `MAGNIFIED` times as large


def level_box(heading: float, gyro_bias: ArrayLike) -> LevelBox:
    """Align a level box at each quarter of a degree from the equator to `FARTHEST`.

    The gyro bias is given forward, up, right.
    """
    true = finite_number(heading, "heading")
    bias = finite_array(gyro_bias, "gyro_bias", 3)
    latitude = np.arange(0.0, FARTHEST + 1e-9, np.radians(0.25))
    attitude = from_euler_angles(true, 0.0, 0.0)
    rate, force = static_imu(attitude, latitude)
    once, magnified = (
        wrap_angle(align(rate + factor * bias, force, heading_tolerance=np.inf).heading - true)
        for factor in (1, MAGNIFIED)
    )
    return LevelBox(
        latitude,
        attitude,
        navigation_frame_rate(latitude),
        rotate(attitude, bias),
        once,
        magnified,
    )
