"""Several horizons on one voyage: tunings that feel that a ship gathers way, and dampings."""

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcminute, minute

from driftlab.book.machinery.picture import SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray

from ..experiments import Horizons
from .operation import shade_manoeuvres


def columns(data: Horizons) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each two minutes."""
    rows = slice(29, None, 30)
    table = {"time_s": next(iter(data.runs.values())).times[rows]}
    for name, run in data.runs.items():
        table[f"tilt_east_arcmin, {name}"] = (run.tilt[rows, 1] / arcminute).round(6)
        table[f"heading_error_deg, {name}"] = np.degrees(run.heading_error[rows]).round(7)
    return table


def drawn_within(tilt_reach: float, heading_reach: float) -> Callable[[Horizons], Figure]:
    """Return what draws tilt about East and heading error within arc minutes and degrees."""

    @in_style
    def draw(data: Horizons, sheet: Sheet) -> Figure:
        figure = Figure(figsize=(10.5, 3.9))
        tilt, heading = figure.subplots(1, 2)
        figure.subplots_adjust(0.06, 0.23, 0.985, 0.91, wspace=0.16)
        tilt.set(title="tilt about East, arc minutes", ylim=(-tilt_reach, tilt_reach))
        heading.set(title="heading error without speed error, degrees")
        heading.set(ylim=(-heading_reach, heading_reach))
        for panel in (tilt, heading):
            panel.set(xlabel="time, minutes", xlim=(0, DURATION / minute))
            shade_manoeuvres(panel)
        for (name, run), style in zip(data.runs.items(), SERIES, strict=False):
            minutes = run.times / minute
            tilt.plot(minutes, run.tilt[:, 1] / arcminute, **style, label=name)
            heading.plot(minutes, np.degrees(run.heading_error), **style)
        handles, labels = tilt.get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower center", ncols=5)
        return figure

    return draw
