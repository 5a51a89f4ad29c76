"""A body turned right over: what its heading loses in the vertical, and what its attitude keeps."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    positive_number,
    whole_number,
)
from driftlab.frames import from_euler_angles, to_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle
from driftlab.vectors import wrap_angle

from .budget import ACCELEROMETER_BIAS, GYRO_BIAS, HEADING

BOXES = 32
"""With random sensor errors, for a picture that answers at once."""
ERRORS_SHOWN = 20
"""How many times too large the sensor errors are where the found attitude is drawn."""


class OverTheVertical(NamedTuple):
    """True angles, and root mean square errors of many alignments, over the angle of a turn."""

    # (n,), of the turn about the right axis, rad; the vertical is between two of them
    angles: FloatArray
    attitude: FloatArray  # (n, 4), body to North, Up, East
    heading: FloatArray  # (n,), true, rad
    pitch: FloatArray  # (n,), true, rad
    roll: FloatArray  # (n,), true, rad
    heading_error: FloatArray  # (n,), rad
    roll_error: FloatArray  # (n,), rad
    attitude_error: FloatArray  # (n,), rad
    # (n,), of heading + roll, rad; it is well defined while the bow is nearer to Up
    together_error: FloatArray
    runs: int  # number of alignments at each angle


class OverTheTop(NamedTuple):
    """A half turn of the bow as many boxes find it, and as one finds it whose errors are large."""

    true: OverTheVertical  # the motion, and the errors of `BOXES` boxes
    # (n, 4), attitude that one box finds with sensor errors `ERRORS_SHOWN` times the typical ones
    found: FloatArray
    found_heading: FloatArray  # (n,), rad


def turn_over(angles: ArrayLike, heading: float = HEADING, aside: float = 0.0) -> FloatArray:
    """Attitudes (n, 4) of a body that turns about its right axis until the bow is over the top.

    The bow misses the zenith by `aside`, the roll before the turn.
    """
    over = finite_array(angles, "angles")[:, np.newaxis] * np.array([0.0, 0.0, 1.0])
    start = from_euler_angles(finite_number(heading, "heading"), 0.0, finite_number(aside, "aside"))
    return multiply(start, from_rotation_vector(over))


def errors_over_the_vertical(
    heading: float = HEADING,
    aside: float = 0.0,
    step: float = float(np.radians(1.0)),
    runs: int = 400,
    latitude: float = SARATOV_LATITUDE,
    gyro_bias: float = float(np.abs(GYRO_BIAS).max()),
    accelerometer_bias: float = float(np.abs(ACCELEROMETER_BIAS).max()),
    seed: int = 9,
) -> OverTheVertical:
    """Align bodies with random sensor errors in all attitudes of a half turn of the bow."""
    rng = np.random.default_rng(seed)
    size = (whole_number(runs, "runs"), 1, 3)
    gyro = positive_number(gyro_bias, "gyro_bias") * rng.standard_normal(size)
    accelerometer = positive_number(accelerometer_bias, "accelerometer_bias")
    force_error = accelerometer * rng.standard_normal(size)
    place, apart = finite_number(latitude, "latitude"), positive_number(step, "step")
    angles = np.arange(apart / 2, np.pi, apart)
    attitude = turn_over(angles, heading, aside)
    true = to_euler_angles(attitude)
    # Half a turn and minus half a turn are the same; rounding would choose between them by chance.
    roll = np.where(np.isclose(true.roll, -np.pi), np.pi, true.roll)
    rate, force = static_imu(attitude, place)
    found = align(rate + gyro, force + force_error, heading_tolerance=np.inf)

    def spread(gap: FloatArray) -> FloatArray:
        return np.asarray(np.sqrt(np.mean(wrap_angle(gap) ** 2, axis=0)))

    away = rotation_angle(multiply(found.attitude, conjugate(attitude)))
    return OverTheVertical(
        angles,
        attitude,
        true.heading,
        true.pitch,
        roll,
        spread(found.heading - true.heading),
        spread(found.roll - roll),
        np.sqrt(np.mean(away**2, axis=0)),
        spread(found.heading + found.roll - true.heading - roll),
        runs,
    )


def over_the_top(heading: float = HEADING, aside: float = 0.0) -> OverTheTop:
    """Turn a box over, each half degree, and align it on the way."""
    true = errors_over_the_vertical(heading, aside, np.radians(0.5), BOXES)
    rate, force = static_imu(true.attitude, SARATOV_LATITUDE)
    found = align(
        rate + ERRORS_SHOWN * GYRO_BIAS,
        force + ERRORS_SHOWN * ACCELEROMETER_BIAS,
        heading_tolerance=np.inf,
    )
    return OverTheTop(true, found.attitude, found.heading)
