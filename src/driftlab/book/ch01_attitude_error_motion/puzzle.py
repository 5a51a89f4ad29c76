"""The puzzle of chapter 01: a false degree a second, for the thirty seconds of one turn."""

import numpy as np

from driftlab.drift import error_quaternion
from driftlab.quaternion import rotation_angle

from ..machinery.exercise.puzzle import Number, Puzzle

TURN = 30.0
"""Seconds of one turn at 12 degrees a second."""


def error_after_one_turn() -> float:
    """Angle of the error after the turn, degrees."""
    rate, false_rate = np.radians([0, 0, 12]), np.radians([1, 0, 0])
    return float(np.degrees(rotation_angle(error_quaternion(rate, rate + false_rate, TURN))))


PUZZLE = Puzzle(
    chapter="01",
    edition=1,
    questions=(
        Number(
            asks="How far off is the computed attitude after the turn?",
            unit="°",
            low=0.1,
            high=180,
            truth=error_after_one_turn,
        ),
    ),
    says=(
        "A false degree a second went in for thirty seconds. Nearly all of it has come home by "
        "itself. Where was it on the way, and would it come home along any axis?"
    ),
)
