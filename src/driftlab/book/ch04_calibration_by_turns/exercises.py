"""Exercises of chapter 04: calibrating a triad by turns."""

from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcsecond, degree

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import slider
from driftlab.book.scenarios import LARIN_TRIAD, SYMMETRIC
from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import earth_rate_offset
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns
from driftlab.earth import EARTH_RATE

from .experiments import AS_COPIED, AS_DERIVED, estimate_errors, method_bias, yates_sigma

EQUAL = 1e-3 * SYMMETRIC
STEPS = np.arange(20, 101)
DIAGONALS = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
EDGES = np.array([[1.0, 1, 0], [1, -1, 0], [1, 0, 1], [1, 0, -1], [0, 1, 1], [0, 1, -1]])

BODY_AND_PAIRS = np.vstack([PAIR_AXES, np.eye(3)])


WHOLE_TURNS = 2
"""Of exercise 4.6."""


def _earth_alone(latitude: float, table_rate: float) -> float:
    """Estimate of a triad without error, in arc seconds, from degrees and degrees a second."""
    return float(earth_rate_offset(latitude * degree, table_rate * degree)) / arcsecond


def _other_part(latitude: float, table_rate: float, share: float | None = None) -> float:
    """The same with the Earth's level rate, or a share of its rate, taken as positive."""
    told = np.cos(latitude * degree) if share is None else share
    return float(EARTH_RATE * told / abs(table_rate * degree)) / arcsecond


def _southern_table(rng: np.random.Generator) -> dict[str, float]:
    # South and clockwise, as what is said of the mistakes has it.
    latitude, table_rate = rng.integers(315, 400) / 10, rng.choice([8.0, 12.0, 15.0, 25.0])
    return {"latitude": -float(latitude), "table_rate": -float(table_rate)}


def _twelve_turns(*, scale_factor: str = "each", senses: int = 2) -> list[float]:
    """Mean variance of the sigmas by both plans of exercise 4.7."""
    variances = []
    for axes in (EDGES, BODY_AND_PAIRS):
        rates = np.repeat([1.0, -1.0][:senses], len(axes))
        turns = np.tile(axes, (senses, 1))
        fit = fit_turns(
            np.zeros(len(turns)), turns, scale_factor, table_rates=rates, gyro_bias=senses == 2
        )
        variances.append(float(np.diag(fit.covariance)[:3].mean()))
    return variances


def _nine(*variances: float, turns: int = 9) -> FloatArray:
    return np.array([turns, *variances])


