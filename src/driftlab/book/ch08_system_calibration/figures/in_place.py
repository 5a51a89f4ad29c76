"""A calibrated unit navigates in place, with two choices of body axes; Wu Figs. 3-5."""

from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond, hour, kilo

from driftlab.book.machinery.picture import SERIES, Picture
from driftlab.calibration.error_model import attitude_of_axes
from driftlab.calibration.simulation import unit_in_axes
from driftlab.calibration.static_navigation import InPlace, navigate_in_place
from driftlab.checks import FloatArray
from driftlab.imu import TYPICAL, Unit
from driftlab.triad import body_frame_rotation

from .calibration_run import trial

LATITUDE = float(np.radians(37.5))
DURATION = 4 * hour
TABLE: FloatArray = np.array([0.0, 0.0, 0.0, 1.0])
"""Attitude in which the unit stands: the table's axes are East, North, Up."""
FRAMES = {"averaged": "averaged axes", "upper triangle": "usual axes"}
STARTS = ("one attitude", "the table's axes")
"""One attitude: both computers believe the same of the unit, each in its own axes."""
PANELS = (
    ("attitude East", "attitude", 0, arcsecond, "arc seconds"),
    ("attitude North", "attitude", 1, arcsecond, "arc seconds"),
    ("attitude Up", "attitude", 2, arcsecond, "arc seconds"),
    ("velocity East", "velocity", 0, 1.0, "m/s"),
    ("velocity North", "velocity", 1, 1.0, "m/s"),
    ("position East", "position", 0, kilo, "km"),
    ("position North", "position", 1, kilo, "km"),
)


class InPlaceErrors(NamedTuple):
    """By choice of axes and by what the computer takes for its attitude at the start."""

    runs: dict[tuple[str, str], InPlace]


def compute() -> InPlaceErrors:
    """Take the typical unit, as `calibration_run` found it, through four hours at rest."""
    runs = {}
    for frame in FRAMES:
        found = trial(frame).calibration.unit
        _, turn = unit_in_axes(TYPICAL, frame)
        own = attitude_of_axes(TABLE, turn)
        if frame == "averaged":
            first, found_first = own, found
        one = same_attitude(first, found_first, frame)
        for start, axes in zip(STARTS, (one, TABLE), strict=True):
            runs[frame, start] = navigate_in_place(
                TYPICAL, found, TABLE, start=axes, reference=axes,
                latitude=LATITUDE, duration=DURATION,
            )  # fmt: skip
    return InPlaceErrors(runs)


def same_attitude(attitude: FloatArray, found: Unit, frame: str) -> FloatArray:
    """Attitude (..., 4) of other axes that says the same of the unit as `attitude` (..., 4).

    The way from the axes of `found` to those of `frame` is what the found errors say; the true
    errors would bring in what the calibration has left over.
    """
    if frame == "averaged":
        return attitude
    turn = body_frame_rotation(found.gyro_error, found.accelerometer_error, frame)
    return attitude_of_axes(attitude, turn)


def columns(data: InPlaceErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each five minutes."""
    rows = slice(4, None, 5)
    first = next(iter(data.runs.values()))
    table = {"time_s": first.times[rows]}
    for (frame, start), run in data.runs.items():
        for title, quantity, axis, unit, name in PANELS:
            values = getattr(run, quantity)[rows, axis] / unit
            table[f"{title} in {name}, {FRAMES[frame]}, start from {start}"] = values.round(3)
    return table


class InPlacePicture(Picture[InPlaceErrors]):
    """Seven panels: three of attitude, two of velocity, two of position."""

    size = (10.5, 5.4)

    def build(self) -> None:
        panels = self.figure.subplots(2, 4, sharex=True)
        self.figure.subplots_adjust(0.055, 0.1, 0.99, 0.94, wspace=0.27, hspace=0.25)
        panels[0, 3].axis("off")
        self.panels = [*panels[0, :3], *panels[1]]
        self.corner = panels[0, 3]
        for panel, (title, *_, unit) in zip(self.panels, PANELS, strict=True):
            panel.set_title(f"{title}, {unit}", fontsize=9)
            panel.set_xlim(0, DURATION / hour)
        for panel in panels[1]:
            panel.set_xlabel("time, hours")

    def update(self, data: InPlaceErrors) -> None:
        for (frame, start), style in zip(data.runs, SERIES, strict=False):
            run = data.runs[frame, start]
            label = f"{FRAMES[frame]},\nstart: {start}"
            for panel, (_, quantity, axis, unit, _) in zip(self.panels, PANELS, strict=True):
                values = getattr(run, quantity)[:, axis] / unit
                panel.plot(run.times / hour, values, **style, label=label)
        handles, labels = self.panels[0].get_legend_handles_labels()
        self.corner.legend(handles, labels, loc="center", labelspacing=1.0, fontsize=8)
