"""Motions that bring a body back, and the error that they leave."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.drift.closed_motion import drift_per_cycle
from driftlab.drift.systematic_drift import principal_drifts
from driftlab.motion import Coning
from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    multiply,
    rotate,
    rotation_angle,
)
from driftlab.triad import measured_rate

SWING = float(np.radians(30))
"""Half angle of the cone and of the swing among the closed motions, rad."""
REPEATS = 5
"""How often each closed motion is made."""
PLACES = 360
"""Of a body in one motion."""
THIN = 3
"""Of these, so many are one row of the table."""


def closed_motions(
    increments: int = 360, error_matrix: ArrayLike = LARIN_TRIAD, half_angle: float = SWING
) -> dict[str, FloatArray]:
    """Four motions that bring a body back, by name, as true angle increments (increments, 3), rad.

    A whole turn; a tumble of quarter turns about axis 1 and axis 3 by turns, three times; one round
    of a cone; a swing to and fro about one axis. The turn and the swing are about the axis of the
    greatest drift coefficient. The number of increments is a multiple of six.
    """
    count = whole_number(increments, "increments", least=6)
    if count % 6:
        raise ValueError(f"increments: expected a multiple of six, got {increments!r}.")
    worst = principal_drifts(error_matrix)[1][-1]
    reach = positive_number(half_angle, "half_angle")
    angle = reach * np.sin(2 * np.pi * np.arange(count + 1) / count)
    quarters = np.tile(np.eye(3)[[0, 2]], (3, 1)) * np.pi / 2
    return {
        "whole turn": np.tile(2 * np.pi / count * worst, (count, 1)),
        "tumble": np.repeat(quarters, count // 6, axis=0) * 6 / count,
        "cone": Coning(reach, 1.0).increments(1 / count, count),
        "swing": np.diff(angle)[:, np.newaxis] * worst,
    }


def motion_histories(
    error_matrix: ArrayLike = LARIN_TRIAD, half_angle: float = SWING, repeats: int = REPEATS
) -> DataTable:
    """Exact error of a triad over each of the `closed_motions`, with the drift of first order."""
    count = whole_number(repeats, "repeats")
    angle, track, drift = {}, {}, {}
    for name, once in closed_motions(PLACES, error_matrix, half_angle).items():
        true = np.vstack([np.zeros(3), np.tile(once, (count, 1))])
        attitude, apparent = (
            cumulative_product(from_rotation_vector(turns))[::THIN]
            for turns in (true, measured_rate(true, error_matrix))
        )
        angle[name] = rotation_angle(multiply(conjugate(attitude), apparent))
        track[name] = rotate(attitude[: PLACES // THIN + 1], np.array([0.0, 0, 1]))
        drift[name] = float(np.linalg.norm(drift_per_cycle(once, error_matrix)))
    motions = np.arange(0, count * PLACES + 1, THIN) / PLACES
    ends = np.array([0.0, count])
    first_order = {name: each * ends for name, each in drift.items()}
    return DataTable(
        {
            "motions": (motions, "", "how far the body has come"),
            "angle": (angle, "arcmin", "of the rotation from R to B"),
            "ends": (ends, "", "motions at the start and at the end"),
            "first_order": (first_order, "arcmin", "the angle there, to first order"),
        },
        {
            "places": (PLACES // THIN, "", "rows in one motion"),
            "track": (track, "", "third axis in one motion, in the body axes at the start"),
            "drift": (drift, "arcmin", "in one motion, to first order"),
        },
    )
