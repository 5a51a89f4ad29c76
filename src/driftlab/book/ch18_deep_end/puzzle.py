"""The puzzle of chapter 18: the Earth turns, and a short word does not notice."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.attitude import integrate, integrate_finite_word
from driftlab.quaternion import conjugate, multiply, rotation_angle

from ..machinery.exercise.puzzle import Choice, Number, Puzzle
from .experiments import EARTH_RATE

SECONDS, RATE = 10, 10_000
AXIS = np.array([0.6, 0.0, 0.8])
START = np.array([0.1, 0.7, 0.1, 0.7], np.float32)
"""Attitude at the start; its length does not matter."""
LARGER, SAME, SMALLER = "it grows", "it stays the same", "it shrinks"


def missed(rate: int) -> float:
    """Angle that a computer with 32 bits misses, arc seconds, if it reads the gyros so often."""
    steps = SECONDS * rate
    turns = np.tile(EARTH_RATE / rate / 2 * AXIS, (2 * steps, 1))  # two increments a step
    start = START / np.linalg.norm(START)
    found = integrate_finite_word(turns, start=start, update="product")[-1].astype(float)
    true = integrate(turns, start=start)[-1]
    return float(rotation_angle(multiply(conjugate(true), found))) / arcsecond


def less_often() -> str:
    """Whether the error grows or shrinks if the computer makes a hundredth of the steps."""
    often, seldom = missed(RATE), missed(RATE // 100)
    if abs(seldom / often - 1) < 0.1:
        return SAME
    return LARGER if seldom > often else SMALLER


PUZZLE = Puzzle(
    chapter="18",
    edition=1,
    questions=(
        Number(
            asks="How far off is the computed attitude after ten seconds?",
            unit="″",
            low=0.0001,
            high=10_000,
            truth=lambda: missed(RATE),
        ),
        Choice(
            asks="It now makes a hundredth of the steps. What happens to the error?",
            options=(LARGER, SAME, SMALLER),
            truth=less_often,
        ),
    ),
    says=(
        "In ten seconds the Earth turns by 150″, and the computer has noticed none of it. Seven "
        "digits are many. Where did they go, and how would you keep them?"
    ),
)
