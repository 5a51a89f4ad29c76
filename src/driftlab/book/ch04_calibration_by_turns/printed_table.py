"""Larin's numerical experiment, the only table of his paper, and attempts to rebuild its digits.

The paper integrates one turn in 100 steps for a triad whose third axis alone is bent, and prints
seven numbers. The integrator is "from [8]", a paper that is not available. What is rebuilt here is
therefore a *reconstruction*: assumptions under which the printed digits follow. Several sets of
them do; `printed_digits` asks what the digits alone can tell.
"""

from __future__ import annotations

from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from itertools import product
from typing import NamedTuple

import numpy as np

from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray
from driftlab.drift.step_formulas import STEP_FORMULAS
from driftlab.drift.turn_calibration import TurnExperiment, exact_turn_estimate
from driftlab.drift.weighing_designs import YATES_AXES, weighing

NAMES = ("sigma1*", "sigma2*", "sigma3*", "sigma4*", "sigma1**", "sigma2**", "sigma3**")

PRINTED = ("-0.216e-7", "0.998e-3", "-1.001e-3", "0.165e-5", "0.681e-6", "0.999e-3", "-1.0e-3")
"""The seven numbers as printed, digit for digit."""

SIGN_RESTORED = (*PRINTED[:3], "-0.165e-5", *PRINTED[4:])
"""The same with the minus sign that `printed_digits` shows to be missing from sigma4*."""

TRIADS = ("linear", "unit third axis", "symmetric part")
"""Readings of mu T: A = I + mu T as written, (2.4); i_z of unit length, as section 1 of the paper
defines the axes; only Sigma kept."""

STEPS = (100, 50)
"""Steps in the turn: the paper's tau/100, and twice as long ones, as an algorithm that joins two
sampling intervals takes them."""

SUM_FACTORS = {"1 (as printed)": 1.0, "3/2 (as derived)": 1.5, "sqrt(3/2)": np.sqrt(1.5)}
"""How sigma4* is formed from n4: what multiplies l^T n4 before the arc tangent.

sqrt(3/2) is what comes out when (1, 1, 1) is divided by sqrt(2), like the other three axes.
"""


class Reconstruction(NamedTuple):
    """One set of assumptions and the seven numbers that follow from it.

    Attributes
    ----------
    triad, step_formula : str
        Names in `TRIADS` and `STEP_FORMULAS`.
    steps : int
        Steps in the turn.
    sum_factor : str
        Name in `SUM_FACTORS`.
    values : ndarray, shape (7,)
        In the order of `NAMES`.
    """

    triad: str
    step_formula: str
    steps: int
    sum_factor: str
    values: FloatArray

    @property
    def agrees(self) -> list[bool]:
        """Which of the seven agree with print in every digit, the lost sign restored.

        Digits are all cut off or all rounded, whichever makes more numbers agree.
        """
        return max((self.agrees_when(rule) for rule in (ROUND_DOWN, ROUND_HALF_EVEN)), key=sum)

    def agrees_when(self, rounding: str) -> list[bool]:
        """Which of the seven agree under one rounding rule of the `decimal` module."""
        return [
            Decimal(float(value)).quantize(Decimal(text), rounding=rounding) == Decimal(text)
            for value, text in zip(self.values, SIGN_RESTORED, strict=True)
        ]


def printed_triad_error(triad: str) -> FloatArray:
    """Triad error (3, 3) under one of the readings in `TRIADS`."""
    if triad not in TRIADS:
        raise ValueError(f"triad: expected one of {', '.join(TRIADS)}, got {triad!r}.")
    if triad == "unit third axis":
        exact = LARIN_TRIAD.copy()
        exact[2, 2] = np.sqrt(1 - np.sum(LARIN_TRIAD[2] ** 2)) - 1
        return exact
    if triad == "symmetric part":
        return 0.5 * (LARIN_TRIAD + LARIN_TRIAD.T)
    return LARIN_TRIAD


def reconstruct(
    triad: str = "unit third axis",
    step_formula: str = "pade",
    steps: int = 100,
    sum_factor: str = "sqrt(3/2)",
) -> Reconstruction:
    """Run the experiment under the given assumptions; the defaults give every printed digit."""
    experiment = TurnExperiment(turns=1, steps_per_turn=steps, step_formula=step_formula)
    starred = experiment.estimate(printed_triad_error(triad), YATES_AXES)
    if sum_factor not in SUM_FACTORS:
        raise ValueError(f"sum_factor: expected one of {list(SUM_FACTORS)}, got {sum_factor!r}.")
    factor = SUM_FACTORS[sum_factor]
    starred[3] = np.arctan(factor * np.tan(np.pi * starred[3])) / np.pi
    values = np.concatenate([starred, weighing(starred)])
    return Reconstruction(triad, step_formula, steps, sum_factor, values)


def larin_table() -> dict[str, FloatArray]:
    """The seven numbers, (7,) each, in the order of `NAMES`.

    Returns
    -------
    dict
        "printed"; "exact", the method itself without integration error, with the corrected (3.5);
        "reconstructed", the assumptions of `reconstruct`.
    """
    starred = exact_turn_estimate(LARIN_TRIAD, YATES_AXES)
    starred[3] *= 1.5
    return {
        "printed": np.array([float(text) for text in PRINTED]),
        "exact": np.concatenate([starred, weighing(starred)]),
        "reconstructed": reconstruct().values,
    }


def candidates() -> list[Reconstruction]:
    """Every combination of the assumptions, best agreement first, and the paper's steps first."""
    every = [
        reconstruct(*assumptions)
        for assumptions in product(TRIADS, STEP_FORMULAS, STEPS, SUM_FACTORS)
    ]
    return sorted(every, key=lambda one: (-sum(one.agrees), -one.steps))
