"""A ship gathers way and turns: Schuler's tuning, and two horizons that are tuned otherwise."""

from typing import Any, NamedTuple

import numpy as np
from scipy.constants import arcminute, minute

from driftlab.book.ch10_gyrocompass_at_work.figures import operation
from driftlab.book.machinery.picture import SERIES, Picture
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import ErrorsUnderWay

SPEED = 10.0
TUNINGS: dict[str, dict[str, Any]] = {
    "Schuler: k2 = 1/R": {},
    "Schuler, with a log": {"log": True},
    "too stiff: k2 = 2/R": {"tuning_factor": 2.0},
    "too soft: k2 = 0.5/R": {"tuning_factor": 0.5},
    "damped: k2 = 1/R, ratio 0.5": {"damping": 0.5},
}


class BallisticError(NamedTuple):
    """By tuning."""

    runs: dict[str, ErrorsUnderWay]


def compute() -> BallisticError:
    """Perfect sensors, one voyage, five horizons."""
    return BallisticError(
        {
            name: operation.compute(speed=SPEED, drift=np.zeros(3), **tuning)
            for name, tuning in TUNINGS.items()
        }
    )


def columns(data: BallisticError) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each two minutes."""
    rows = slice(29, None, 30)
    table = {"time_s": next(iter(data.runs.values())).times[rows]}
    for name, run in data.runs.items():
        table[f"tilt_east_arcmin, {name}"] = (run.tilt[rows, 1] / arcminute).round(6)
        table[f"heading_error_deg, {name}"] = np.degrees(run.heading_error[rows]).round(7)
    return table


class BallisticErrorPicture(Picture[BallisticError]):
    """Tilt about East and heading error."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.06, 0.23, 0.985, 0.91, wspace=0.16)
        for panel, title in zip(
            self.panels,
            ("tilt about East, arc minutes", "heading error without speed deviation, degrees"),
            strict=True,
        ):
            panel.set(title=title, xlabel="time, minutes", xlim=(0, 120), ylim=(-6, 6))
            operation.shade_manoeuvres(panel)

    def update(self, data: BallisticError) -> None:
        tilt, heading = self.panels
        for (name, run), style in zip(data.runs.items(), SERIES, strict=False):
            minutes = run.times / minute
            tilt.plot(minutes, run.tilt[:, 1] / arcminute, **style, label=name)
            heading.plot(minutes, np.degrees(run.heading_error), **style)
        handles, labels = tilt.get_legend_handles_labels()
        self.figure.legend(handles, labels, loc="lower center", ncols=5, fontsize=8)
