"""Which assumptions give which of the printed digits of Larin's table."""

from typing import Any, NamedTuple

import numpy as np

from ..checks import FloatArray
from ..larin_table import NAMES, TRIADS, candidates
from .picture import BLUE, GREY, Picture


class LarinDigits(NamedTuple):
    """For each triad and step formula, the best choice of how sigma4* is formed."""

    labels: list[str]
    agrees: FloatArray  # (row, 7), 1 where all printed digits agree


def compute() -> LarinDigits:
    """Run all candidates; keep, for each triad and step formula, the one that agrees most."""
    best: dict[tuple[str, str], list[bool]] = {}
    for candidate in candidates():  # best first
        best.setdefault((candidate.triad, candidate.step_formula), candidate.agrees)
    ordered = sorted(best, key=lambda key: (TRIADS.index(key[0]), -sum(best[key])))
    return LarinDigits(
        [f"{triad}, {formula}" for triad, formula in ordered],
        np.array([best[key] for key in ordered], dtype=float),
    )


def columns(data: LarinDigits) -> dict[str, Any]:
    """Columns of the figure's CSV: one a number, one row a candidate."""
    return {"candidate": data.labels, **dict(zip(NAMES, data.agrees.T, strict=True))}


class LarinDigitsPicture(Picture[LarinDigits]):
    """A row a candidate, a column a printed number, a filled mark where the digits agree."""

    size = (8.0, 6.2)

    def build(self) -> None:
        self.axes = self.figure.subplots()
        self.figure.subplots_adjust(0.3, 0.03, 0.98, 0.88)
        self.axes.set_title("which printed numbers a candidate gives, digit for digit", pad=26)
        self.axes.xaxis.tick_top()
        self.axes.set_xticks(range(len(NAMES)), [_pretty(name) for name in NAMES])
        self.axes.set_xlim(-0.5, len(NAMES) - 0.5)
        for side in ("left", "bottom"):
            self.axes.spines[side].set_visible(False)

    def update(self, data: LarinDigits) -> None:
        self.axes.set_yticks(range(len(data.labels)), data.labels)
        self.axes.set_ylim(len(data.labels) - 0.5, -0.5)
        row, column = np.nonzero(data.agrees)
        self.axes.plot(column, row, "o", color=BLUE, markersize=9)
        row, column = np.nonzero(data.agrees == 0)
        self.axes.plot(column, row, "x", color=GREY, markersize=5)


def _pretty(name: str) -> str:
    stars = name.count("*")
    return rf"$\sigma_{name[5]}^{{{'*' * stars}}}$"
