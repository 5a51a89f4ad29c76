"""Errors of a calibration by turns: of the sigmas, run after run, and of all nine numbers."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import (
    BLACK,
    BLUE,
    GUIDE,
    VERMILION,
    Picture,
    legend_above,
)

from ..experiments import NINE


class TurnEstimatesPicture(Picture):
    """Errors of the sigmas by Larin's formula, and of all nine numbers by the summed increments."""

    size = (9.6, 3.8)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", self.size, (0.065, 0.12, 0.99, 0.9), width_ratios=(1, 1.6)
        )
        sigmas, nine = panels.values()
        self.sigmas_axes, self.nine_axes = sigmas, nine
        sigmas.set(title="(3.3): error, ″", xlim=(-0.6, 2.6), xticks=range(3))
        sigmas.set_xticklabels([r"$\sigma_1$", r"$\sigma_2$", r"$\sigma_3$"])
        nine.set(title="all nine: error, ″", xlim=(-0.6, 8.6), xticks=range(9))
        nine.set_xticklabels([name.replace(" ", "\n") for name in NINE])
        for axes in (sigmas, nine):
            axes.axhline(0, color=BLACK, linewidth=0.8, label=GUIDE)
        paper = self.sheet.on_paper
        dot = {"color": BLUE, "linestyle": "none", "marker": "o", "fillstyle": "none"}
        mean = {"color": VERMILION, "linestyle": "none", "marker": "D", "fillstyle": "none"}
        edge = {
            "color": BLACK,
            "linestyle": "none",
            "marker": "_",
            "markersize": 20 if paper else 26,
        }
        self.runs = self.curve(sigmas, (), "error", **dot, label="each run")
        self.curve(sigmas, range(3), "mean_error", **mean, markersize=6 if paper else 10,
                   label="mean")  # fmt: skip
        self.curve(nine, range(9), "nine_error", **dot, label="one run")
        self.curve(nine, range(9), "nine_spread", **edge, label="± one standard deviation")
        self.curve(nine, range(9), "-nine_spread", **edge, label="_the same below")
        legend_above(sigmas, 2, handlelength=2.8)
        legend_above(nine, 2, handlelength=2.8)

    def update(self, table: DataTable) -> None:
        self.show(table)
        count = len(table.found) // 3
        spread = np.linspace(-0.25, 0.25, count) if count > 1 else np.zeros(1)
        self.runs.set_xdata((np.arange(3) + spread[:, np.newaxis]).ravel())
        self.set_reach(self.sigmas_axes, "y", 1.1 * table.shown("error"))
        # Rounding alone needs no finer axis than this, in arc seconds.
        nine = np.concatenate([table.shown("nine_error"), table.shown("nine_spread"), [0.01]])
        self.set_reach(self.nine_axes, "y", 1.1 * nine)
