"""Heading error of an aligned compass by sensor error: to first order term by term, and exactly."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree, g, hour, milli

from driftlab.book.machinery.figure.data_table import DataTable
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
"""Parts of the heading error, their sum and the exact error."""


def alignment_budget(
    latitude: float = SARATOV_LATITUDE,
    heading: float = HEADING,
    pitch: float = PITCH,
    roll: float = ROLL,
    gyro_bias: ArrayLike = GYRO_BIAS,
    accelerometer_bias: ArrayLike = ACCELEROMETER_BIAS,
) -> DataTable:
    """Align a compass that has sensor errors; exact, and by (alignment heading), pitch and roll.

    Biases are given forward, up, right. In a vertical body heading and roll have no errors of their
    own; theirs are then NaN.
    """
    gyro_biases = finite_array(gyro_bias, "gyro_bias", 3)
    accelerometer_biases = finite_array(accelerometer_bias, "accelerometer_bias", 3)
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
    turned = np.linalg.norm(alignment_attitude_error(place, local[0][-1], local[1][-1]))
    away = rotation_angle(multiply(found.attitude[-1], conjugate(attitude[-1])))
    error = np.append(formula.heading_terms[-1], [formula.heading[-1], gaps[0][-1]])
    both = "first order and exact"
    return DataTable(
        {
            "term": (TERMS, "", "part of the heading error"),
            "error": (error, "deg", "heading error by term"),
            "at_heading": (headings, "deg", "to which the same compass is turned"),
            "first_order": (formula.heading[:-1], "deg", "heading error there to first order"),
            "exact": (gaps[0][:-1], "deg", "exact heading error there"),
            "this_heading": (every[-1:], "deg", "heading of the compass"),
            "this_error": (error[-1:], "deg", "its exact error"),
        },
        {
            "pitch": ((formula.pitch[-1], gaps[1][-1]), "deg", f"error of the pitch, {both}"),
            "roll": ((formula.roll[-1], gaps[2][-1]), "deg", f"error of the roll, {both}"),
            "latitude": ((formula.latitude[-1], gaps[3][-1]), "deg", f"of the latitude, {both}"),
            "attitude": ((turned, away), "deg", f"angle of the attitude error, {both}"),
        },
    )
