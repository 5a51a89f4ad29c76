"""Which assumptions give which digits of Larin's seven numbers."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import whole_number

from ..copied_digits import NUMBER
from ..experiment_numbers import NAMES, SIGN_RESTORED, STEPS, TRIADS, agreement, candidates

CHOSEN_BY = {"sigma1*": "step formula", "sigma4*": "factor of sigma4*"}
"""The numbers that served to choose an assumption, and support nothing."""


def larin_digits(
    texts: tuple[str, ...] = SIGN_RESTORED, steps: tuple[int, ...] = STEPS
) -> DataTable:
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
    shown = np.array([[best[*row, count] for row in ordered] for count in counts], dtype=float)
    give = np.sum([agrees for _, agrees in every], axis=0)
    return DataTable(
        {
            "candidate": ([f"{triad}, {formula}" for triad, formula in ordered], "",
                          "reading of the triad and step formula, with the best factor of sigma4*"),
            "agrees": (np.swapaxes(shown, 1, 2), "",
                       "1 where all digits agree with the copy, for so many steps in the turn",
                       ([f"{count} steps" for count in counts], NAMES)),
            "number": (NAMES, "", "name of each of the seven numbers"),
            "digits": (tuple(texts), "", "its digits"),
            "of_all_candidates": (give, "", "how many of all candidates give it"),
        },
        {
            "steps": (counts, "", "numbers of steps in the turn"),
            "candidates": (len(every), "", "candidates"),
            "winners": (int(shown.all(axis=-1).sum()), "", "marks in all seven columns"),
        },
    )  # fmt: skip
