"""A rod that is led round a part of the sphere while the gyro in it reads zero."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import positive_number, whole_number
from driftlab.quaternion import conjugate, cumulative_product, from_rotation_vector, rotate


def rod_round_the_sphere(along: float = float(np.radians(60.0)), points: int = 12) -> DataTable:
    """Lead a rod from the East along the horizon, up to the zenith, and straight back.

    It goes round the horizon by the angle `along`, in rad, and stops so often on each of the three
    legs. Each turn is about the axis across the leg's plane, so a gyro along the rod feels nothing.
    """
    angle, count = positive_number(along, "along"), whole_number(points, "points")
    up, right = np.pi / 2 * np.array([np.sin(angle), -np.cos(angle), 0.0]), [0.0, np.pi / 2, 0.0]
    turns = np.repeat(np.array([[0.0, 0.0, angle], up, right]) / count, count, axis=0)
    # About axes of the reference frame, so the later turn is the left factor: conjugates twice.
    attitude = conjugate(cumulative_product(conjugate(from_rotation_vector(turns))))
    attitude = np.concatenate([[[0.0, 0.0, 0.0, 1.0]], attitude])
    tip, mark = (rotate(attitude, np.eye(3)[i]) for i in (0, 2))
    return DataTable(
        {
            "tip": (tip.T, "", "of the rod, East, North and up", ("east", "north", "up")),
            "mark": (mark.T, "", "direction of a mark on the rod", ("east", "north", "up")),
        },
        {"along": (angle, "deg", "way round the horizon, and the solid angle inside")},
    )
