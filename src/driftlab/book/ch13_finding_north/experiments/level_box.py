"""A level box carried from the equator to the North, and what one gyro's error does to it there."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import finite_array, finite_number
from driftlab.frames import from_euler_angles, navigation_frame_rate
from driftlab.gyrocompass.alignment import align
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import rotate
from driftlab.vectors import wrap_angle

FARTHEST = float(np.radians(88.0))
"""Latitude at which the way ends, rad."""
MAGNIFIED = 200
"""How many times too large the gyro's error is where it is drawn beside the Earth's rate."""


def level_box(heading: float, gyro_bias: ArrayLike) -> DataTable:
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

    def at(place: float) -> float:
        return float(np.interp(np.radians(place), latitude, once))

    return DataTable(
        {
            "latitude": (latitude, "deg", "latitude of the box"),
            "heading_error": (once, "arcmin", "computed minus true"),
            "magnified_error": (magnified, "deg", f"the same, gyros {MAGNIFIED} times worse"),
        },
        {
            "at_equator": (at(0.0), "arcmin", "at the equator"),
            "at_51_5": (at(51.5), "arcmin", "at 51.5°"),
            "at_85": (at(85.0), "arcmin", "heading error at 85°"),
            "attitude": (attitude, "", "body to North, Up, East, everywhere"),
            "earth_rate": (navigation_frame_rate(latitude), "rad_per_s", "in North, Up, East"),
            "gyro_bias": (rotate(attitude, bias), "rad_per_s", "in North, Up, East"),
        },
    )
