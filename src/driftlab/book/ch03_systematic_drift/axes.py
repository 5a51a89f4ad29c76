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
    """An axis that goes round a great circle, and what turns about it leave.

    Attributes
    ----------
    way : ndarray, shape (m,)
        How far it has gone, 0 to 2 pi.
    axes : ndarray, shape (m, 3)
        Unit axis of the turns; the first is the chosen one.
    first_order, exact : ndarray, shape (m,)
        Drift angle in one turn about it, rad.
    error : ndarray, shape (m, 3)
        Rotation vector from R to B after `turns` turns about it, rad, exact.
    coefficient : ndarray, shape (12, 24)
        Drift coefficient in the middle of each face of a globe of axes, from the South pole and
        from -180 degrees on.
    no_drift : ndarray, shape (2, p, 3) or (0, p, 3)
        Both halves of the cone of axes with no drift to first order, closed; none if there is none.
    principal : ndarray, shape (3,)
        Principal coefficients, rising.
    principal_axes : ndarray, shape (3, 3)
        Their unit axes as rows.
    triad : ndarray, shape (3, 3)
        Sensitive axes as rows, bent `exaggeration` times too much.
    exaggeration : float
    turns : int
    full_colour : float
        Drift coefficient that has the full colour on the globe.
    """

    way: FloatArray
    axes: FloatArray
    first_order: FloatArray
    exact: FloatArray
    error: FloatArray
    coefficient: FloatArray
    no_drift: FloatArray
    principal: FloatArray
    principal_axes: FloatArray
    triad: FloatArray
    exaggeration: float
    turns: int
    full_colour: float


def axis_tour(
    triad_error: ArrayLike = 1e-3 * SYMMETRIC,
    direction: ArrayLike = (1.0, 0.0, 0.0),
    turns: int = TURNS,
    exaggeration: float = EXAGGERATION,
    full_colour: float = FULL_COLOUR,
) -> AxisTour:
    """Take the axis of the turns from where it is through the worst axis, and once round.

    Parameters
    ----------
    triad_error : array_like, shape (3, 3)
        M, dimensionless.
    direction : array_like, shape (3,)
        Axis of the turns in body axes at first; only its direction counts.
    turns : int
        Whole turns about each axis, after which the block is shown.
    exaggeration : float
        How many times too large the triad's error is drawn.
    full_colour : float
        Drift coefficient that has the full colour on the globe.
    """
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
    """Unit axes about which a triad does not drift to first order: a cone, in two halves.

    Its axis is the principal axis whose coefficient has a sign of its own. If the middle one is
    zero, the cone has become two planes.

    Parameters
    ----------
    triad_error : array_like, shape (3, 3)
        M, dimensionless.
    points : int
        On either half, the last one being the first again.

    Returns
    -------
    ndarray, shape (2, points, 3) or (0, points, 3)
        None if all axes drift one way, or if none drifts.
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
