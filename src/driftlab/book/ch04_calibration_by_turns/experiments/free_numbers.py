"""What the digits pin down if the integrator and the forming of sigma4* are left free.

Two numbers stand for all integrators and all formings: the angle error in each of a hundred steps,
which adds one and the same amount to all four estimates, and the factor before the arc tangent in
sigma4*.
"""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, finite_array, positive_number
from driftlab.drift.step_formulas import STEP_FORMULAS
from driftlab.drift.turn_calibration import TurnExperiment, exact_turn_estimate
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, weighing_estimate

from ..copied_digits import digit_interval
from ..experiment_numbers import NAMES, SIGN_RESTORED, SUM_FACTORS, TRIADS, triad_reading

STEPS_IN_TURN = 100
OF_SIGMA1 = np.array(digit_interval(SIGN_RESTORED[0])) * 2 * np.pi / STEPS_IN_TURN
"""Least and greatest angle error of a step with which sigma1* comes out, rad."""
LARGEST_STEP_ERROR = 3e-9
"""Angle error of one step up to which is looked, rad."""
FACTORS = (0.8, 1.7)
"""Lowest and highest factor that is looked at."""


def free_numbers(
    largest_step_error: float = LARGEST_STEP_ERROR, factors: tuple[float, float] = FACTORS
) -> DataTable:
    """Bounds of the factor over the error of a step, for each reading of the triad."""
    largest = positive_number(largest_step_error, "largest_step_error")
    low, high = (positive_number(factor, "factors") for factor in factors)
    if not low < high:
        raise ValueError(f"factors: expected the lowest before the highest, got {factors!r}.")
    # Some of them give sigma1*.
    giving = np.linspace(OF_SIGMA1[0], OF_SIGMA1[1], 5)[1:-1]
    errors = np.union1d(np.linspace(-largest, largest, 60), giving[np.abs(giving) <= largest])
    bounds = np.array([factor_bounds(triad, errors, (low, high)) for triad in TRIADS])
    formulas = np.array([step_error(formula) for formula in STEP_FORMULAS])
    formulas = formulas[np.abs(formulas) <= largest]
    reading, number, place = np.nonzero(~np.isnan(bounds[:, 0]))
    least, most = bounds[:, :, number, place][reading, :, np.arange(len(reading))].T
    return DataTable(
        {
            "reading": ([TRIADS[i] for i in reading], "", "reading of the triad"),
            "number": ([NAMES[i] for i in number], "", "number that comes out"),
            "step_error": (errors[place], "nrad", "error of the integrator in 1/100 of a turn"),
            "factor_from": (least, "", "lowest factor with which it comes out"),
            "factor_to": (most, "", "highest factor"),
            "formula_error": (np.tile(formulas, len(SUM_FACTORS)), "nrad", "of a step formula"),
            "formula_factor": (np.repeat([*SUM_FACTORS.values()], len(formulas)), "",
                               "with each way to form sigma4*"),
        },
        {
            "formulas": (len(formulas), "", "step formulas with an error in this range"),
            "factors": ((low, high), "", "lowest and highest factor that is tried"),
            "largest_step_error": (largest, "nrad", "largest error that is tried"),
            "extent": ([extent(each, (low, high)) for each in bounds], "",
                       "where each number comes out, by reading"),
        },
    )  # fmt: skip


def extent(bounds: FloatArray, within: tuple[float, float]) -> list[str]:
    """Where each number comes out, by its `factor_bounds`: everywhere, nowhere or in part."""
    low, high = bounds
    everywhere = ((low == within[0]) & (high == within[1])).all(axis=-1)
    nowhere = np.isnan(low).all(axis=-1)
    found = np.select([everywhere, nowhere], ["everywhere", "nowhere"], "in part")
    return [str(word) for word in found]


def step_error(formula: str) -> float:
    """Angle error of a step formula in a hundredth of a turn, rad."""
    turn = TurnExperiment(1, STEPS_IN_TURN, formula).estimate(PAIR_AXES[0], np.zeros((3, 3)))
    return float(2 * np.pi * turn / STEPS_IN_TURN)


def factor_bounds(
    triad: str, step_error: ArrayLike, within: tuple[float, float] = FACTORS
) -> FloatArray:
    """Lowest and highest factor (2, 7, m) with which each number comes out; NaN where none does.

    `step_error` (m,) is the angle error of the integrator in a hundredth of a turn, rad.
    """
    own = STEPS_IN_TURN * finite_array(step_error, "step_error") / (2 * np.pi)
    estimates = exact_turn_estimate(YATES_AXES, triad_reading(triad)) + own[..., np.newaxis]
    low, high = np.array([digit_interval(text) for text in SIGN_RESTORED]).T
    pairs = estimates[:, :3].T
    comes_out = (low[:3, np.newaxis] <= pairs) & (pairs <= high[:3, np.newaxis])
    whole = np.where(comes_out, np.reshape(within, (2, 1, 1)), np.nan)
    # What sigma4* may be: by its own digits, and by those of each weighing.
    rest = weighing_estimate(np.where(np.arange(4) < 3, estimates, 0)).T
    fourth = np.stack([low[3:, np.newaxis], high[3:, np.newaxis]]) + np.zeros_like(own)
    fourth[:, 1:] = 2 * (fourth[:, 1:] - rest)
    with np.errstate(divide="ignore"):  # an estimate of zero: no factor makes a number of it
        factors = np.tan(np.pi * fourth) / np.tan(np.pi * estimates[:, 3])
    lowest = np.maximum(factors.min(axis=0), within[0])
    highest = np.minimum(factors.max(axis=0), within[1])
    some = lowest <= highest
    parts = np.stack([np.where(some, lowest, np.nan), np.where(some, highest, np.nan)])
    return np.concatenate([whole, parts], axis=1)
