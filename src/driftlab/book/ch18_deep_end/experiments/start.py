"""The first steps of an algorithm with memory, started in three ways."""

import numpy as np

from driftlab.attitude import CONING_ALGORITHMS, step_quaternions
from driftlab.book.ch07_coning.experiments import SHIP
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import positive_number, whole_number
from driftlab.quaternion import conjugate, cumulative_product, multiply, rotation_angle

ALGORITHM = "memory-4"
STARTS = ("zero past", "no correction", "increments that follow")
"""How an algorithm with memory may begin."""


def first_steps(rate: float = 50.0, steps: int = 6) -> DataTable:
    """Error of the attitude after each of the first steps on the ship, read at `rate` Hz."""
    interval, count = 1 / positive_number(rate, "rate"), whole_number(steps, "steps", least=3)
    memory = CONING_ALGORITHMS[ALGORITHM].memory
    increments = SHIP.increments(interval, count)
    true = SHIP.attitude(interval * np.arange(count + 1))
    errors = {}
    for start in STARTS:
        past = {"history": np.zeros((memory, 3))} if start == "zero past" else {}
        rotations = step_quaternions(increments, ALGORITHM, **past)
        if start == "no correction":
            rotations[:memory] = step_quaternions(increments[:memory], "picard-1")
        found = multiply(true[0], cumulative_product(rotations))
        errors[start] = np.append(0.0, rotation_angle(multiply(conjugate(true[1:]), found)))
    return DataTable(
        {
            "step": (np.arange(count + 1), "", "steps since the start"),
            "error": (errors, "arcsec", "of the attitude, by the start"),
        },
        {"rate": (1 / interval, "Hz", "at which the gyros are read")},
    )
