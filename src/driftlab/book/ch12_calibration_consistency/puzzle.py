"""The puzzle of chapter 12: what three centimetres do, and how much of it the filter notices."""

from functools import cache

import numpy as np

from driftlab.checks import FloatArray
from driftlab.motion.scheme import NINETEEN_POSITIONS

from ..machinery.exercise.puzzle import Number, Puzzle
from .experiments import ARM, arms_alone


@cache
def _of_the_arms() -> FloatArray:
    """Squares of states and of innovations, the worst bias in deviations, and more: see there."""
    return arms_alone(NINETEEN_POSITIONS, (ARM,))[:, 0]


PUZZLE = Puzzle(
    chapter="12",
    edition=1,
    questions=(
        Number(
            asks="The mean squared innovation: by how many per cent is it too large?",
            unit="%",
            low=0.1,
            high=10_000,
            truth=lambda: float(np.round(100 * (_of_the_arms()[1] - 1), 1)),
        ),
        Number(
            asks="And the accelerometer bias: by how many stated standard deviations is it wrong?",
            unit="σ",
            low=0.1,
            high=100,
            truth=lambda: float(np.round(_of_the_arms()[2], 1)),
        ),
    ),
    says=(
        "A filter can be certain and wrong at once. What would have shown it, and what does the "
        "filter take the three centimetres for?"
    ),
)
