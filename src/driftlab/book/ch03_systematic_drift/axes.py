"""All axes of rotation as a globe: the drift about each, those without, and a way over it."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SYMMETRIC
from driftlab.checks import FloatArray, finite_array, nonzero_vectors, positive_number, whole_number
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.drift.systematic_drift import (
    drift_coefficient,
    drift_per_revolution,
    principal_drifts,
)
from driftlab.quaternion import to_rotation_vector
from driftlab.triad import measured_rate
from driftlab.vectors import direction_from_angles

from .experiments import EXAGGERATION, TURNS

FULL_COLOUR = 2e-3
"""Drift coefficient that has the full colour on the globe, if nothing else is said."""


def axis_tour(
    error_matrix: ArrayLike = 1e-3 * SYMMETRIC,
    direction: ArrayLike = (1.0, 0.0, 0.0),
    turns: int = TURNS,
    exaggeration: float = EXAGGERATION,
    full_colour: float = FULL_COLOUR,
) -> DataTable:
    """Take the axis of the turns from where it is through the worst axis, and once round."""
    count = whole_number(turns, "turns")
    factor = positive_number(exaggeration, "exaggeration")
    full = positive_number(full_colour, "full_colour")
    n, _ = nonzero_vectors(direction, "direction")
    error_matrix = finite_array(error_matrix, "error_matrix", 3, 3)
    principal, principal_axes = principal_drifts(error_matrix)
    worst = principal_axes[np.abs(principal).argmax()]
    # From the worst axis itself it leaves towards the one that drifts least.
    goal = worst if abs(n @ worst) < 1 - 1e-9 else principal_axes[np.abs(principal).argmin()]
    ahead = goal - (goal @ n) * n
    ahead /= np.linalg.norm(ahead)
    way = np.linspace(0, 2 * np.pi, 361)
    axes = np.cos(way)[:, np.newaxis] * n + np.sin(way)[:, np.newaxis] * ahead
    elevation = np.radians(np.arange(-82.5, 90, 15))[:, np.newaxis]
    azimuth = np.radians(np.arange(-172.5, 180, 15))
    faces = drift_coefficient(direction_from_angles(azimuth, elevation), error_matrix)
    error = error_quaternion(axes, measured_rate(axes, error_matrix), 2 * np.pi * count)
    first_order = 2 * np.pi * drift_coefficient(axes, error_matrix)
    return DataTable(
        {
            "way": (way, "deg", "how far the axis has gone round"),
            "first_order": (first_order, "arcmin", "drift in one turn about it, to first order"),
            "exact": (
                drift_per_revolution(axes, error_matrix),
                "arcmin",
                "drift in one turn about it",
            ),
        },
        {
            "axes": (axes, "", "unit axis of the turns; the first is the chosen one"),
            "error": (to_rotation_vector(error), "rad", "rotation vector from R to B at the end"),
            # (12, 24), from the South pole and from -180 degrees on
            "coefficient": (faces, "", "drift coefficient amid each face of a globe of axes"),
            "no_drift": (axes_without_drift(error_matrix), "", "axes without drift"),
            "principal": (principal, "", "principal drift coefficients, rising"),
            "principal_axes": (principal_axes, "", "their unit axes as rows"),
            "triad": (np.eye(3) + factor * error_matrix, "", "sensitive axes as rows, exaggerated"),
            "exaggeration": (factor, "", "exaggeration of the triad"),
            "turns": (count, "", "turns about each axis"),
            "full_colour": (full, "", "drift coefficient with the full colour on the globe"),
        },
    )


def axes_without_drift(error_matrix: ArrayLike, points: int = 145) -> FloatArray:
    """Unit axes (2, points, 3) without drift to first order: a cone, in two halves.

    There are none, (0, points, 3), if all axes drift one way or if none drifts. The axis of the
    cone is the principal axis whose coefficient has a sign of its own; if the middle coefficient is
    zero, the cone has become two planes.
    """
    principal, axes = principal_drifts(finite_array(error_matrix, "error_matrix", 3, 3))
    count = whole_number(points, "points", least=4)
    rounding = 1e-12 * np.abs(principal).max()
    if not (principal[0] < -rounding and principal[2] > rounding):
        return np.empty((0, count, 3))
    (alone, first, second) = (2, 0, 1) if principal[1] < 0 else (0, 1, 2)
    around = np.linspace(0, 2 * np.pi, count)
    # In the plane of the other two, that of them alone; and how far the cone leans towards it.
    others = principal[first] * np.cos(around) ** 2 + principal[second] * np.sin(around) ** 2
    lean = np.arctan2(np.sqrt(abs(principal[alone])), np.sqrt(np.abs(others)))[:, np.newaxis]
    aside = (
        np.cos(around)[:, np.newaxis] * axes[first] + np.sin(around)[:, np.newaxis] * axes[second]
    )
    cone = np.cos(lean) * axes[alone] + np.sin(lean) * aside
    return np.stack([cone, -cone])
