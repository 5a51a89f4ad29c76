"""Functional iteration: drift by samples a round, and what noise of the increments does to it."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, degree, hour

from driftlab.book.machinery.picture import GREY, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import WIDE_BRACKET, WINDOW_ALGORITHMS, WindowErrors
from .algorithm_laboratory import STYLES

DEGREE_PER_HOUR = degree / hour
KNOWN = {name: STYLES[name] for name in WINDOW_ALGORITHMS if name in STYLES}
WIDTHS = [name for name in WINDOW_ALGORITHMS if name not in KNOWN]
LINES = KNOWN | {
    name: {**SERIES[i], "marker": marker, "markersize": 4.5}
    for name, i, marker in zip(WIDTHS, (2, 0, 5, 7), "x*pd", strict=True)
}
"""Line style of each algorithm."""


def columns(data: WindowErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, but for the widest window."""
    curves = {}
    # The widest magnifies rounding a hundred thousand times, and that differs by machine.
    for i, name in enumerate(list(WINDOW_ALGORITHMS)[:-1]):
        for what, x, y in (
            ("drift in rad/s over samples a round", data.samples, data.drifts[i]),
            ("error in rad over noise in rad", data.sizes, data.noisy[i]),
        ):
            seen = ~np.isnan(y)
            curves[f"{name}, {what}"] = (x[seen], y[seen])
    return long_table(curves)


@in_style
def draw(data: WindowErrors, sheet: Sheet) -> Figure:
    """Draw drift over samples a round, and error over noise."""
    figure = Figure(figsize=(10.5, 4.8))
    drift, noise = figure.subplots(1, 2)
    figure.subplots_adjust(0.075, 0.22, 0.985, 0.92, wspace=0.22)
    drift.set(title=f"cone of {np.degrees(WIDE_BRACKET.half_angle):g}°, true increments")
    drift.set(xlabel="samples a round", ylabel="apparent drift, deg/h", ylim=(1e-10, 1e6))
    noise.set(title="white noise", xlabel="deviation of an increment, arc seconds")
    noise.set(ylabel="error of attitude, arc seconds")
    sizes = data.sizes / arcsecond
    # Wide and pale, behind the curves that lie on it.
    sums = data.added_up / arcsecond
    noise.plot(sizes, sums, color=GREY, alpha=0.35, linewidth=7, label="the noise, added up")
    for i, (name, style) in enumerate(LINES.items()):
        drift.plot(data.samples, data.drifts[i] / DEGREE_PER_HOUR, **style, markevery=3)
        noise.plot(sizes, data.noisy[i] / arcsecond, **style, label=name)
    for panel in (drift, noise):
        panel.set(xscale="log", yscale="log")
    drift.minorticks_off()
    drift.set_xticks([2.5, 5, 10, 20, 40], ["2.5", "5", "10", "20", "40"])
    figure.legend(*noise.get_legend_handles_labels(), loc="lower center", ncols=4, fontsize=8)
    return figure
