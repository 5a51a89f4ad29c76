"""Heading error of an aligned compass by sensor error: to first order term by term, and exactly."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree, g, hour, milli

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, finite_array, finite_number
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align, alignment_attitude_error, alignment_errors
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, multiply, rotate, rotation_angle
from driftlab.vectors import wrap_angle

GYRO_BIAS: FloatArray = np.array([0.02, 0.03, 0.03]) * degree / hour
"""Of three gyros, rad/s."""
ACCELEROMETER_BIAS: FloatArray = np.array([1.5, 1.0, -1.5]) * milli * g
"""Of three accelerometers, m/s^2."""
HEADING, PITCH, ROLL = (float(angle) for angle in np.radians([40.0, 30.0, 10.0]))
"""Of the compass, rad."""
TERMS = (
    "east gyro",
    "east acc., tan pitch",
    "north acc., tan pitch",
    "east acc., tan latitude",
    "sum, first order",
    "exact",
)
"""What the entries of `AlignmentBudget.bars` are."""


class AlignmentBudget(NamedTuple):
    """Errors of one aligned compass, and its heading error when it is turned to other headings."""

    # (6,), heading error, rad: the four terms of first order, their sum, and the exact error
    bars: FloatArray
    pitch: tuple[float, float]  # its error to first order, and exact, rad
    roll: tuple[float, float]  # likewise
    latitude: tuple[float, float]  # likewise
    # angle of the rotation from true to computed attitude, rad: to first order, and exact
    attitude: tuple[float, float]
    heading: float  # rad
    headings: FloatArray  # (n,), rad
    exact: FloatArray  # (n,), heading errors at these headings, rad
    first_order: FloatArray  # (n,), likewise


def alignment_budget(
    latitude: float = SARATOV_LATITUDE,
    heading: float = HEADING,
    pitch: float = PITCH,
    roll: float = ROLL,
    gyro_bias: ArrayLike = GYRO_BIAS,
    accelerometer_bias: ArrayLike = ACCELEROMETER_BIAS,
) -> AlignmentBudget:
    """Align a compass that has sensor errors; exact, and by (alignment heading), pitch and roll.

    Biases are given forward, up, right. In a vertical body heading and roll have no errors of their
    own; theirs are then NaN.
    """
    gyro_biases, accelerometer_biases = (
        finite_array(gyro_bias, "gyro_bias", 3),
        finite_array(accelerometer_bias, "accelerometer_bias", 3),
    )
    place = finite_number(latitude, "latitude")
    headings = np.radians(np.arange(-180.0, 180.1, 5.0))
    every = np.append(headings, finite_number(heading, "heading"))
    vertical = abs(finite_number(pitch, "pitch")) > np.radians(89.9)
    attitude = from_euler_angles(every, pitch, roll)
    rate, force = static_imu(attitude, place)
    true = align(rate, force)
    found = align(rate + gyro_biases, force + accelerometer_biases, heading_tolerance=np.inf)
    local = rotate(attitude, gyro_biases), rotate(attitude, accelerometer_biases)
    formula = alignment_errors(every, 0.0 if vertical else pitch, place, *local)
    gaps = [wrap_angle(a - b) for a, b in zip(found[:4], true[:4], strict=True)]
    if vertical:
        nothing = np.full_like(every, np.nan)
        formula = formula._replace(
            heading=nothing, roll=nothing, heading_terms=np.full((len(every), 4), np.nan)
        )
        gaps[0] = gaps[2] = nothing
    turned = alignment_attitude_error(place, local[0][-1], local[1][-1])
    return AlignmentBudget(
        np.append(formula.heading_terms[-1], [formula.heading[-1], gaps[0][-1]]),
        (float(formula.pitch[-1]), float(gaps[1][-1])),
        (float(formula.roll[-1]), float(gaps[2][-1])),
        (float(formula.latitude[-1]), float(gaps[3][-1])),
        (
            float(np.linalg.norm(turned)),
            float(rotation_angle(multiply(found.attitude[-1], conjugate(attitude[-1])))),
        ),
        float(heading),
        headings,
        gaps[0][:-1],
        formula.heading[:-1],
    )
