"""All 21 sensor errors of one calibration: what is left, and three standard deviations."""

from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro

from driftlab.book.machinery.picture import SERIES, Picture
from driftlab.checks import FloatArray

from .calibration_run import trial

UNITS = (
    ("gyro bias", degree / hour, "deg/h"),
    ("gyro scale", micro, "ppm"),
    ("gyro", arcsecond, "arc seconds"),
    ("accelerometer bias", micro * g, "µg"),
    ("accelerometer scale", micro, "ppm"),
    ("accelerometer", arcsecond, "arc seconds"),
)
"""Beginning of a state's name, its unit in SI, and the unit's name; the first that fits."""


def unit_of(name: str) -> tuple[float, str]:
    """Size in SI and name of the unit in which a sensor error is usually given."""
    return next((size, unit) for start, size, unit in UNITS if name.startswith(start))


class CalibrationErrors(NamedTuple):
    """Histories of the sensor errors, in states of the averaged axes."""

    names: tuple[str, ...]
    times: FloatArray  # (k,), s
    errors: FloatArray  # (k, 21)
    deviations: FloatArray  # (k, 21)


def compute() -> CalibrationErrors:
    """The run of `calibration_run`, averaged axes."""
    found = trial("averaged")
    calibration = found.calibration
    return CalibrationErrors(
        calibration.model.names[6:],
        calibration.times,
        found.errors[:, 6:],
        calibration.deviations[:, 6:],
    )


def columns(data: CalibrationErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: each minute, in engineering units."""
    rows = slice(9, None, 10)
    table = {"time_s": data.times[rows]}
    for i, name in enumerate(data.names):
        size, _ = unit_of(name)
        table[f"error of {name}"] = (data.errors[rows, i] / size).round(3)
        table[f"deviation of {name}"] = (data.deviations[rows, i] / size).round(3)
    return table


class CalibrationErrorsPicture(Picture[CalibrationErrors]):
    """Seven rows of three small panels."""

    size = (10.5, 10.5)

    def build(self) -> None:
        self.panels = self.figure.subplots(7, 3, sharex=True)
        self.figure.subplots_adjust(0.065, 0.085, 0.99, 0.975, wspace=0.18, hspace=0.36)

    def update(self, data: CalibrationErrors) -> None:
        minutes = data.times / 60
        for panel, name, error, deviation in zip(
            self.panels.flat, data.names, data.errors.T, data.deviations.T, strict=True
        ):
            size, unit = unit_of(name)
            panel.plot(minutes, np.abs(error) / size, **SERIES[0], label="size of the error")
            panel.plot(
                minutes,
                3 * deviation / size,
                **SERIES[1],
                label="three standard deviations that the filter states",
            )
            bottom, top = deviation[-1] / size / 10, 6 * deviation[0] / size
            panel.set(yscale="log", ylim=(bottom, top), xlim=(0, minutes[-1]))
            panel.minorticks_off()
            panel.set_title(f"{name}, {unit}", fontsize=9)
        for panel in self.panels[-1]:
            panel.set_xlabel("time, minutes")
        handles, labels = self.panels[0, 0].get_legend_handles_labels()
        self.figure.legend(handles, labels, loc="lower center", ncols=2)
