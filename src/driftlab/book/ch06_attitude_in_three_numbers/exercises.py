"""Exercises of chapter 06: Attitude in three numbers."""

import numpy as np

from driftlab.attitude.cayley import cayley_vector, rotation_quaternion
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.reading import slider
from driftlab.checks import FloatArray
from driftlab.quaternion import multiply


def _angle_of_ratio(ratio: float) -> float:
    """Angle above half a turn, in degrees, with lengths |dimension 3| = ratio |dimension 4|.

    With t = tan(phi/4) the lengths are 2 t/(t^2 - 1) and t.
    """
    return float(np.degrees(4 * np.arctan(np.sqrt(1 + 2 / ratio))))


def _composed(first: FloatArray, second: FloatArray, dimension: int = 4) -> FloatArray:
    rotations = [rotation_quaternion(k, dimension) for k in (first, second)]
    return cayley_vector(multiply(*rotations), dimension)


def _composed_scalar_first(first: FloatArray, second: FloatArray) -> FloatArray:
    """As by one who writes the scalar first and hands it to a product that has it last."""
    rotations = [np.roll(rotation_quaternion(k), 1) for k in (first, second)]
    return cayley_vector(np.roll(multiply(*rotations), -1))


EXERCISES: dict[str, Exercise] = {
    "6.1": Choice(
        kind="predict",
        right="abd",
        wrong={
            "c": "is false: on its way to the end of the swing the body passes half a turn.",
            "e": "takes what is wise for what is necessary. The vector is longer than one beyond "
            "half a turn; where is it infinite?",
            "f": "counts the angle from one end of the swing to the other. The vector counts it "
            "from the attitude in which it is zero.",
        },
        remark="At the wider swing the vector of dimension 4 stays shorter than 1.2, so the switch "
        "of this chapter would not act either.",
    ),
    "6.2": Value(
        kind="slide",
        right=lambda: _angle_of_ratio(2),
        unit="degrees",
        absolute=0.6,
        from_panel=slider("angle", ""),
        mistakes={
            "There the vector of dimension 3 is infinite, and no length is twice another.": (
                lambda: 180.0
            ),
            "There both vectors are zero; look for another angle.": lambda: 0.0,
            "There the two are equally long.": lambda: _angle_of_ratio(1),
            "The two are exchanged: there the vector of dimension 4 is twice the other.": (
                lambda: _angle_of_ratio(1 / 2)
            ),
            "There the vector of dimension 3 is twice as long as the shadow.": (
                lambda: 360 - _angle_of_ratio(2)
            ),
            "That is the argument of the tangent, a quarter of the angle.": (
                lambda: _angle_of_ratio(2) / 4
            ),
        },
        remark="The two vectors have opposite directions there.",
    ),
    "6.3": Choice(
        kind="explain",
        right="ade",
        wrong={
            "b": "is what no three numbers can do: for every choice of them there are attitudes "
            "near which they, or their rates of change, grow without limit, or jump.",
            "c": "is false. The solution of the linear equation is known in closed form, and k is "
            "a fraction made of its components.",
            "f": "takes the length for the attitude. Divide by the length: the direction of the "
            "quaternion in four dimensions was the attitude all along.",
        },
        remark="Four numbers with a constraint, or three with a singularity: the shadow makes two "
        "vectors of three numbers do the work of the four.",
    ),
    "6.4": Formula(
        kind="compute",
        arguments=("phi",),
        draw=lambda rng: (float(rng.uniform(-11, 11)),),
        right=lambda phi: -np.tan(phi / 8),
        mistakes={
            "That belongs to the formula without the squares. Each of its two factors now does "
            "half of the turn.": lambda phi: -np.tan(phi / 4),
            "The angle goes the wrong way: two equal factors share the turn of the quaternion, so "
            "each has less of it.": lambda phi: -np.tan(phi / 2),
            "You have shared the turn once too often: the angle of the quaternion is half of the "
            "body's already.": lambda phi: -np.tan(phi / 16),
            "The size is right. Does the vector point along the axis or against it? Try the "
            "formula without the squares.": lambda phi: np.tan(phi / 8),
            "That is true of small angles only.": lambda phi: -phi / 8,
        },
        remark="It is finite up to two whole turns. The next exercise asks at what price.",
    ),
    "6.5": Choice(
        kind="explain",
        right="acd",
        wrong={
            "b": "holds for the motion along a fixed axis only. Find the part beside the axis: it "
            "has a denominator.",
            "e": "looks at the length only. What does the direction of the vector do when the body "
            "passes the whole turn at a small distance?",
            "f": "is false in its last part. When the body passes close to a whole turn, the "
            "rotation vector flies from one side to the other.",
        },
        remark="The trouble at the whole turn has changed its form and has stayed. With the shadow "
        "the first order has none.",
    ),
    "6.6": Formula(
        kind="compute",
        arguments=("k1", "k2"),
        draw=lambda rng: tuple(rng.uniform(-0.2, 0.2, (2, 3))),
        right=_composed,
        mistakes={
            "The factors are exchanged. Perhaps the minus sign of the vector was left out on both "
            "ways: that exchanges them too.": lambda k1, k2: _composed(k2, k1),
            "The sum is the answer for small angles only.": lambda k1, k2: k1 + k2,
            "This is the rule for the vectors of dimension 3.": (
                lambda k1, k2: _composed(k1, k2, dimension=3)
            ),
            "The scalar is first in your quaternions; `multiply` expects it last.": (
                _composed_scalar_first
            ),
        },
    ),
}
