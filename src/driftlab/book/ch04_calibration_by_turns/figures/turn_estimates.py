"""One calibration by turns: estimated against true non-orthogonality, with noise repeated."""

from typing import Any

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.machinery.picture import BLACK, BLUE, GUIDE, VERMILION, Picture, legend_above
from driftlab.checks import FloatArray

from ..experiments import TurnEstimates

VALUE_REACHES = (1.5, 3.0, 5.0, 15.0, 50.0, 200.0)
"""How far the axis of the estimates may reach, mrad."""


def columns(data: TurnEstimates) -> dict[str, Any]:
    """Columns of the figure's CSV: the three sigmas of each run, below each other."""
    runs = drawn_runs(data)
    errors = (runs - data.true) / arcsecond
    return {
        "sigma": np.tile(["sigma1", "sigma2", "sigma3"], len(runs)),
        "found_mrad": 1e3 * runs.ravel(),
        "error_arcsec": errors.ravel(),
        "true_mrad": 1e3 * data.true,
        "mean_error_arcsec": errors.mean(axis=0),
    }


def drawn_runs(data: TurnEstimates) -> FloatArray:
    """Runs (n, 3) that are drawn: without noise all are one, and one dot shows it."""
    return data.runs if np.ptp(data.runs, axis=0).any() else data.runs[:1]


class TurnEstimatesPicture(Picture[TurnEstimates]):
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
        self.true = self.line(values, color=BLACK, linestyle="none", marker="_", markersize=dash,
                              markeredgewidth=2, label="true")  # fmt: skip
        self.runs = self.line(values, **dot, label="found, each run")
        self.run_errors = self.line(errors, **dot, label="each run")
        mean = {"color": VERMILION, "linestyle": "none", "marker": "D", "fillstyle": "none"}
        self.mean_error = self.line(
            errors, **mean, markersize=6 if self.sheet.on_paper else 10, label="mean of all runs"
        )
        for axes in (values, errors):
            legend_above(
                axes, 2, **({"below": 17.0, "handlelength": 2.8} if self.sheet.on_paper else {})
            )

    def update(self, data: TurnEstimates) -> None:
        index, runs, table = np.arange(3), drawn_runs(data), columns(data)
        spread = np.linspace(-0.25, 0.25, len(runs)) if len(runs) > 1 else np.zeros(1)
        places = (index + spread[:, np.newaxis]).ravel()
        self.true.set_data(index, table["true_mrad"])
        self.runs.set_data(places, table["found_mrad"])
        self.run_errors.set_data(places, table["error_arcsec"])
        self.mean_error.set_data(index, table["mean_error_arcsec"])
        values = np.append(table["true_mrad"], table["found_mrad"])
        self.set_reach(self.values_axes, "y", values, VALUE_REACHES)
        self.set_reach(self.errors_axes, "y", 1.1 * table["error_arcsec"])
