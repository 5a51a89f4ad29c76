"""A ship gathers way and turns: Schuler's tuning, and two horizons that are tuned otherwise."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcminute, minute

from driftlab.book.machinery.picture import SERIES, in_style
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray

from ..experiments import BallisticError
from .operation import shade_manoeuvres


def columns(data: BallisticError) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each two minutes."""
    rows = slice(29, None, 30)
    table = {"time_s": next(iter(data.runs.values())).times[rows]}
    for name, run in data.runs.items():
        table[f"tilt_east_arcmin, {name}"] = (run.tilt[rows, 1] / arcminute).round(6)
        table[f"heading_error_deg, {name}"] = np.degrees(run.heading_error[rows]).round(7)
    return table


@in_style
def draw(data: BallisticError) -> Figure:
    """Tilt about East and heading error."""
    figure = Figure(figsize=(10.5, 3.9))
    tilt, heading = figure.subplots(1, 2)
    figure.subplots_adjust(0.06, 0.23, 0.985, 0.91, wspace=0.16)
    tilt.set_title("tilt about East, arc minutes")
    heading.set_title("heading error without speed error, degrees")
    for panel in (tilt, heading):
        panel.set(xlabel="time, minutes", xlim=(0, DURATION / minute), ylim=(-6, 6))
        shade_manoeuvres(panel)
    for (name, run), style in zip(data.runs.items(), SERIES, strict=False):
        minutes = run.times / minute
        tilt.plot(minutes, run.tilt[:, 1] / arcminute, **style, label=name)
        heading.plot(minutes, np.degrees(run.heading_error), **style)
    handles, labels = tilt.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=5)
    return figure
