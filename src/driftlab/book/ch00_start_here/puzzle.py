"""The puzzle of chapter 00: one gyro leans, and the block turns once."""

import numpy as np
from scipy.constants import arcminute

from driftlab.drift import drift_per_revolution

from ..machinery.exercise.puzzle import Number, Puzzle

LEANING = np.array([[0, 2e-3, 0], [0, 0, 0], [0, 0, 0]])
"""The first gyro leans by two milliradians to the second edge."""


def error_after_one_turn() -> float:
    """Angle by which the attitude is off after a turn about the diagonal, arc minutes."""
    return float(drift_per_revolution([1, 1, 0], LEANING)) / arcminute


PUZZLE = Puzzle(
    chapter="00",
    edition=1,
    questions=(
        Number(
            asks="The gyro leans by 7′. How far off is the attitude after one turn?",
            unit="′",
            low=0.1,
            high=100,
            truth=error_after_one_turn,
        ),
    ),
    says=(
        "Divide that by the lean, 2 mrad or 6.88′: the ratio looks familiar. Why should a circle "
        "come in? And what if you turn the same block about another axis?"
    ),
)
