"""Larin's numerical experiment, seven numbers in his text, and attempts to rebuild their digits.

The paper integrates one turn in 100 steps for a triad whose third axis alone is bent, and gives
seven numbers. The integrator is "from [8]", a paper that is not available. What is rebuilt here is
therefore a *reconstruction*: assumptions under which the digits of the copy follow. Several sets of
them do; `copied_digits` asks what the digits alone can tell.
"""

from __future__ import annotations

from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray, finite_arrays
from driftlab.drift.step_formulas import STEP_FORMULAS
from driftlab.drift.turn_calibration import TurnExperiment, exact_turn_estimate
from driftlab.drift.weighing_designs import YATES_AXES, weighing_estimate

NAMES = ("sigma1*", "sigma2*", "sigma3*", "sigma4*", "sigma1**", "sigma2**", "sigma3**")

IN_THE_COPY = ("-0.216e-7", "0.998e-3", "-1.001e-3", "0.165e-5", "0.681e-6", "0.999e-3", "-1.0e-3")
"""The seven numbers as the copy has them, digit for digit."""

SIGN_RESTORED = (*IN_THE_COPY[:3], "-0.165e-5", *IN_THE_COPY[4:])
"""The same with a minus sign before sigma4*, one of the two slips that `copied_digits` finds."""

TRUE_SIGMA: FloatArray = np.array([0.0, 1e-3, -1e-3])
"""sigma1, sigma2, sigma3 of the experiment."""

TRIADS = ("linear", "unit third axis", "symmetric part")
"""Readings of mu T: A = I + mu T as written, (2.4); i_z of unit length, as section 1 of the paper
defines the axes; only Sigma kept."""

STEPS = (100, 50)
"""Steps in the turn: the paper's tau/100, and twice as long ones, as an algorithm that joins two
sampling intervals takes them."""

SUM_FACTORS = {
    "1, n4 as in the copy": 1.0,
    "sqrt(3/2), n4 over sqrt(2)": np.sqrt(1.5),
    "3/2, as derived": 1.5,
}
"""How sigma4* is formed: what multiplies l^T n4, n4 of unit length, before the arc tangent.

1 is (3.5) as the copy has it. sqrt(3/2) is the length of (1, 1, 1)/sqrt(2): with it (3.5) is an
identity, and (3.3) then takes that vector as it stands. 3/2 gives the sum of the sigmas.
"""


class Reconstruction(NamedTuple):
    """One set of assumptions and the seven numbers that follow from it."""

    triad: str  # name in `TRIADS`
    step_formula: str  # name in `STEP_FORMULAS`
    steps: int  # steps in the turn
    sum_factor: str  # name in `SUM_FACTORS`
    values: FloatArray  # (7,), in the order of `NAMES`

    @property
    def agrees(self) -> list[bool]:
        """Which of the seven agree with `SIGN_RESTORED` in every digit."""
        return list(agreement(self.values))


def agreement(values: ArrayLike, texts: tuple[str, ...] = SIGN_RESTORED) -> list[bool]:
    """Which of seven values agree with seven texts in every digit.

    Digits are all cut off or all rounded, whichever makes more numbers agree.
    """
    rules = (ROUND_DOWN, ROUND_HALF_EVEN)
    return max((agreement_when(rule, values, texts) for rule in rules), key=sum)


def agreement_when(
    rounding: str, values: ArrayLike, texts: tuple[str, ...] = SIGN_RESTORED
) -> list[bool]:
    """Which of seven values agree with seven texts under one rounding rule of `decimal`."""
    return [
        Decimal(float(value)).quantize(Decimal(text), rounding=rounding) == Decimal(text)
        for value, text in zip(np.asarray(values), texts, strict=True)
    ]


def triad_reading(triad: str) -> FloatArray:
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
    sum_factor: str = "sqrt(3/2), n4 over sqrt(2)",
) -> Reconstruction:
    """Run the experiment under the given assumptions; the defaults give every digit of the copy."""
    experiment = TurnExperiment(turns=1, steps_per_turn=steps, step_formula=step_formula)
    if sum_factor not in SUM_FACTORS:
        raise ValueError(f"sum_factor: expected one of {list(SUM_FACTORS)}, got {sum_factor!r}.")
    estimates = experiment.estimate(YATES_AXES, triad_reading(triad))
    values = seven_numbers(estimates, SUM_FACTORS[sum_factor])
    return Reconstruction(triad, step_formula, steps, sum_factor, values)


def seven_numbers(estimates: ArrayLike, sum_factor: ArrayLike) -> FloatArray:
    """The numbers (..., 7) of the experiment in the order of `NAMES` from estimates (..., 4).

    The turns are about `driftlab.drift.weighing_designs.YATES_AXES`. The sum factor multiplies
    l^T n4 before the arc tangent.
    """
    estimates, factor = finite_arrays(estimates=(estimates, 4), sum_factor=(sum_factor,))
    fourth = np.arctan(factor * np.tan(np.pi * estimates[..., 3])) / np.pi
    pairs = np.broadcast_to(estimates[..., :3], (*fourth.shape, 3))
    starred = np.concatenate([pairs, fourth[..., np.newaxis]], axis=-1)
    return np.concatenate([starred, weighing_estimate(starred)], axis=-1)


def experiment_numbers() -> dict[str, FloatArray]:
    """The seven numbers (7,) in the order of `NAMES`: of the copy, exact and reconstructed.

    "exact" is the method itself without integration error, with the corrected (3.5).
    """
    starred = exact_turn_estimate(YATES_AXES, LARIN_TRIAD)
    starred[3] *= 1.5
    return {
        "copy": np.array([float(text) for text in IN_THE_COPY]),
        "exact": np.concatenate([starred, weighing_estimate(starred)]),
        "reconstructed": reconstruct().values,
    }


def candidates(
    steps: tuple[int, ...] = STEPS, texts: tuple[str, ...] = SIGN_RESTORED
) -> list[Reconstruction]:
    """Every combination of the assumptions, best agreement first, and the most steps first."""
    every = [
        reconstruct(*assumptions)
        for assumptions in product(TRIADS, STEP_FORMULAS, steps, SUM_FACTORS)
    ]
    return sorted(every, key=lambda one: (-sum(agreement(one.values, texts)), -one.steps))
