"""One calibration by turns: estimated against true non-orthogonality, with noise repeated."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.machinery.picture import BLACK, BLUE, VERMILION, Picture, legend_above
from driftlab.checks import FloatArray

from ..experiments import TurnEstimates

VALUE_REACHES = (1.5, 3.0, 5.0, 15.0, 50.0, 200.0)
"""How far the axis of the estimates may reach, mrad."""


def columns(data: TurnEstimates) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    return {
        "true": data.true,
        "mean_estimate": data.runs.mean(axis=0),
        "deviation": data.runs.std(axis=0),
    }


class TurnEstimatesPicture(Picture[TurnEstimates]):
    """Estimates over true values, and their errors."""

    size = (9.6, 3.8)

    def build(self) -> None:
        values, errors = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.075, 0.1, 0.985, 0.9, wspace=0.2)
        self.values_axes, self.errors_axes = values, errors
        names = [r"$\sigma_1$", r"$\sigma_2$", r"$\sigma_3$"]
        values.set(title="found and true, mrad")
        errors.set(title="error, ″")
        for axes in (values, errors):
            axes.set(xlim=(0.4, 3.6), xticks=[1, 2, 3])
            axes.set_xticklabels(names)
            axes.axhline(0, color=BLACK, linewidth=0.8)
        dot = {"color": BLUE, "linestyle": "none", "marker": "o", "fillstyle": "none"}
        self.true = self.line(values, color=BLACK, linestyle="none", marker="_", markersize=26,
                              markeredgewidth=2, label="true")  # fmt: skip
        self.runs = self.line(values, **dot, label="found, each run")
        self.run_errors = self.line(errors, **dot, label="each run")
        mean = {"color": VERMILION, "linestyle": "none", "marker": "D", "fillstyle": "none"}
        self.mean_error = self.line(errors, **mean, markersize=10, label="mean of all runs")
        for axes in (values, errors):
            legend_above(axes, 2)

    def update(self, data: TurnEstimates) -> None:
        index = np.arange(1, 4)
        # Without noise all runs are one, and one dot shows it.
        runs = data.runs if np.ptp(data.runs, axis=0).any() else data.runs[:1]
        spread = np.linspace(-0.25, 0.25, len(runs)) if len(runs) > 1 else np.zeros(1)
        places = (index + spread[:, np.newaxis]).ravel()
        self.true.set_data(index, 1e3 * data.true)
        self.runs.set_data(places, 1e3 * runs.ravel())
        errors = (runs - data.true) / arcsecond
        self.run_errors.set_data(places, errors.ravel())
        self.mean_error.set_data(index, errors.mean(axis=0))
        self.set_reach(self.values_axes, "y", 1e3 * np.vstack([data.true, runs]), VALUE_REACHES)
        self.set_reach(self.errors_axes, "y", 1.1 * errors)
