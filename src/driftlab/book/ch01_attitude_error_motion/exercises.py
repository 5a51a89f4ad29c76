"""Exercises of chapter 01: rotation and error kinematics."""

import numpy as np
from scipy.integrate import solve_ivp

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import slider
from driftlab.checks import FloatArray
from driftlab.drift.error_kinematics import error_quaternion, error_rate_matrix
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

from .experiments import SPIN

BODY_TURNS = 2 * np.pi * np.array([1 / 4, 1 / 2, 1])
SECONDS = 20.0
TOLERANCE = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-11}
"""Of 1.4: the time, and how exactly to integrate."""
TOO_LITTLE = 0.3
"""What the panel's slider takes off the rate about the third axis, degrees a second."""


def _reversed_gyro() -> FloatArray:
    """Error angles, in degrees, of a triad whose third gyro says the opposite of the truth."""
    error = error_quaternion([0, 0, 1], [0, 0, -1], BODY_TURNS)
    return np.degrees(rotation_angle(error))


def _same_size() -> float:
    """False rate across that makes up for what is too little along, in degrees a second."""
    return np.sqrt(SPIN**2 - (SPIN - TOO_LITTLE) ** 2)


def _bent(entry_12: float) -> FloatArray:
    matrix = np.eye(3)
    matrix[0, 1] = entry_12
    return matrix


def _rate(time: float, rate_3: float) -> FloatArray:
    return np.array([np.sin(time), np.cos(time), rate_3])


def _error(entry_12: float, rate_3: float, transposed: bool = False) -> FloatArray:
    """Error quaternion of a bent triad after `SECONDS`, by (1.4)."""
    matrix = _bent(entry_12).T if transposed else _bent(entry_12)

    def slope(time: float, error: FloatArray) -> FloatArray:
        rate = _rate(time, rate_3)
        return error_rate_matrix(rate, matrix @ rate) @ error / 2

    return solve_ivp(slope, (0, SECONDS), [0, 0, 0, 1], **TOLERANCE).y[:, -1]


def _error_in_fixed_frame(entry_12: float, rate_3: float) -> FloatArray:
    def slope(time: float, attitude: FloatArray) -> FloatArray:
        return multiply(attitude, [*_rate(time, rate_3), 0]) / 2

    attitude = solve_ivp(slope, (0, SECONDS), [0, 0, 0, 1], **TOLERANCE).y[:, -1]
    return multiply(multiply(attitude, _error(entry_12, rate_3)), conjugate(attitude))


def _rates_taken_for_constant(entry_12: float, rate_3: float) -> FloatArray:
    turn = _rate(SECONDS, rate_3) * SECONDS
    return multiply(from_rotation_vector(-turn), from_rotation_vector(_bent(entry_12) @ turn))


def _some_triad(rng: np.random.Generator) -> dict[str, float]:
    return {
        "entry_12": round(rng.uniform(5e-3, 2e-2), 4),
        "rate_3": round(rng.uniform(0.3, 0.9), 2),
    }


def _picked_up(w: float, m: float, t: float) -> FloatArray:
    """First order error of a triad whose first gyro picks up m of a rate w about axis 3."""
    return m * np.array([np.sin(w * t), np.cos(w * t) - 1, 0])


EXERCISES: dict[str, Exercise] = {
    "1.1": Value(
        kind="predict",
        right=_reversed_gyro,
        unit="degrees",
        absolute=0.5,
        mistakes={
            "That is how far the body has turned. The computer has turned as far, the other way.": (
                lambda: np.degrees(BODY_TURNS)
            ),
            "Twice the turn is right as a number; but a whole turn more or less is no error.": (
                lambda: 2 * np.degrees(BODY_TURNS)
            ),
            "After half a turn: do turns to the one and to the other side end differently?": (
                lambda: np.array([180, 360, 0])
            ),
            "A whole turn more or less is no error: look at the last of the three.": (
                lambda: np.array([180, 0, 360])
            ),
        },
        remark="A test that turns the body by halves of a turn would never find the wrong wire.",
    ),
    "1.2": Value(
        kind="slide",
        right=_same_size,
        unit="degrees per second",
        accuracy=0.02,
        from_panel=slider(
            "error1",
            "Begin with the preset, set error 3 to −0.3 deg/s, and then move error 1 alone.",
            **{"rate1": 0.0, "rate2": 0.0, "rate3": SPIN, "error2": 0.0, "error3": -TOO_LITTLE},
        ),
        mistakes={
            "That makes up for the false rate along the true one as if both pointed the same way; "
            "it is the two sizes that must agree.": lambda: TOO_LITTLE,
        },
        remark="The two rates are now far apart, and yet the error comes back to zero every turn.",
    ),
    "1.3": Choice(
        kind="explain",
        right="bce",
        wrong={
            "a": "is the inverse: it leads from the apparent attitude to the true one. Try it with "
            "a small error about one axis, and look at the sign.",
            "d": "would be true if the difference of the rates stood still as seen from the fixed "
            "frame. It stands still as seen from the body.",
        },
        remark="Seen from the body the matrix is constant; so Larin's choice can be solved.",
    ),
    "1.4": Value(
        kind="compute",
        given=GivenNumbers(
            book={"entry_12": 0.01, "rate_3": 0.5}, draw=_some_triad, units={"rate_3": "rad/s"}
        ),
        right=_error,
        accuracy=1e-6,
        quaternion=True,
        mistakes={
            "This is the error as seen from the fixed frame; (1.3) sees it from the body.": (
                _error_in_fixed_frame
            ),
            "The entry is on the wrong side of the diagonal: gyro x picks up the second "
            "component of the rate.": lambda **triad: _error(**triad, transposed=True),
            "The exact solution holds for constant rates only; these change.": (
                _rates_taken_for_constant
            ),
        },
        remark="Two integrations and one of the difference agree: (1.4) holds for changing rates.",
    ),
    "1.5": Formula(
        kind="compute",
        arguments=("w", "m", "t"),
        draw=lambda rng: tuple(rng.uniform(0.5, 2, 3)),
        right=_picked_up,
        mistakes={
            "That is the false rate times the time. An error that is there already turns, as seen "
            "from a body that turns.": lambda w, m, t: [m * w * t, 0, 0],
            "That is the error as seen from the reference frame. What stands still there goes "
            "round the other way as seen from the body.": (
                lambda w, m, t: _picked_up(w, m, t) * [1, -1, 1]
            ),
            "That is the error if the second gyro picked up the turn. Here it is the first, and "
            "the false rate is about the first axis.": (
                lambda w, m, t: _picked_up(w, m, t)[[1, 0, 2]] * [-1, 1, 1]
            ),
            "This is the vector part of the quaternion, half of the rotation vector.": (
                lambda w, m, t: _picked_up(w, m, t) / 2
            ),
            "The false rate is m times w, and the sum over the time divides by w again.": (
                lambda w, m, t: w * _picked_up(w, m, t)
            ),
        },
        remark="A false rate beside the turn never gets far.",
    ),
}
