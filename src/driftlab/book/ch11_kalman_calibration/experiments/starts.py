"""Four starts of a unit at rest: what its computer takes for the attitude of its body axes."""

import numpy as np

from driftlab.body_frames import body_frame_rotation
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.body_axes import attitude_of_axes, imu_errors_in_frame
from driftlab.checks import FloatArray
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.imu import ImuErrors
from driftlab.increments import compensate, measure
from driftlab.motion.turntable import static_trajectory

TABLE_ATTITUDE: FloatArray = np.array([0.0, 0.0, 0.0, 1.0])
"""Attitude in which the units stand: the table's axes are East, North, Up."""
STARTS = ("one attitude", "the table's axes")
"""What the computers take for their attitude at the start. One attitude: both believe the same of
the unit, each in its own axes."""
ALL_STARTS = (STARTS[0], "its own sensors", "its own true axes", STARTS[1])
"""The same; the attitude that each computer finds from its own calibrated sensors; and the exact
attitude of each computer's own axes."""


def own_axes(imu_errors: ImuErrors, frame: str) -> FloatArray:
    """Exact attitude (..., 4) of a unit's body axes while it stands in `TABLE_ATTITUDE`."""
    _, turn = imu_errors_in_frame(imu_errors, frame)
    return attitude_of_axes(TABLE_ATTITUDE, turn)


def one_attitude(imu_errors: ImuErrors, found: ImuErrors, frame: str) -> FloatArray:
    """Attitude (..., 4) of body axes that says the same of a unit as that of its averaged axes.

    The way between the two is what the calibration has found in averaged axes; the true errors
    would bring in what it has left over.
    """
    own = own_axes(imu_errors, "averaged")
    if frame == "averaged":
        return own
    turn = body_frame_rotation(found.gyro_error_matrix, found.accelerometer_error_matrix, frame)
    return attitude_of_axes(own, turn)


def self_aligned(imu_errors: ImuErrors, found: ImuErrors) -> FloatArray:
    """Attitude (..., 4) that a computer finds from gravity and the Earth's rate, without noise."""
    still = static_trajectory(TABLE_ATTITUDE, TABLE_LATITUDE, 1.0, 2).increments
    sensed = compensate(measure(still, imu_errors), found)
    # `align` counts axes forward, up, right: y, z and x here.
    rate, force = (row.mean(axis=-2)[..., [1, 2, 0]] for row in (sensed.angle, sensed.velocity))
    # Whoever puts errors in need not be warned of them.
    angles = align(rate, force, heading_tolerance=np.inf)
    return from_euler_angles(angles.heading, angles.pitch, angles.roll)[..., [2, 0, 1, 3]]
