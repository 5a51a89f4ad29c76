"""A body turned right over: what its heading loses in the vertical, and what its attitude keeps."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, finite_array, finite_number, positive_number, whole_number
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
) -> DataTable:
    """Align bodies with random sensor errors in all attitudes of a half turn of the bow.

    The vertical lies between two of the angles.
    """
    rng = np.random.default_rng(seed)
    count = whole_number(runs, "runs")
    size = (count, 1, 3)
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

    def rms(gap: FloatArray) -> FloatArray:
        return np.asarray(np.sqrt(np.mean(wrap_angle(gap) ** 2, axis=0)))

    away = rotation_angle(multiply(found.attitude, conjugate(attitude)))
    much = rate + ERRORS_SHOWN * GYRO_BIAS, force + ERRORS_SHOWN * ACCELEROMETER_BIAS
    large = align(*much, heading_tolerance=np.inf)

    def angle(values: FloatArray, meaning: str) -> tuple[Any, ...]:
        return values, "deg", meaning, (), 7  # where the bow points up, roundings differ by machine

    error = "root mean square"
    return DataTable(
        {
            "angle": angle(angles, "angle of the turn about the right axis"),
            "true_heading": angle(true.heading, "heading of the body"),
            "true_roll": angle(roll, "roll of the body"),
            "true_pitch": angle(true.pitch, "pitch of the body"),
            "heading_error": angle(rms(found.heading - true.heading), error),
            "roll_error": angle(rms(found.roll - roll), error),
            "attitude_error": angle(np.sqrt(np.mean(away**2, axis=0)), error),
            # It is well defined while the bow is nearer to Up.
            "heading_and_roll_error": angle(
                rms(found.heading + found.roll - true.heading - roll),
                f"{error} of the error of their sum",
            ),
        },
        {
            "runs": (count, "", "alignments at each angle"),
            "attitude": (attitude, "", "body to North, Up, East"),
            "found": (large.attitude, "", "attitude found with large sensor errors"),
            "found_heading": (large.heading, "rad", "heading found with these"),
        },
    )


def over_the_top(heading: float = HEADING, aside: float = 0.0) -> DataTable:
    """Turn boxes over, each half degree, and align them on the way."""
    return errors_over_the_vertical(heading, aside, float(np.radians(0.5)), BOXES)
