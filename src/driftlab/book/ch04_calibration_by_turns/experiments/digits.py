"""Which assumptions give which of the printed digits of Larin's table."""

from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray

from ..printed_table import STEPS, TRIADS, candidates


class LarinDigits(NamedTuple):
    """For each triad, step formula and number of steps, the best forming of sigma4*.

    Attributes
    ----------
    labels : list of str
        Triad and step formula of each row.
    agrees : ndarray, shape (steps, row, 7)
        1 where all digits of a printed number agree, 0 where they do not.
    """

    labels: list[str]
    agrees: FloatArray

    @property
    def winners(self) -> int:
        """How many candidates give all seven numbers."""
        return int(self.agrees.all(axis=-1).sum())


def larin_digits() -> LarinDigits:
    """Run all candidates; of those that differ in the forming of sigma4* alone, keep the best."""
    best: dict[tuple[str, str, int], list[bool]] = {}
    for candidate in candidates():  # best first
        key = (candidate.triad, candidate.step_formula, candidate.steps)
        best.setdefault(key, candidate.agrees)

    def total(row: tuple[str, str]) -> int:
        return sum(sum(best[*row, steps]) for steps in STEPS)

    rows = {(triad, formula) for triad, formula, _ in best}
    ordered = sorted(rows, key=lambda row: (TRIADS.index(row[0]), -total(row), row[1]))
    agrees = [[best[*row, steps] for row in ordered] for steps in STEPS]
    labels = [f"{triad}, {formula}" for triad, formula in ordered]
    return LarinDigits(labels, np.array(agrees, dtype=float))
