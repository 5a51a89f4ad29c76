"""The puzzle of chapter 10: two perfect laboratories measure one unit."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.body_frames import change_body_frame
from driftlab.imu import TYPICAL_ERRORS
from driftlab.quaternion import from_rotation_vector, rotate

from ..machinery.exercise.puzzle import Number, Puzzle

SEEN = 0.1 * arcsecond
"""What differs by less is the same on a laboratory's sheet."""


def numbers_alike() -> float:
    """How many of the eighteen entries both laboratories report."""
    turned = from_rotation_vector(np.array([30.0, -15.0, 25.0]) * arcsecond)
    bracket = rotate(turned, np.eye(3))
    matrices = np.array(
        [TYPICAL_ERRORS.gyro_error_matrix, TYPICAL_ERRORS.accelerometer_error_matrix]
    )
    other = np.array([change_body_frame(matrix, bracket) for matrix in matrices])
    return float(np.count_nonzero(np.abs(matrices - other) < SEEN))


PUZZLE = Puzzle(
    chapter="10",
    edition=2,
    questions=(
        Number(
            asks="How many of the eighteen numbers come out the same?",
            unit="of 18",
            low=0,
            high=18,
            truth=numbers_alike,
            whole=True,
        ),
    ),
    says=(
        "Both laboratories are right to the last digit, and the unit has not changed on the way. "
        "So which of these numbers belong to the unit?"
    ),
)
