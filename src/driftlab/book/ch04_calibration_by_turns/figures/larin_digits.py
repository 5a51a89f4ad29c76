"""Which assumptions give which of the printed digits of Larin's table."""

from typing import Any, NamedTuple

import numpy as np

from driftlab.book.ch04_calibration_by_turns.printed_table import (
    NAMES,
    STEPS,
    TRIADS,
    candidates,
)
from driftlab.book.machinery.picture import BLUE, GREY, Picture
from driftlab.checks import FloatArray


class LarinDigits(NamedTuple):
    """For each triad, step formula and number of steps, the best forming of sigma4*."""

    labels: list[str]  # row: triad, step formula
    agrees: FloatArray  # (steps, row, 7), 1 where all printed digits agree

    @property
    def winners(self) -> int:
        """How many candidates give all seven numbers."""
        return int(self.agrees.all(axis=-1).sum())


def compute() -> LarinDigits:
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


def columns(data: LarinDigits) -> dict[str, Any]:
    """Columns of the figure's CSV: one a number and number of steps, one row a candidate."""
    table: dict[str, Any] = {"candidate": data.labels}
    for steps, agrees in zip(STEPS, data.agrees, strict=True):
        table |= {
            f"{name} in {steps}": column for name, column in zip(NAMES, agrees.T, strict=True)
        }
    return table


class LarinDigitsPicture(Picture[LarinDigits]):
    """A row a candidate, a column a printed number, a panel a number of steps."""

    size = (10.0, 7.0)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, len(STEPS), sharey=True)
        self.figure.subplots_adjust(0.25, 0.07, 0.98, 0.88, wspace=0.06)
        for panel, steps in zip(self.panels, STEPS, strict=True):
            panel.set_title(f"{steps} steps in the turn", pad=26)
            panel.xaxis.tick_top()
            panel.set_xticks(range(len(NAMES)), [_pretty(name) for name in NAMES])
            panel.set_xlim(-0.5, len(NAMES) - 0.5)
            panel.tick_params(length=0)
            for side in ("left", "bottom"):
                panel.spines[side].set_visible(False)

    def update(self, data: LarinDigits) -> None:
        self.panels[0].set_yticks(range(len(data.labels)), data.labels)
        self.panels[0].set_ylim(len(data.labels) - 0.5, -0.5)
        for panel, agrees in zip(self.panels, data.agrees, strict=True):
            row, column = np.nonzero(agrees)
            panel.plot(column, row, "o", color=BLUE, markersize=8, label="every digit agrees")
            row, column = np.nonzero(agrees == 0)
            panel.plot(column, row, "x", color=GREY, markersize=4, label="does not agree")
        self.panels[0].legend(loc="upper left", bbox_to_anchor=(0, -0.01), ncols=2)


def _pretty(name: str) -> str:
    stars = r"\ast" * name.count("*")
    return rf"$\sigma_{name[5]}^{{{stars}}}$"
