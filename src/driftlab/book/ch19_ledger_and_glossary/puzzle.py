"""The puzzle of chapter 19: one heading, two manuals."""

import numpy as np

from driftlab.conventions import mirror_heading

from ..machinery.exercise.puzzle import Number, Puzzle

HEADING = 30.0
"""What both ships report, degrees."""


def angle_between_the_bows() -> float:
    """Between a heading counted to the West and the same number counted to the East, degrees."""
    west = np.radians(HEADING)
    return float(np.degrees(abs(west - mirror_heading(west))))


PUZZLE = Puzzle(
    chapter="19",
    edition=2,
    questions=(
        Number(
            asks="Both report a heading of 30°. How far apart do their bows point?",
            unit="°",
            low=1,
            high=180,
            truth=angle_between_the_bows,
        ),
    ),
    says=(
        "No compass errs, and no manual: each says somewhere from which side it counts. What else "
        "may two good books mean by the same word, letter or sign?"
    ),
)
