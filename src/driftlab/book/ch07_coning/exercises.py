"""Exercises of chapter 07: Coning: why perfect gyros drift."""

from functools import cache

import numpy as np

from driftlab.attitude.cayley import rotation_quaternion
from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithm, LastStage
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.integration import step_quaternions, step_rotation_vectors
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import slider
from driftlab.checks import FloatArray
from driftlab.quaternion import conjugate, from_rotation_vector, multiply

from .experiments import (
    BRACKET,
    BRACKET_SAMPLE_RATE,
    SAMPLE_RATES,
    SHIP,
    algorithm_errors,
)


def _growth(name: str) -> float:
    """Factor of the drift on the puzzle's bracket if it shakes twice as fast."""
    frequencies = [BRACKET.frequency, 2 * BRACKET.frequency]
    slow, fast = coning_drift(name, BRACKET.half_angle, frequencies, 1 / BRACKET_SAMPLE_RATE)
    return float(fast / slow)


@cache
def _on_the_ship() -> FloatArray:
    """The panel's errors (algorithm, rate) on the ship in arc seconds."""
    table = algorithm_errors(SHIP, SAMPLE_RATES[0], tuple(CONING_ALGORITHMS))
    return table.shown("largest_error")


def _lowest_rate(needed: int) -> int:
    """Lowest of the panel's rates at which `needed` algorithms stay below one arc second."""
    return SAMPLE_RATES[int(np.argmax((_on_the_ship() < 1).sum(axis=0) >= needed))]


def _extrapolated(order: float) -> float:
    """Rate at which `picard-1` comes to one arc second, if its error were of that order."""
    return float(SAMPLE_RATES[-1] * _on_the_ship()[0, -1] ** (1 / order))


def _step(
    gamma_1: FloatArray,
    gamma_2: FloatArray,
    weight: float = 2 / 3,
    last_stage: LastStage = "tangent",
) -> FloatArray:
    algorithm = Algorithm("two halves", 2, 0, {(0, 1): weight}, last_stage, 4)
    return step_quaternions([gamma_1, gamma_2], algorithm)[0]


def _turned_one_after_the_other(first: FloatArray, second: FloatArray) -> FloatArray:
    return multiply(from_rotation_vector(first), from_rotation_vector(second))


def _some_halves(rng: np.random.Generator) -> dict[str, FloatArray]:
    """Two increments of a rate that changes its direction, but not into the opposite one."""
    while True:
        first, second = np.round(rng.uniform(-0.5, 0.5, (2, 3)), 2)
        if np.linalg.norm(np.cross(first, second)) > 0.1 and first @ second > 0:
            return {"gamma_1": first, "gamma_2": second}


