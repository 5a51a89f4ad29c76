"""A calibration as it is made: four mountings on a table, one turn in each, and the error."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, finite_array
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import turn_estimate
from driftlab.drift.weighing_designs import YATES_AXES
from driftlab.imu import NO_ERRORS
from driftlab.increments import measure
from driftlab.motion.turntable_rotation import TurntableRotation
from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)
from driftlab.triad import non_orthogonality

LATITUDE, TABLE_RATE = 37.5 * degree, 10 * degree
"""Where the table stands, if it stands on the Earth, and how fast it turns, rad/s."""
SAMPLES = 90
"""Moments of a turn."""
RESTS, MOVES = 8, 12
"""Moments in which the table rests after a turn, and in which the body is mounted anew."""
PERIOD = SAMPLES + RESTS + MOVES
"""Moments of a mounting."""


def mountings(error_matrix: ArrayLike, table: TurntableRotation) -> DataTable:
    """Turn a triad about Larin's four axes, and follow its computer; Larin (3.3).

    The table makes one even turn, counter-clockwise, about an upright axis. After each turn there
    is a rest, in which the body is mounted for the next one, if any; then the computer starts
    again.
    """
    bent = finite_array(error_matrix, "error_matrix", 3, 3)
    if table != TurntableRotation(abs(table.rate), latitude=table.latitude):
        raise ValueError(f"table: expected one even turn, counter-clockwise, got {table}.")
    turned = table.increments(YATES_AXES, SAMPLES)
    felt = measure(turned, NO_ERRORS._replace(gyro_error_matrix=bent)).angle  # (4, SAMPLES, 3)
    step = 2 * np.pi / SAMPLES
    true = step * np.arange(1, SAMPLES + 1)[:, np.newaxis] * YATES_AXES[:, np.newaxis]
    relative = np.tile([0.0, 0.0, 0.0, 1.0], (4, SAMPLES + 1, 1))
    computed = relative.copy()
    relative[:, 1:] = from_rotation_vector(true)
    computed[:, 1:] = cumulative_product(from_rotation_vector(felt))
    quaternion = multiply(conjugate(relative), computed)

    start = upright(YATES_AXES)[:, np.newaxis]
    error = np.zeros((4, PERIOD, 3))
    error[:, : SAMPLES + 1] = to_rotation_vector(quaternion)
    error[:, SAMPLES + 1 : SAMPLES + RESTS] = error[:, SAMPLES, np.newaxis]
    attitude = np.empty((4, PERIOD, 4))
    attitude[:, : SAMPLES + 1] = multiply(start, relative)
    attitude[:, SAMPLES + 1 :] = attitude[:, SAMPLES, np.newaxis]
    part = np.arange(1, MOVES + 1)[:, np.newaxis] / (MOVES + 1)
    for i in range(3):
        there = to_rotation_vector(multiply(conjugate(attitude[i, SAMPLES]), start[i + 1, 0]))
        moves = multiply(attitude[i, SAMPLES], from_rotation_vector(part * there))
        attitude[i, SAMPLES + RESTS :] = moves
    added = np.zeros((4, PERIOD, 3))
    added[:, :SAMPLES] = (felt - step * YATES_AXES[:, np.newaxis]) / step

    in_laboratory = rotate(attitude, error)
    moments = np.arange(4 * PERIOD - MOVES)  # after the last turn nothing is mounted
    vectors = np.zeros((4, len(moments), 3))
    for i, vector in enumerate(vectors):
        vector[i * PERIOD : i * PERIOD + SAMPLES] = in_laboratory[i, :SAMPLES]
        vector[i * PERIOD + SAMPLES :] = in_laboratory[i, SAMPLES]
    return DataTable(
        {
            "time": (table.duration / SAMPLES * moments, "s", "at an even rate"),
            "attitude": (attitude.reshape(-1, 4)[moments], "",
                         "body to laboratory, whose third axis is that of the table"),
            "error": (error.reshape(-1, 3)[moments], "rad",
                      "rotation vector from true to computed attitude, in body axes"),
            "vectors": (vectors, "rad", "errors of the four mountings in laboratory axes; after "
                        "its turn each keeps what is left"),
            "added": (rotate(attitude, added).reshape(-1, 3)[moments], "",
                      "false rate in laboratory axes, divided by the rate of the table"),
            "mounting": (moments // PERIOD, "", "0 to 3"),
            "turning": (moments % PERIOD < SAMPLES + RESTS, "",
                        "whether there is a turn, or the rest after it"),
        },
        {
            "ends": (PERIOD * np.arange(4) + SAMPLES, "", "moments at which the turns end"),
            "estimates": (turn_estimate(quaternion[:, -1], YATES_AXES), "mrad",
                          "turn estimates about Yates's axes"),
            "expected": (drift_coefficient(YATES_AXES, bent), "mrad",
                         "the same to first order in inertial space"),
            "sigma": (non_orthogonality(bent)[[0, 0, 1], [1, 2, 2]], "mrad", "true sigmas"),
            "error_matrix": (bent, "", "of the gyros"),
        },
    )  # fmt: skip


def upright(axes: ArrayLike) -> FloatArray:
    """Attitude (..., 4) that brings a body axis (..., 3) to the third axis by the shorter way."""
    n = finite_array(axes, "axes", 3)
    half_way = np.concatenate([np.cross(n, [0.0, 0, 1]), 1 + n[..., 2:]], axis=-1)
    return half_way / np.linalg.norm(half_way, axis=-1, keepdims=True)
