"""Which assumptions give which digits of Larin's seven numbers."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray, whole_number

from ..copied_digits import NUMBER
from ..experiment_numbers import NAMES, SIGN_RESTORED, STEPS, TRIADS, agreement, candidates

CHOSEN_BY = {"sigma1*": "step formula", "sigma4*": "factor of sigma4*"}
"""The numbers that served to choose an assumption, and support nothing."""


class LarinDigits(NamedTuple):
    """For each triad, step formula and number of steps, the best forming of sigma4*."""

    labels: list[str]  # triad and step formula of each row
    # (steps, row, 7), 1 where all digits of a number agree with the copy, 0 where they do not
    agrees: FloatArray
    # (7,), how many of all candidates give each number, whichever way they form sigma4*
    counts: NDArray[np.int64]
    candidates: int  # how many there are
    steps: tuple[int, ...]  # numbers of steps in the turn
    texts: tuple[str, ...]  # the seven numbers, digit for digit

    @property
    def winners(self) -> int:
        """How many candidates give all seven numbers."""
        return int(self.agrees.all(axis=-1).sum())

    @property
    def chosen_by(self) -> list[bool]:
        """Which of the seven served to choose an assumption."""
        return [name in CHOSEN_BY for name in NAMES]


def larin_digits(
    texts: tuple[str, ...] = SIGN_RESTORED, steps: tuple[int, ...] = STEPS
) -> LarinDigits:
    """Run all candidates; of those that differ in the forming of sigma4* alone, keep the best."""
    if len(texts) != len(NAMES) or not all(NUMBER.fullmatch(str(text)) for text in texts):
        raise ValueError(
            f"texts: expected {len(NAMES)} numbers such as {SIGN_RESTORED[0]!r}, got {texts!r}."
        )
    counts = tuple(whole_number(each, "steps") for each in steps)
    if not counts:
        raise ValueError("steps: expected at least one number of steps, got none.")
    every = [(each, agreement(each.values, texts)) for each in candidates(counts, texts)]
    best: dict[tuple[str, str, int], list[bool]] = {}
    for candidate, agrees in every:  # best first
        key = (candidate.triad, candidate.step_formula, candidate.steps)
        best.setdefault(key, agrees)

    def total(row: tuple[str, str]) -> int:
        return sum(sum(best[*row, count]) for count in counts)

    rows = {(triad, formula) for triad, formula, _ in best}
    ordered = sorted(rows, key=lambda row: (TRIADS.index(row[0]), -total(row), row[1]))
    shown = [[best[*row, count] for row in ordered] for count in counts]
    labels = [f"{triad}, {formula}" for triad, formula in ordered]
    give = np.sum([agrees for _, agrees in every], axis=0)
    return LarinDigits(labels, np.array(shown, dtype=float), give, len(every), counts, tuple(texts))