EXERCISES: dict[str, Exercise] = {
    "7.1": Value(
        kind="predict",
        right=lambda: [_growth("picard-1"), _growth("two-step-4")],
        accuracy=0.05,
        mistakes={
            "Those are the powers of the global order: how the error at a given time grows with "
            "the step, on one and the same motion. Here the motion has changed and the step has "
            "not: look at the drift of one sample.": (
                lambda: [
                    2.0 ** CONING_ALGORITHMS[name].order for name in ("picard-1", "two-step-4")
                ]
            ),
            "The rounds are twice as many, and each leaves more than before.": lambda: [2, 2],
            "The two are exchanged.": lambda: [_growth("two-step-4"), _growth("picard-1")],
        },
        remark="The closed formula lies a little below the powers of two that the series gives.",
    ),
    "7.2": Value(
        kind="slide",
        right=lambda: _lowest_rate(1),
        unit="Hz",
        from_panel=slider(
            "rate",
            "Begin with the preset `Swaying ship` and change the sample rate alone.",
            motion="swaying ship",
            word="64 bits",
        ),
        mistakes={
            "There nearly all are below one arc second. A lower rate is enough for some.": (
                lambda: _lowest_rate(len(CONING_ALGORITHMS) - 1)
            ),
            "There none is below one arc second: look at the exponents, and at the order.": (
                lambda: SAMPLE_RATES[0]
            ),
        },
        remark="Three algorithms of fourth order manage it; the one with three samples does not.",
    ),
    "7.3": Value(
        kind="slide",
        right=lambda: _extrapolated(2),
        unit="Hz",
        accuracy=0.02,
        mistakes={
            "The error would have to shrink as the rate grows; look at the order beside the "
            "picture.": lambda: _extrapolated(1),
            "That goes by the local order. The errors of the steps add up: one power is lost.": (
                lambda: _extrapolated(3)
            ),
            "The rate has to become higher, not lower.": lambda: _extrapolated(-2),
        },
        remark="Nearly ten times the rate that the better ones need, for want of a cross product.",
    ),
    "7.4": Choice(
        kind="explain",
        right="acf",
        wrong={
            "b": "confuses the two orders: the first wrong power in one step of `one-step-3` is "
            "one more than its global order.",
            "d": "draws the wrong lesson. On a narrow cone the error of third order is nearly "
            "invisible, so one finds an order there that holds nowhere else.",
            "e": "holds to the second power of the half angle only. Try the widest cone of the "
            "panel and let it run for a minute.",
        },
        remark="An order is a promise for all smooth motions; a single motion may be kinder.",
    ),
    "7.5": Formula(
        kind="compute",
        arguments=("x",),
        draw=lambda rng: (float(rng.uniform(0.3, 2.5)),),
        right=lambda x: (x - np.sin(x)) / (8 * np.sin(x / 2) ** 2 * np.sin(x)),
        mistakes={
            "That is the limit for a cone that is sampled often. At other x it leaves a drift.": (
                lambda x: 1 / 12
            ),
            "That takes the arc for the chord: the increments beside the axis are shorter.": (
                lambda x: (x - np.sin(x)) / (2 * x**2 * np.sin(x))
            ),
            "That needs the true correction over one sample; this is the one over a pair.": (
                lambda x: (2 * x - np.sin(2 * x)) / (8 * np.sin(x / 2) ** 2 * np.sin(x))
            ),
        },
        remark="Such a weight is right at one frequency; on a much slower cone 1/12 does better.",
    ),
    "7.6": Value(
        kind="compute",
        given=GivenNumbers(
            book={
                "gamma_1": np.array([0.3, -0.1, 0.4]),
                "gamma_2": np.array([0.35, 0.15, 0.25]),
            },
            draw=_some_halves,
            units={"gamma_1": "rad", "gamma_2": "rad"},
        ),
        right=_step,
        accuracy=2e-6,
        quaternion=True,
        mistakes={
            "The cross product has its factors exchanged.": lambda **halves: _step(
                **halves, weight=-2 / 3
            ),
            "The cross product is missing: you know only the sum of the two increments.": (
                lambda **halves: _step(**halves, weight=0)
            ),
            "That is the first iterate, of second order: it has neither the cross product nor the "
            "cubic term.": lambda gamma_1, gamma_2: step_quaternions(
                [gamma_1 + gamma_2], "picard-1"
            )[0],
            "The step turns half as far: the tangent in k is of a quarter of the angle.": (
                lambda gamma_1, gamma_2: rotation_quaternion(
                    step_rotation_vectors([gamma_1, gamma_2], "two-step-4")[0], 3
                )
            ),
            "This is the opposite rotation: k points against the axis.": lambda **halves: conjugate(
                _step(**halves)
            ),
            "The cubic term is that of the sum. `two-step-4` takes the corrected sum for it.": (
                lambda **halves: _step(**halves, last_stage="third iterate")
            ),
            "This is what `two-step-3` gives: the shorter formula is the better one.": (
                lambda **halves: step_quaternions([*halves.values()], "two-step-3")[0]
            ),
            "This is the rotation vector with a sine, as in `rotation-vector-2`.": (
                lambda **halves: step_quaternions([*halves.values()], "rotation-vector-2")[0]
            ),
            "One turn after the other takes the rate for constant in each half. It corrects by "
            "half of the cross product, where a changing rate needs two thirds.": (
                lambda gamma_1, gamma_2: _turned_one_after_the_other(gamma_1, gamma_2)
            ),
            "One turn after the other takes the rate for constant in each half; besides, the "
            "first of the two has to be on the left.": lambda gamma_1, gamma_2: (
                _turned_one_after_the_other(gamma_2, gamma_1)
            ),
        },
        remark="No sine and no root, and its length is one.",
    ),
}
