"""One calibration by turns: estimated against true non-orthogonality, with noise repeated."""

import numpy as np

from driftlab.book.machinery.picture import BLACK, BLUE, VERMILION, Picture
from driftlab.checks import FloatArray

from ..experiments import TurnEstimates


def columns(data: TurnEstimates) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    return {
        "true": data.true,
        "mean_estimate": data.runs.mean(axis=0),
        "deviation": data.runs.std(axis=0),
    }


class TurnEstimatesPicture(Picture[TurnEstimates]):
    """Estimates over true values, and their errors on a logarithmic axis."""

    size = (9.0, 3.8)

    def build(self) -> None:
        values, errors = self.figure.subplots(1, 2, gridspec_kw={"width_ratios": [1, 1.1]})
        self.figure.subplots_adjust(0.08, 0.14, 0.985, 0.9, wspace=0.28)
        names = [r"$\sigma_1$", r"$\sigma_2$", r"$\sigma_3$"]
        values.set(title="true and estimated", ylabel=r"$10^{-3}$ rad", ylim=(-4.5, 4.5))
        errors.set(title="size of the error", ylabel="rad", yscale="log", ylim=(1e-9, 1))
        for axes in (values, errors):
            axes.set(xlim=(0.4, 3.6), xticks=[1, 2, 3])
            axes.set_xticklabels(names)
        dot = {"color": BLUE, "linestyle": "none", "marker": "o", "markersize": 4}
        self.runs = self.line(values, **dot, label="estimated, each run")
        self.run_errors = self.line(errors, **dot, label="each run")
        true = {"color": BLACK, "linestyle": "none", "marker": "_", "markersize": 14}
        self.true = self.line(values, **true, markeredgewidth=2, label="true")
        mean = {"color": VERMILION, "linestyle": "none", "marker": "D", "fillstyle": "none"}
        self.mean_error = self.line(errors, **mean, markersize=9, label="of the mean of all runs")
        values.legend(loc="lower left")
        errors.legend(loc="upper left")

    def update(self, data: TurnEstimates) -> None:
        index = np.arange(1, 4)
        spread = np.linspace(-0.25, 0.25, len(data.runs))
        places = (index + spread[:, np.newaxis]).ravel()
        floor = 1e-9
        self.true.set_data(index, 1e3 * data.true)
        self.runs.set_data(places, 1e3 * data.runs.ravel())
        sizes = np.maximum(np.abs(data.runs - data.true), floor)
        self.run_errors.set_data(places, sizes.ravel())
        mean = np.maximum(np.abs(data.runs.mean(axis=0) - data.true), floor)
        self.mean_error.set_data(index, mean)
