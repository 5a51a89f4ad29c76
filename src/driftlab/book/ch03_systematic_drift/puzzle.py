"""The puzzle of chapter 03: two blocks whose gyros lean by the same angle."""

import numpy as np

from driftlab.drift import drift_per_revolution

from ..machinery.exercise.puzzle import Choice, Number, Puzzle
from ..scenarios import SKEW, SYMMETRIC

MILLI = 1e-3
FIRST, SECOND, ALIKE = "the first", "the second", "both alike"


def errors() -> tuple[float, float]:
    """Errors of the two blocks after a turn about the worst axis of each, rad."""
    first = drift_per_revolution([1, 1, 1], MILLI * SYMMETRIC)
    # A skew block has no one worst axis: all at right angles to (1, 1, 1) are alike.
    second = drift_per_revolution([1, -1, 0], MILLI * SKEW)
    return float(np.abs(first)), float(np.abs(second))


def worse_block() -> str:
    """Which block is further off."""
    first, second = errors()
    return FIRST if first > second else SECOND if second > first else ALIKE


def times_worse() -> float:
    """How many times further the worse one is off."""
    return max(errors()) / min(errors())


PUZZLE = Puzzle(
    chapter="03",
    edition=1,
    questions=(
        Choice(
            asks="Which block ends up further off?",
            options=(FIRST, SECOND, ALIKE),
            truth=worse_block,
        ),
        Number(
            asks="How many times further than the other?",
            unit="times",
            low=1,
            high=1e5,
            truth=times_worse,
        ),
    ),
    says=(
        "The same lean of every gyro, and a thousand times less error. What has the second block "
        "that the first has not?"
    ),
)
