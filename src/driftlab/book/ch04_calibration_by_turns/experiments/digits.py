"""Which assumptions give which digits of Larin's seven numbers."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from ..experiment_numbers import NAMES, STEPS, TRIADS, candidates

CHOSEN_BY = {"sigma1*": "step formula", "sigma4*": "factor of sigma4*"}
"""The numbers that served to choose an assumption, and support nothing."""


class LarinDigits(NamedTuple):
    """For each triad, step formula and number of steps, the best forming of sigma4*.

    Attributes
    ----------
    labels : list of str
        Triad and step formula of each row.
    agrees : ndarray, shape (steps, row, 7)
        1 where all digits of a number agree with the copy, 0 where they do not.
    counts : ndarray of int, shape (7,)
        How many of all candidates give each number, whichever way they form sigma4*.
    candidates : int
        How many there are.
    """

    labels: list[str]
    agrees: FloatArray
    counts: NDArray[np.int64]
    candidates: int

    @property
    def winners(self) -> int:
        """How many candidates give all seven numbers."""
        return int(self.agrees.all(axis=-1).sum())

    @property
    def chosen_by(self) -> list[bool]:
        """Which of the seven served to choose an assumption."""
        return [name in CHOSEN_BY for name in NAMES]


def larin_digits() -> LarinDigits:
    """Run all candidates; of those that differ in the forming of sigma4* alone, keep the best."""
    every = candidates()
    best: dict[tuple[str, str, int], list[bool]] = {}
    for candidate in every:  # best first
        key = (candidate.triad, candidate.step_formula, candidate.steps)
        best.setdefault(key, candidate.agrees)

    def total(row: tuple[str, str]) -> int:
        return sum(sum(best[*row, steps]) for steps in STEPS)

    rows = {(triad, formula) for triad, formula, _ in best}
    ordered = sorted(rows, key=lambda row: (TRIADS.index(row[0]), -total(row), row[1]))
    agrees = [[best[*row, steps] for row in ordered] for steps in STEPS]
    labels = [f"{triad}, {formula}" for triad, formula in ordered]
    counts = np.sum([candidate.agrees for candidate in every], axis=0)
    return LarinDigits(labels, np.array(agrees, dtype=float), counts, len(every))
