"""Accelerated alignment, then Schuler's tuning: how noise becomes a swing that nothing damps."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import SETTLING, WORKING, Settling


def columns(data: Settling) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the right panel, each four minutes."""
    rows = slice(3, None, 4)
    return {
        "time_s": data.times[rows],
        "formula_deg": np.degrees(data.deviation[rows]).round(8),
        "simulated_deg": np.degrees(data.heading.std(axis=0)[rows]).round(7),
    }


@in_style
def draw(data: Settling, sheet: Sheet) -> Figure:
    """The horizon settles; and what noise does to the heading afterwards."""
    figure = Figure(figsize=(10.5, 3.8))
    left, right = figure.subplots(1, 2)
    figure.subplots_adjust(0.065, 0.14, 0.985, 0.91, wspace=0.17)
    left.set(title="accelerated alignment without noise, degrees", xlabel="time, minutes")
    left.set(yscale="log", ylim=(1e-6, 200), xlim=(0, SETTLING / minute))
    right.set(title="then Schuler's tuning, with noise: heading error, degrees")
    right.set(xlabel="time since then, minutes", xlim=(0, WORKING / minute))
    minutes = data.settling_times / minute
    left.plot(minutes, np.degrees(data.settling_heading), **SERIES[0],
              label="heading error")  # fmt: skip
    left.plot(minutes, np.degrees(data.tilt), **SERIES[1], label="tilt")
    left.legend(loc="upper right")
    minutes = data.times / minute
    right.plot(minutes, np.degrees(data.heading.T), color=GREY, linewidth=0.5, alpha=0.6)
    spread, bound = np.degrees(data.heading.std(axis=0)), np.degrees(data.deviation)
    names = "formula, one deviation", f"deviation of {len(data.heading)} runs"
    for sign, (formula, simulated) in ((1, names), (-1, (None, None))):
        right.plot(minutes, sign * bound, **SERIES[1], label=formula)
        right.plot(minutes, sign * spread, color=BLACK, label=simulated)
    right.legend(loc="upper left")
    return figure
