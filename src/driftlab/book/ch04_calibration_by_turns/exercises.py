"""Exercises of chapter 04: calibrating gyros by whole turns."""

from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.exercise.answers import Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.reading import slider
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray
from driftlab.drift.turn_calibration import exact_turn_estimate
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns

from .experiments import AS_COPIED, AS_DERIVED, estimate_errors, method_bias, yates_sigma

STEPS = np.arange(20, 101)
DIAGONALS = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
EDGES = np.array([[1.0, 1, 0], [1, -1, 0], [1, 0, 1], [1, 0, -1], [0, 1, 1], [0, 1, -1]])

LARGE_SIGMA, MANY_TURNS = 0.02, 48
"""Of exercise 4.1."""


def _in_one_record(turns: int = MANY_TURNS) -> float:
    """Estimate of a large sigma from turns in one record."""
    sigma = LARGE_SIGMA * np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, 0]])
    return float(exact_turn_estimate(PAIR_AXES[0], sigma, turns))


@cache
def _errors(formula: str) -> FloatArray:
    """Error of sigma2 for Larin's triad over `STEPS`."""
    return estimate_errors(LARIN_TRIAD, formula, STEPS)


def _steps_to_stay_near(limit: float, formula: str = "pade") -> int:
    """Least number of steps from which the error stays within a tenth of `limit` around it."""
    outside = np.abs(_errors(formula) - limit) > 0.1 * abs(limit)
    return int(STEPS[outside].max() + 1)


def _mean_variances(
    *plans: FloatArray, scale_factor: str = "none", diagonal_is_sum: bool = False
) -> FloatArray:
    """Mean variance of the three sigmas for each plan of axes, each estimate of variance one.

    If asked for, as if a turn about a space diagonal gave the whole sum of the sigmas.
    """

    def mean_variance(axes: FloatArray) -> float:
        covariance = fit_turns(np.zeros(len(axes)), axes, scale_factor).covariance
        if diagonal_is_sum:
            x, y, z = (axes / np.linalg.norm(axes, axis=1, keepdims=True)).T
            design = np.column_stack([2 * x * y, 2 * x * z, 2 * y * z])
            design[axes.all(axis=1)] *= AS_DERIVED
            covariance = np.linalg.inv(design.T @ design)
        return float(np.diag(covariance)[:3].mean())

    return np.array([mean_variance(axes) for axes in plans])


def _sigma(estimates: ArrayLike, scale_factor: str = "common", number: int = 1) -> float:
    return float(fit_turns(estimates, YATES_AXES, scale_factor).sigma[number - 1])


def _yates(factor: float, y1: float, y2: float, y3: float, y4: float) -> float:
    return float(yates_sigma([y1, y2, y3, y4], factor)[0])


EXERCISES: dict[str, Exercise] = {
    "4.1": Value(
        kind="predict",
        right=_in_one_record,
        accuracy=2e-3,
        mistakes={
            "After so many turns the error angle is more than half a turn. A quaternion does not "
            "count whole turns, not those of the error either.": lambda: LARGE_SIGMA,
            "The sign. By the shorter way the error points against the axis.": (
                lambda: -_in_one_record()
            ),
            "That is the error angle that the quaternion shows, divided by k pi. Half of the "
            "angle is divided, as in the arc tangent.": lambda: 2 * _in_one_record(),
            "That is the error of one turn, times the turns; (3.3) divides by the turns again.": (
                lambda: MANY_TURNS * LARGE_SIGMA
            ),
            "That is in thousandths; give a plain number.": lambda: 1e3 * _in_one_record(),
        },
        remark="Make one turn first: it says in which interval the answer of many turns lies.",
    ),
    "4.2": Value(
        kind="slide",
        right=lambda: _steps_to_stay_near(method_bias(LARIN_TRIAD)),
        absolute=1.0,
        from_panel=slider(
            "steps",
            "Go back to the preset, with the formula `pade`, and change the steps alone.",
            **{f"sigma{i}": value for i, value in enumerate((0.0, 1.0, -1.0), 1)},
            **{"formula": "pade", "noise": 0.0, "scale": 0.0},
        ),
        mistakes={
            "At a hundred steps the integrator still has a share in the error. The formula `exact` "
            "shows the bias of the method alone.": (
                lambda: _steps_to_stay_near(float(_errors("pade")[-1]))
            ),
            "That belongs to the formula `taylor-4`.": (
                lambda: _steps_to_stay_near(method_bias(LARIN_TRIAD), "taylor-4")
            ),
            "There the error is smallest: the integrator's own just cancels the bias. With more "
            "steps it grows again.": lambda: STEPS[np.abs(_errors("pade")).argmin()],
        },
    ),
    "4.3": Value(
        kind="compute",
        right=lambda: _mean_variances(YATES_AXES, DIAGONALS, EDGES),
        accuracy=2e-3,
        mistakes={
            "Your turn about the space diagonal measures the whole sum of the sigmas. It measures "
            "2/3 of it, with the same noise.": (
                lambda: _mean_variances(YATES_AXES, DIAGONALS, EDGES, diagonal_is_sum=True)
            ),
            "The first number belongs to four equal noises on the sigmas and their sum. The "
            "fourth turn measures 2/3 of the sum, with the same noise.": (
                lambda: np.append(
                    _mean_variances(YATES_AXES, diagonal_is_sum=True),
                    _mean_variances(DIAGONALS, EDGES),
                )
            ),
            "A better plan gives up all pair axes. No fourth turn added to the three pair axes "
            "does better than the space diagonal.": (
                lambda: _mean_variances(YATES_AXES, YATES_AXES, EDGES)
            ),
            "An offset is solved for as well; leave it out.": (
                lambda: _mean_variances(YATES_AXES, DIAGONALS, EDGES, scale_factor="common")
            ),
            "These are standard deviations.": (
                lambda: np.sqrt(_mean_variances(YATES_AXES, DIAGONALS, EDGES))
            ),
            "These are the sums of the three variances; give the means.": (
                lambda: 3 * _mean_variances(YATES_AXES, DIAGONALS, EDGES)
            ),
        },
    ),
    "4.4": Formula(
        kind="compute",
        arguments=("y_1", "y_2", "y_3", "y_4"),
        draw=lambda rng: tuple(rng.normal(size=4)),
        right=lambda *estimates: _sigma(estimates),
        mistakes={
            "The fourth estimate stands for the sum of the sigmas here, but it is 2/3 of it. An "
            "offset cancels, and the sigmas come out wrong.": (
                lambda *estimates: _yates(AS_COPIED, *estimates)
            ),
            "That is right without an offset. With one, a quarter of it stays, as in the text: its "
            "factor multiplies the offset too.": (
                lambda *estimates: _yates(AS_DERIVED, *estimates)
            ),
            "The factor of the fourth estimate is upside down: an estimate of 2/3 of the sum has "
            "to be made larger, not smaller.": (
                lambda *estimates: _yates(1 / AS_DERIVED, *estimates)
            ),
            "That is least squares without an offset; an offset goes into it.": (
                lambda *estimates: _sigma(estimates, "none")
            ),
            "The first turn alone takes the offset in full.": lambda *estimates: estimates[0],
            "That is the second sigma.": lambda *estimates: _sigma(estimates, number=2),
            "That is the third sigma.": lambda *estimates: _sigma(estimates, number=3),
        },
        remark="Nothing of the offset is left.",
    ),
}
