"""One calibration by turns: estimated against true non-orthogonality, with noise repeated."""

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

VALUE_REACHES = (1.5, 3.0, 5.0, 15.0, 50.0, 200.0)
"""How far the axis of the estimates may reach, mrad."""


class TurnEstimatesPicture(Picture):
    """Estimates over true values, and their errors."""

    size = (9.6, 3.8)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic("ab", self.size, (0.075, 0.1, 0.985, 0.9))
        values, errors = panels["a"], panels["b"]
        self.values_axes, self.errors_axes = values, errors
        names = [r"$\sigma_1$", r"$\sigma_2$", r"$\sigma_3$"]
        values.set(title="found and true, mrad")
        errors.set(title="error, ″")
        for axes in (values, errors):
            axes.set(xlim=(-0.6, 2.6), xticks=[0, 1, 2])
            axes.set_xticklabels(names)
            axes.axhline(0, color=BLACK, linewidth=0.8, label=GUIDE)
        dot = {"color": BLUE, "linestyle": "none", "marker": "o", "fillstyle": "none"}
        dash = 20 if self.sheet.on_paper else 26
        self.curve(
            values, range(3), "true", color=BLACK, linestyle="none", marker="_", markersize=dash,
            markeredgewidth=2, label="true",
        )  # fmt: skip
        self.runs = [
            self.curve(values, (), "found", **dot, label="found, each run"),
            self.curve(errors, (), "error", **dot, label="each run"),
        ]
        mean = {"color": VERMILION, "linestyle": "none", "marker": "D", "fillstyle": "none"}
        size = 6 if self.sheet.on_paper else 10
        self.curve(
            errors, range(3), "mean_error", **mean, markersize=size, label="mean of all runs"
        )
        room = {"below": 17.0, "handlelength": 2.8} if self.sheet.on_paper else {}
        for axes in (values, errors):
            legend_above(axes, 2, **room)

    def update(self, table: DataTable) -> None:
        self.show(table)
        count = len(table.found) // 3
        spread = np.linspace(-0.25, 0.25, count) if count > 1 else np.zeros(1)
        for line in self.runs:
            line.set_xdata((np.arange(3) + spread[:, np.newaxis]).ravel())
        values = np.append(table.shown("true"), table.shown("found"))
        self.set_reach(self.values_axes, "y", values, VALUE_REACHES)
        self.set_reach(self.errors_axes, "y", 1.1 * table.shown("error"))
