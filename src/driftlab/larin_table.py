"""Larin's numerical experiment, the only table of his paper, and attempts to rebuild its digits.

The paper integrates one turn in 100 steps for a triad whose third axis alone is bent, and prints
seven numbers. The integrator is "from [8]", a paper that is not available. What is rebuilt here is
therefore a *reconstruction*: assumptions under which the printed digits follow.
"""

from dataclasses import dataclass
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from itertools import product

import numpy as np
from scipy.optimize import linprog

from .checks import FloatArray
from .step_formulas import STEP_FORMULAS
from .turn_calibration import YATES_AXES, TurnExperiment, exact_turn_estimate, weighing

MISALIGNMENT: FloatArray = 1e-3 * np.array([[0.0, 0, 0], [0, 0, 0], [2, -2, 0]])
"""mu T of the experiment: i_z leans by 2e-3 to i_1 and by -2e-3 to i_2."""
MISALIGNMENT.setflags(write=False)

NAMES = ("sigma1*", "sigma2*", "sigma3*", "sigma4*", "sigma1**", "sigma2**", "sigma3**")

PRINTED = ("-0.216e-7", "0.998e-3", "-1.001e-3", "0.165e-5", "0.681e-6", "0.999e-3", "-1.0e-3")
"""The seven numbers as printed, digit for digit."""

SIGN_RESTORED = (*PRINTED[:3], "-0.165e-5", *PRINTED[4:])
"""The same with the minus sign that `is_consistent` shows to be missing from sigma4*."""

TRIADS = ("linear", "unit third axis", "symmetric part")
"""Readings of mu T: A = E + mu T as written; i_z scaled to unit length; only Sigma kept."""

SUM_FACTORS = {"1 (as printed)": 1.0, "3/2 (as derived)": 1.5, "sqrt(3/2)": np.sqrt(1.5)}
"""How sigma4* is formed from n4: what multiplies l^T n4 before the arc tangent.

sqrt(3/2) is what comes out when (1, 1, 1) is divided by sqrt(2), like the other three axes.
"""


@dataclass(frozen=True, eq=False)
class Reconstruction:
    """One set of assumptions and the seven numbers that follow from it.

    Attributes
    ----------
    triad, step_formula, sum_factor : str
        Names in `TRIADS`, `STEP_FORMULAS` and `SUM_FACTORS`.
    values : ndarray, shape (7,)
        In the order of `NAMES`.
    """

    triad: str
    step_formula: str
    sum_factor: str
    values: FloatArray

    @property
    def agrees(self) -> list[bool]:
        """Which of the seven agree with print in every digit, the lost sign restored.

        Digits are all rounded or all cut off, whichever makes more numbers agree.
        """
        return max((self._agrees(rule) for rule in (ROUND_DOWN, ROUND_HALF_EVEN)), key=sum)

    def _agrees(self, rounding: str) -> list[bool]:
        return [
            Decimal(float(value)).quantize(Decimal(text), rounding=rounding) == Decimal(text)
            for value, text in zip(self.values, SIGN_RESTORED, strict=True)
        ]


def triad_misalignment(triad: str) -> FloatArray:
    """Misalignment (3, 3) under one of the readings in `TRIADS`."""
    if triad not in TRIADS:
        raise ValueError(f"triad: expected one of {', '.join(TRIADS)}, got {triad!r}.")
    if triad == "unit third axis":
        exact = MISALIGNMENT.copy()
        exact[2, 2] = np.sqrt(1 - np.sum(MISALIGNMENT[2] ** 2)) - 1
        return exact
    if triad == "symmetric part":
        return 0.5 * (MISALIGNMENT + MISALIGNMENT.T)
    return MISALIGNMENT


def reconstruct(
    triad: str = "unit third axis",
    step_formula: str = "pade",
    sum_factor: str = "sqrt(3/2)",
) -> Reconstruction:
    """Run the experiment under the given assumptions; the defaults give every printed digit."""
    experiment = TurnExperiment(turns=1, steps_per_turn=100, step_formula=step_formula)
    starred = experiment.estimate(triad_misalignment(triad), YATES_AXES)
    if sum_factor not in SUM_FACTORS:
        raise ValueError(f"sum_factor: expected one of {list(SUM_FACTORS)}, got {sum_factor!r}.")
    factor = SUM_FACTORS[sum_factor]
    starred[3] = np.arctan(factor * np.tan(np.pi * starred[3])) / np.pi
    return Reconstruction(
        triad, step_formula, sum_factor, np.concatenate([starred, weighing(starred)])
    )


def larin_table() -> dict[str, FloatArray]:
    """The seven numbers, (7,) each, in the order of `NAMES`.

    Returns
    -------
    dict
        "printed"; "exact", the method itself without integration error, with the corrected (3.5);
        "reconstructed", the assumptions of `reconstruct`.
    """
    starred = exact_turn_estimate(MISALIGNMENT, YATES_AXES)
    starred[3] *= 1.5
    return {
        "printed": np.array([float(text) for text in PRINTED]),
        "exact": np.concatenate([starred, weighing(starred)]),
        "reconstructed": reconstruct().values,
    }


def candidates() -> list[Reconstruction]:
    """Every combination of the assumptions, best agreement first."""
    every = [reconstruct(*names) for names in product(TRIADS, STEP_FORMULAS, SUM_FACTORS)]
    return sorted(every, key=lambda candidate: -sum(candidate.agrees))


def printed_interval(text: str) -> tuple[float, float]:
    """Lowest and highest value that a printed number may stand for, were it rounded or cut off."""
    number = Decimal(text)
    unit = Decimal(1).scaleb(number.as_tuple().exponent)  # type: ignore[arg-type]
    ends = [number - unit / 2, number + unit / 2, number + unit.copy_sign(number)]
    return float(min(ends)), float(max(ends))


def weighed_intervals(starred: tuple[str, ...]) -> FloatArray:
    """Bounds (3, 2) of sigma1**, sigma2**, sigma3** that four printed starred numbers allow.

    Interval arithmetic; each weighing is half of a sum of four numbers with signs, so its
    half-width is half of the sum of theirs.
    """
    low, high = np.array([printed_interval(text) for text in starred]).T
    half_width = 0.5 * np.sum(0.5 * (high - low))
    middle = weighing(0.5 * (low + high))
    return np.stack([middle - half_width, middle + half_width], axis=-1)


def is_consistent(seven: tuple[str, ...]) -> bool:
    """Can the seven printed numbers stand together, whether rounded or cut off?

    Linear programming: is there a point in the box of the four starred intervals whose weighings
    lie in the three doubly starred ones?
    """
    bounds = [printed_interval(text) for text in seven]
    weights = weighing(np.eye(4)).T
    low, high = np.array(bounds[4:]).T
    # Scaled to units of 1e-9, or the solver's own tolerance would swallow the intervals.
    found = linprog(
        np.zeros(4),
        A_ub=np.vstack([weights, -weights]),
        b_ub=1e9 * np.concatenate([high, -low]),
        bounds=1e9 * np.array(bounds[:4]),
    )
    return bool(found.success)
