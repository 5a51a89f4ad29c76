"""The puzzle of chapter 02: when is a clock that gains right again?"""

import numpy as np
from scipy.constants import hour

from driftlab.drift import exact_roots

from ..machinery.exercise.puzzle import Number, Puzzle

SPIN = 2 * np.pi / 6
"""Ten turns a minute, rad/s."""


def comes_round(false_rate: list[float]) -> float:
    """Hours until the slow error motion has made a turn.

    `false_rate` is relative to the rate about axis 3.
    """
    rate = np.array([0, 0, SPIN])
    slow = np.abs(exact_roots(rate, rate + SPIN * np.array(false_rate))).min()
    return float(2 * np.pi / slow) / hour


PUZZLE = Puzzle(
    chapter="02",
    edition=1,
    questions=(
        Number(
            asks="The first, a thousandth too much along the spin: right again after",
            unit="hours",
            low=0.1,
            high=1e5,
            truth=lambda: comes_round([0, 0, 1e-3]),
        ),
        Number(
            asks="The second, a thousandth of the spin at right angles to it: right again after",
            unit="hours",
            low=0.1,
            high=1e5,
            truth=lambda: comes_round([1e-3, 0, 0]),
        ),
    ),
    says=(
        "An hour or two, and months. The false rates are equally large. What does the error count, "
        "if not the size of what is wrong?"
    ),
)
