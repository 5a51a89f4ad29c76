"""All axes of rotation as a globe: the drift about each, those without, and a way over it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.scenarios import SYMMETRIC
from driftlab.checks import (
    FloatArray,
    finite_array,
    nonzero_vectors,
    positive_number,
    whole_number,
)
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.drift.systematic_drift import drift_coefficient, drift_per_turn, principal_drifts
from driftlab.quaternion import to_rotation_vector
from driftlab.triad import measured_rate
from driftlab.vectors import direction_from_angles

from .experiments import EXAGGERATION, TURNS

FULL_COLOUR = 2e-3
"""Drift coefficient that has the full colour on the globe, if nothing else is said."""


class AxisTour(NamedTuple):
    """An axis that goes round a great circle, and what turns about it leave."""

    way: FloatArray  # (m,), how far it has gone, 0 to 2 pi
    axes: FloatArray  # (m, 3), unit axis of the turns; the first is the chosen one
    first_order: FloatArray  # (m,), drift angle in one turn about it, rad
    exact: FloatArray  # (m,), the same, exact
    # (m, 3), rotation vector from R to B after `turns` turns about it, rad, exact
    error: FloatArray
    # (12, 24), drift coefficient in the middle of each face of a globe of axes, from the South pole
    # and from -180 degrees on
    coefficient: FloatArray
    # (2, p, 3) or (0, p, 3), both halves of the cone of axes with no drift to first order, closed;
    # none if there is none
    no_drift: FloatArray
    principal: FloatArray  # (3,), principal coefficients, rising
    principal_axes: FloatArray  # (3, 3), their unit axes as rows
    triad: FloatArray  # (3, 3), sensitive axes as rows, bent `exaggeration` times too much
    exaggeration: float
    turns: int
    full_colour: float  # drift coefficient that has the full colour on the globe


def axis_tour(
    triad_error: ArrayLike = 1e-3 * SYMMETRIC,
    direction: ArrayLike = (1.0, 0.0, 0.0),
    turns: int = TURNS,
    exaggeration: float = EXAGGERATION,
    full_colour: float = FULL_COLOUR,
) -> AxisTour:
    """Take the axis of the turns from where it is through the worst axis, and once round."""
    count = whole_number(turns, "turns")
    factor = positive_number(exaggeration, "exaggeration")
    full = positive_number(full_colour, "full_colour")
    n, _ = nonzero_vectors(direction, "direction")
    triad_error = finite_array(triad_error, "triad_error", 3, 3)
    principal, principal_axes = principal_drifts(triad_error)
    worst = principal_axes[np.abs(principal).argmax()]
    # From the worst axis itself it leaves towards the one that drifts least.
    goal = worst if abs(n @ worst) < 1 - 1e-9 else principal_axes[np.abs(principal).argmin()]
    ahead = goal - (goal @ n) * n
    ahead /= np.linalg.norm(ahead)
    way = np.linspace(0, 2 * np.pi, 361)
    axes = np.cos(way)[:, np.newaxis] * n + np.sin(way)[:, np.newaxis] * ahead
    elevation = np.radians(np.arange(-82.5, 90, 15))[:, np.newaxis]
    azimuth = np.radians(np.arange(-172.5, 180, 15))
    return AxisTour(
        way,
        axes,
        2 * np.pi * drift_coefficient(axes, triad_error),
        drift_per_turn(axes, triad_error),
        to_rotation_vector(
            error_quaternion(axes, measured_rate(axes, triad_error), 2 * np.pi * count)
        ),
        drift_coefficient(direction_from_angles(azimuth, elevation), triad_error),
        axes_without_drift(triad_error),
        principal,
        principal_axes,
        np.eye(3) + factor * triad_error,
        factor,
        count,
        full,
    )


def axes_without_drift(triad_error: ArrayLike, points: int = 145) -> FloatArray:
    """Unit axes (2, points, 3) without drift to first order: a cone, in two halves.

    There are none, (0, points, 3), if all axes drift one way or if none drifts. The axis of the
    cone is the principal axis whose coefficient has a sign of its own; if the middle coefficient is
    zero, the cone has become two planes.
    """
    principal, axes = principal_drifts(finite_array(triad_error, "triad_error", 3, 3))
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
