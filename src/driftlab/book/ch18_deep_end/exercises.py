"""Exercises of chapter 18: Deep end."""

from typing import Any

import numpy as np
from scipy.constants import degree

from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.functional_iteration import FunctionalIteration
from driftlab.attitude.spherical_area import solid_angle
from driftlab.book.machinery.exercise.answers import Value
from driftlab.book.machinery.exercise.exercise import Exercise

from .experiments import WIDE_BRACKET, WIDE_BRACKET_RATE


def _gain_of_sampling() -> float:
    """Factor by which a window of four gains, on the wide bracket, if it is read twice as often."""
    cone, four = WIDE_BRACKET, FunctionalIteration("four", 4)
    intervals = [1 / WIDE_BRACKET_RATE, 0.5 / WIDE_BRACKET_RATE]
    slow, fast = coning_drift(four, cone.half_angle, cone.frequency, intervals)
    return float(slow / fast)


def _stored_as_one(word: type[np.floating[Any]] = np.float64) -> float:
    """Angle of a step below which a word stores the scalar part as 1, rad."""
    return float(np.sqrt(8 * float(np.finfo(word).epsneg) / 2))


EXERCISES: dict[str, Exercise] = {
    "18.1": Value(
        kind="compute",
        right=_stored_as_one,
        unit="radians",
        accuracy=0.02,
        mistakes={
            "That is for 32 bits. A word of 64 bits has 53 binary digits.": (
                lambda: _stored_as_one(np.float32)
            ),
            "Below one, neighbouring numbers of the word lie half as far apart as above it, and "
            "rounding goes to the nearer one.": lambda: 2 * _stored_as_one(),
            "Rounding goes to the nearer number: half of the distance to the next one below 1 is "
            "enough.": lambda: np.sqrt(2) * _stored_as_one(),
            "That is the difference of 1 and λ0, not yet the angle: it goes with the square.": (
                lambda: float(np.finfo(float).epsneg) / 2
            ),
        },
        remark="A hundredth of an arc second or less: in 64 bits few steps are so small.",
    ),
    "18.2": Value(
        kind="predict",
        right=_gain_of_sampling,
        accuracy=0.05,
        mistakes={
            "That is the fourth order of the pair, `two-step-4`. Four increments carry a cubic, "
            "and a higher order.": lambda: 2**4,
            "That would be so with an odd number. In an even window the error of the polynomial "
            "is odd about the middle, and that gains a power.": lambda: 2**5,
            "That would be so with a window of six. Four increments carry a cubic.": lambda: 2**8,
            "That is the power of a single window. There are twice as many windows.": (
                lambda: 2**7
            ),
            "The drift has to shrink: give the old one over the new one.": (
                lambda: 1 / _gain_of_sampling()
            ),
        },
        remark="Nearly two to the sixth, the order of a window of four.",
    ),
    "18.3": Value(
        kind="predict",
        right=lambda: float(solid_angle(np.eye(3))) / degree,
        unit="degrees",
        mistakes={
            "The gyro says so, and is right about its rate. But the axis about which it felt "
            "nothing was another one at each moment.": lambda: 0,
            "The way has the eighth of the sphere on its left: look from outside, or go the way "
            "with a pencil.": lambda: -float(solid_angle(np.eye(3))) / degree,
            "Three right angles about three different axes do not add up; and none of them is "
            "about the rod.": lambda: 270,
            "Turned like that the rod would look the same. A whole turn makes no difference: count "
            "the short way round.": lambda: float(solid_angle(np.eye(3))) / degree - 360,
            "That is in radians, and of the opposite sign: the eighth of the sphere lies on the "
            "left of the way.": lambda: -float(solid_angle(np.eye(3))),
        },
        remark="The solid angle of an octant. Geometers call it a holonomy.",
    ),
}
