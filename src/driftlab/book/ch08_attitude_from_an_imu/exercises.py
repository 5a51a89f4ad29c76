"""Exercises of chapter 08: Attitude from a real IMU."""

import numpy as np
from scipy.constants import minute

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.ch07_coning.experiments import BRACKET, BRACKET_SAMPLE_RATE
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.checks import FloatArray

from .experiments import ANGLE_RANDOM_WALK


def _weights(*, at_middle: bool = False) -> FloatArray:
    """Weights of γ1×γ2, γ1×γ3 and γ2×γ3 that give the coning correction of a quadratic rate.

    With ``at_middle`` the rate in the middle of each third stands for its mean.
    """
    ends, powers = np.arange(4) / 3, np.arange(3)
    pieces = np.diff(ends[:, np.newaxis] ** (powers + 1), axis=0) / (powers + 1)
    if at_middle:
        pieces = (np.arange(3) + 0.5)[:, np.newaxis] ** powers / 3.0 ** (powers + 1)
    # One equation for each cross product of two coefficients of the rate, one unknown for each
    # of two increments.
    pairs = [(0, 1), (0, 2), (1, 2)]
    matrix = [
        [pieces[i, p] * pieces[j, q] - pieces[i, q] * pieces[j, p] for i, j in pairs]
        for p, q in pairs
    ]
    true = [(1 / (p + 1) - 1 / (q + 1)) / (p + q + 2) / 2 for p, q in pairs]
    return np.linalg.solve(matrix, true)


def _miller() -> list[float]:
    weights = CONING_ALGORITHMS["rotation-vector-3"].coning
    return [weights[pair] for pair in ((0, 1), (0, 2), (1, 2))]


def _minutes_until_coning_shows(name: str = "rotation-vector-3") -> float:
    """Time after which the drift on the shaking bracket is as large as the noise."""
    drift = abs(coning_drift(name, BRACKET.half_angle, BRACKET.frequency, 1 / BRACKET_SAMPLE_RATE))
    return float((ANGLE_RANDOM_WALK / drift) ** 2 / minute)


EXERCISES: dict[str, Exercise] = {
    "8.1": Choice(
        kind="explain",
        right="cdf",
        wrong={
            "a": "trusts a table of algorithms that are fed with true integrals. These increments "
            "are guessed, and what is lost in them no weight brings back.",
            "b": "trusts a spline with two and a half samples a round. Try it: most of the drift "
            "stays.",
            "e": "is false: true integrals help, but at two and a half samples a round the cross "
            "products of neighbours tell little of the area between the samples.",
        },
        remark="The choice among the seven comes last; first the increments must be true and many.",
    ),
    "8.2": Value(
        kind="compute",
        right=_weights,
        mistakes={
            "Those are Miller's. They are made for a narrow cone, not for a quadratic rate.": (
                _miller
            ),
            "The second of the three belongs to the first increment and the last.": (
                lambda: _weights()[[0, 2, 1]]
            ),
            "You took the rate in the middle of a third for its mean; increments are integrals.": (
                lambda: _weights(at_middle=True)
            ),
            "Those belong to k. Give the correction that is added to the increment.": (
                lambda: -_weights() / 4
            ),
        },
        remark="They are exact for a quadratic rate, and on a cone worse than Miller's.",
    ),
    "8.3": Value(
        kind="predict",
        right=_minutes_until_coning_shows,
        unit="min",
        accuracy=0.03,
        mistakes={
            "That is the ratio of the two numbers in hours. Noise grows with the root of time and "
            "drift with time, so the ratio is to be squared.": lambda: (
                60 * np.sqrt(_minutes_until_coning_shows() / 60)
            ),
            "That is for pairs of samples, `two-step-4`.": lambda: _minutes_until_coning_shows(
                "two-step-4"
            ),
            "That is upside down: the noise is to be divided by the drift.": lambda: (
                60 / (_minutes_until_coning_shows() / 60)
            ),
        },
        remark="Until shortly before, noise hides the drift, and a better algorithm gains little.",
    ),
}