def _weighing_error(factor: float, *, weight: float = 1.0) -> float:
    """Error of sigma1** for three equal sigmas, the fourth estimate multiplied by `factor`."""
    found = yates_sigma(drift_coefficient(YATES_AXES, EQUAL), factor)
    error = float(found[0] - EQUAL[0, 1])
    return weight * round(error, 12)  # what is zero but for rounding, is zero


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
        right=lambda: _weighing_error(AS_COPIED),
        accuracy=0.02,
        mistakes={
            "A turn about the space diagonal does not give the sum of the three: it gives 2/3 of "
            "(3.5). As the copy has it, the formula takes the one for the other.": (
                lambda: _weighing_error(AS_DERIVED)
            ),
            "The fourth number is too small, not too large: the copy leaves out a "
            "factor that is more than one.": lambda: _weighing_error(AS_DERIVED**2),
            "By that much the fourth number is wrong. The weighing does not take all of it.": (
                lambda: _weighing_error(AS_COPIED, weight=2)
            ),
            "That is what is found, or the sign is reversed. What is found less what is true is "
            "asked.": lambda: _weighing_error(AS_COPIED, weight=-1),
            "That is the part of one sigma. The part belongs to the sum of the three.": (
                lambda: _weighing_error(AS_COPIED, weight=1 / 3)
            ),
            "That is in thousandths; give a plain number.": (
                lambda: _weighing_error(AS_COPIED, weight=1e3)
            ),
        },
        remark="Half of the sigma itself is lost. Larin's example, with the sum zero, shows none "
        "of it.",
    ),
    "4.2": Value(
        kind="slide",
        right=lambda: _steps_to_stay_near(method_bias(LARIN_TRIAD)),
        absolute=1.0,
        from_panel=slider(
            "steps",
            "Go back to the preset, with the formula `pade`, and change the steps alone.",
            **{f"sigma{i}": value for i, value in enumerate((0.0, 1.0, -1.0), 1)},
            **{"formula": "pade", "noise": 0.0, "scale": 0.0, "earth": "none"},
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
    "4.3": Choice(
        kind="explain",
        right="abd",
        wrong={
            "c": "has only the part of the bias along the axis. The rest of it turns with the "
            "body and comes back to zero after a whole turn.",
            "e": "forgets that the triad error adds up at the same pace: the angle of the bias "
            "grows with the time, and so does what it is divided by.",
            "f": "takes two different things for one. The bias of the method is quadratic in M, "
            "and the same in both senses.",
        },
        remark="The Earth's rate goes the way of the bias. So turn both ways, as fast as the table "
        "and the gyros bear.",
    ),
    "4.4": Value(
        kind="compute",
        right=lambda: _mean_variances(YATES_AXES, DIAGONALS, EDGES),
        accuracy=2e-3,
        mistakes={
            "Your turn about the space diagonal measures the whole sum of the sigmas. It measures "
            "2/3 of (3.5), with the same noise.": (
                lambda: _mean_variances(YATES_AXES, DIAGONALS, EDGES, diagonal_is_sum=True)
            ),
            "The first number is that of the paper's weighing, four equal noises on the sigmas "
            "and their sum. The fourth turn measures 2/3 of (3.5), with the same noise.": (
                lambda: np.append(
                    _mean_variances(YATES_AXES, diagonal_is_sum=True),
                    _mean_variances(DIAGONALS, EDGES),
                )
            ),
            "A better plan gives up all four of Larin's axes but one. Adding to his three pair "
            "axes cannot do better than he did.": (
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
    "4.5": Formula(
        kind="compute",
        arguments=("y_1", "y_2", "y_3", "y_4"),
        draw=lambda rng: tuple(rng.normal(size=4)),
        right=lambda *estimates: _sigma(estimates),
        mistakes={
            "The fourth estimate stands for the sum of the sigmas here, but it is 2/3 of (3.5). An "
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
    "4.6": Value(
        kind="predict",
        unit="arc seconds",
        given=GivenNumbers(
            book={"latitude": -33.9, "table_rate": -20.0},
            draw=_southern_table,
            units={"latitude": "degrees", "table_rate": "degrees a second"},
        ),
        right=_earth_alone,
        accuracy=0.01,
        mistakes={
            "The sign. In the South the Earth turns clockwise, seen from above, and so does the "
            "table: the Earth adds to the turn.": lambda **table: -_earth_alone(**table),
            "That is with the level part of the Earth's rate, the cosine of the latitude. It goes "
            "round and sums to zero; the part along the table's axis counts.": _other_part,
            "Two slips: that is with the level part of the Earth's rate, the cosine of the "
            "latitude, and with the other sign. Which part adds up, and which way does the table "
            "turn?": lambda **table: -_other_part(**table),
            "That is the whole rate of the Earth. Only its part along the table's axis adds up.": (
                lambda **table: _other_part(**table, share=1.0)
            ),
            "That is the angle by which the Earth turns about the table's axis meanwhile. (3.3) "
            "divides it by the angle of the turns.": (
                lambda **table: 2 * np.pi * WHOLE_TURNS * _earth_alone(**table)
            ),
            "By that angle the Earth turns about the table's axis in one of the two turns. (3.3) "
            "divides by the angle of the turns, and is a plain number before it is one of arc "
            "seconds.": lambda **table: 2 * np.pi * _earth_alone(**table),
            "Two turns take twice the time, and (3.3) divides by twice the number: the number of "
            "turns does not matter.": lambda **table: WHOLE_TURNS * _earth_alone(**table),
        },
        remark="The same for every axis in the body, and reversed for the other sense.",
    ),
    "4.7": Value(
        kind="compute",
        right=lambda: _nine(*_twelve_turns()),
        absolute=5e-3,
        mistakes={
            "Six axes are needed for sigmas and scale factors, but in one sense each they say "
            "nothing of the biases apart. Count all unknowns.": (
                lambda: _nine(*_twelve_turns(), turns=6)
            ),
            "Eight were enough in the text, where the three gyros shared one scale factor. Count "
            "the unknowns anew.": lambda: _nine(*_twelve_turns(), turns=8),
            "Twelve turns do determine the nine, but fewer do: three axes turned both ways tell "
            "the biases.": lambda: _nine(*_twelve_turns(), turns=12),
            "The Earth's rate is known here, so it is no tenth unknown.": (
                lambda: _nine(*_twelve_turns(), turns=10)
            ),
            "These variances belong to one sense only. Each axis is turned twice.": (
                lambda: _nine(*_twelve_turns(senses=1))
            ),
            'These variances are without unknown scale factors: use `scale_factor="each"`.': (
                lambda: _nine(*_twelve_turns(scale_factor="none"))
            ),
            "That is for one common scale factor; each gyro has its own here.": (
                lambda: _nine(*_twelve_turns(scale_factor="common"))
            ),
            "The two plans do not weigh alike. About the pair axes a scale factor looks like a "
            "sigma until the turns about the body axes take it off, and these have noise.": (
                lambda: _nine(*2 * _twelve_turns()[:1])
            ),
            "These are standard deviations.": lambda: _nine(*np.sqrt(_twelve_turns())),
            "The two plans are exchanged.": lambda: _nine(*_twelve_turns()[::-1]),
        },
        remark="About the edges the scale factors drop out of the difference of two estimates. "
        "About the body axes they have to be taken off, with the noise of two more turns.",
    ),
}
