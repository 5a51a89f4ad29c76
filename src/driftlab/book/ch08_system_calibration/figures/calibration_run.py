"""One calibration by the 27-state filter: errors of the 21 sensor errors and what it says of them.

The picture is of one of them; `calibration_errors` shows all.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.simulation import TableTrial, Trial
from driftlab.checks import FloatArray
from driftlab.imu import TYPICAL

SEED = 20180501
"""Of the noise, and of the table's error in setting up."""

PARAMETERS = (
    *(f"gyro bias {axis}" for axis in "xyz"),
    *(f"gyro scale {axis}" for axis in "xyz"),
    *(f"gyro off-diagonal {i}" for i in (1, 2, 3)),
    *(f"accelerometer bias {axis}" for axis in "xyz"),
    *(f"accelerometer scale {axis}" for axis in "xyz"),
    *(f"accelerometer off-diagonal {places}" for places in ("xy", "xz", "yx", "yz", "zx", "zy")),
)
"""The 21 sensor errors of a model whose axes the gyros fix. What the three off-diagonal entries
of the gyros are depends on the axes."""


class CalibrationRun(NamedTuple):
    """History of one state."""

    name: str  # as the error model calls it
    times: FloatArray  # (k,), s
    estimate: FloatArray  # (k,)
    true: float
    before: float  # standard deviation before the calibration
    deviation: FloatArray  # (k,), as the filter states it
    shown: int  # index of the moment whose numbers are wanted


@lru_cache(maxsize=8)
def trial(frame: str = "averaged") -> Trial:
    """Calibrate the typical unit on the nineteen positions; the same noise for each frame."""
    table = TableTrial(frame=frame, sample_interval=0.1, keep=6)
    return table.run(np.random.default_rng(SEED), unit=TYPICAL)


def compute(
    parameter: str = "gyro bias x", frame: str = "averaged", minute: float = 40.0
) -> CalibrationRun:
    """History of one of `PARAMETERS`, and the moment nearest to a `minute` of it."""
    if parameter not in PARAMETERS:
        raise ValueError(f"parameter: expected one of {', '.join(PARAMETERS)}, got {parameter!r}.")
    found = trial(frame)
    model = ERROR_MODELS[frame]
    state = 6 + PARAMETERS.index(parameter)
    calibration = found.calibration
    estimate = calibration.state[:, state]
    table = TableTrial(frame=frame)
    before = model.covariance(table.spread, table.scheme.start_attitude)
    return CalibrationRun(
        model.names[state],
        calibration.times,
        estimate,
        float(estimate[-1] + found.errors[-1, state]),
        float(np.sqrt(before[state, state])),
        calibration.deviations[:, state],
        int(np.abs(calibration.times / 60 - minute).argmin()),
    )


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
