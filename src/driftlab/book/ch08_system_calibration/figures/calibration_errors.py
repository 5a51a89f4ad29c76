"""All 21 sensor errors of one calibration: what is left, and three standard deviations."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import CalibrationErrors, unit_of


def columns(data: CalibrationErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: each minute, in engineering units."""
    rows = slice(9, None, 10)
    table = {"time_s": data.times[rows]}
    for i, name in enumerate(data.names):
        size, _ = unit_of(name)
        table[f"error of {name}"] = (data.errors[rows, i] / size).round(3)
        table[f"deviation of {name}"] = (data.deviations[rows, i] / size).round(3)
    return table


@in_style
def draw(data: CalibrationErrors, sheet: Sheet) -> Figure:
    """Draw seven rows of three small panels."""
    figure = Figure(figsize=(10.5, 10.5))
    panels = figure.subplots(7, 3, sharex=True)
    figure.subplots_adjust(0.065, 0.085, 0.99, 0.975, wspace=0.18, hspace=0.36)
    minutes = data.times / 60
    for panel, name, error, deviation in zip(
        panels.flat, data.names, data.errors.T, data.deviations.T, strict=True
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
    for panel in panels[-1]:
        panel.set_xlabel("time, minutes")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=2)
    return figure
