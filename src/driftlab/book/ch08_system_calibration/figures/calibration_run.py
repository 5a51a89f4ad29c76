"""One sensor error in a calibration by the 27-state filter: its error, and what the filter says.

`calibration_errors` shows all of them.
"""

import numpy as np

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture

from ..experiments import CalibrationRun


class CalibrationRunPicture(Picture[CalibrationRun]):
    """Size of the error beside three deviations, and the error in deviations."""

    size = (10.5, 4.0)

    def build(self) -> None:
        size, ratio = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.075, 0.23, 0.985, 0.91, wspace=0.2)
        size.set(title="error, in standard deviations known before", yscale="log", ylim=(1e-5, 10))
        ratio.set(title="error, in standard deviations the filter states", ylim=(-4.2, 4.2))
        for panel in (size, ratio):
            panel.set(xlabel="time, minutes", xlim=(0, 41))
        for bound in (-3, 3):
            ratio.axhline(bound, color=BLACK, linestyle="--", linewidth=1.2)
        self.error = self.line(size, **SERIES[0], label="size of the error")
        self.bound = self.line(size, **SERIES[1], label="three deviations that the filter states")
        self.ratio = self.line(ratio, **SERIES[0])
        self.marks = [
            self.line(panel, color=GREY, linewidth=1.0, linestyle=(0, (2, 2)))
            for panel in (size, ratio)
        ]
        size.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)

    def update(self, data: CalibrationRun) -> None:
        minutes = data.times / 60
        error = data.true - data.estimate
        self.error.set_data(minutes, np.abs(error) / data.before)
        self.bound.set_data(minutes, 3 * data.deviation / data.before)
        self.ratio.set_data(minutes, error / data.deviation)
        here = minutes[data.shown]
        self.marks[0].set_data([here, here], [1e-5, 10])
        self.marks[1].set_data([here, here], [-4.2, 4.2])
