"""Paths of the Cayley vector of a body that turns steadily: circles, and a line through zero."""

import numpy as np

from driftlab.attitude.cayley import cayley_vector, rotation_quaternion, shadow
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import positive_number, whole_number
from driftlab.quaternion import from_rotation_vector, multiply

MOMENTS = 241  # of two turns


def circles_of_steady_turns(nearest: float = 0.5, paths: int = 6) -> DataTable:
    """Follow vectors of dimension 4 of a body that turns twice about its third axis; (1.7).

    At their starts they lie across the axis, with the length `nearest`, in so many directions.
    """
    length, count = positive_number(nearest, "nearest"), whole_number(paths, "paths")
    turn = np.linspace(0.0, 4 * np.pi, MOMENTS)
    azimuth = 2 * np.pi * np.arange(count) / count
    start = length * np.stack([np.cos(azimuth), np.sin(azimuth), 0 * azimuth], axis=-1)
    # The rate is given in body axes, so the later turn is the right factor.
    turned = from_rotation_vector(turn[:, np.newaxis] * np.array([0.0, 0.0, 1.0]))
    path = cayley_vector(multiply(rotation_quaternion(start)[:, np.newaxis], turned))
    names = [f"{i}" for i in range(1, count + 1)]
    return DataTable(
        {
            "turn": (turn, "deg", "angle of the turn, two turns in all"),
            "path": (
                np.moveaxis(path, -1, 1), "", "Cayley vector, by its start and its component",
                (names, ("x", "y", "z")),
            ),
        },
        {
            "nearest": (length, "", "length of the vectors at their starts"),
            "shadow": (shadow(start[0]), "", "of the first start"),
        },
    )  # fmt: skip
