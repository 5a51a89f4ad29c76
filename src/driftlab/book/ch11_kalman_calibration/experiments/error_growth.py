"""How four errors become a velocity: before a turn, in it and after it."""

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import ERROR_MODELS, free_transition, transition_of_increments
from driftlab.motion.scheme import Scheme
from driftlab.motion.turntable import turntable_trajectory

ONE_TURN = Scheme("+90X", ("East", "North", "Up"), dwell=60.0)
CAUSES = {
    "attitude East": ("tilt about East, 1″", arcsecond),
    "accelerometer bias y": ("accelerometer bias y, 5 µg", 5 * micro * g),
    "gyro bias x": ("gyro bias x, 0.01 °/h", 0.01 * degree / hour),
    "gyro scale x": ("gyro scale factor x, 5 ppm", 5 * micro),
}
"""States, what they are called in the picture, and their sizes in SI units."""
SECOND = 20
"""Increments."""


def error_growth(scheme: Scheme = ONE_TURN, latitude: float = TABLE_LATITUDE) -> DataTable:
    """Follow each error by the error equations while a table rests, turns and rests again."""
    model = ERROR_MODELS["averaged"]
    path = turntable_trajectory(scheme, latitude, 1 / SECOND, multiple_of=SECOND)
    free = free_transition(latitude, 1.0)
    states = np.stack([
        size * (np.array(model.names) == name) for name, (_, size) in CAUSES.items()
    ])  # fmt: skip
    north = [states[:, 4]]
    for first in range(0, len(path.increments.angle), SECOND):
        last = first + SECOND
        growth = transition_of_increments(
            model, free, path.attitude[first : last + 1 : 2], path.increments.part(first, last)
        )
        states = states @ growth.T
        north.append(states[:, 4])
    names = tuple(words for words, _ in CAUSES.values())
    turning = np.pi / 2 / scheme.rate
    return DataTable({
        "time": (np.arange(float(len(north))), "s", "since the start"),
        "velocity": (np.array(north).T, "mm_per_s", "velocity error North", names),
        "turn_begins": ([scheme.dwell], "s", "of the table"),
        "turn_ends": ([scheme.dwell + turning], "s", "likewise"),
    })  # fmt: skip
