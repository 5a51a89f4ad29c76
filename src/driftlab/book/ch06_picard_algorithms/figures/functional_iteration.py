"""Functional iteration: drift by samples a round, and what noise of the increments does to it."""

from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, degree, hour

from driftlab.book.machinery.picture import GREY, SERIES, decades, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import WindowErrors
from .algorithm_laboratory import styles

DEGREE_PER_HOUR = degree / hour
WIDTHS = tuple(
    {**SERIES[i], "marker": marker, "markersize": 4.5}
    for i, marker in zip((2, 0, 5, 7), "x*pd", strict=True)
)
"""Line styles of the windows, from the narrowest to the widest."""
LOW, HIGH = 1e-10, 1e6
"""Least reach of the axis of the drift, deg/h; it reaches down no farther."""


def columns(data: WindowErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV; nothing where an algorithm refuses."""
    table = {"samples_a_round": data.samples}
    for name, drift in zip(data.names, data.drifts, strict=True):
        table[f"drift_deg_per_h, {name}"] = drift / DEGREE_PER_HOUR
    table["noise_arcsec"] = data.sizes / arcsecond
    for name, error in zip(data.names, data.noisy, strict=True):
        table[f"error_arcsec, {name}"] = error / arcsecond
    return table | {"noise_added_up_arcsec": data.added_up / arcsecond}


def _styles(names: tuple[str, ...], sheet: Sheet) -> dict[str, dict[str, Any]]:
    widths = cycle(WIDTHS)
    windows = {name: next(widths) for name in names if name.startswith("window of ")}
    return styles([name for name in names if name not in windows], sheet) | windows


@in_style
def draw(data: WindowErrors, sheet: Sheet) -> Figure:
    """Draw drift over samples a round, and error over noise."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.8), (0.075, 0.22, 0.985, 0.92), spaces=(0.22, 0.2), column_height=5.6,
        page_height=3.8,
    )  # fmt: skip
    drift, noise = panels["a"], panels["b"]
    drift.set(title=f"cone of {np.degrees(data.cone.half_angle):g}°, true increments")
    drift.set(xlabel="samples a round", ylabel="apparent drift, deg/h")
    noise.set(title="white noise", xlabel="deviation of an increment, arc seconds")
    noise.set(ylabel="error of attitude, arc seconds")
    sizes = data.sizes / arcsecond
    # Wide and pale, behind the curves that lie on it.
    sums = data.added_up / arcsecond
    noise.plot(sizes, sums, color=GREY, alpha=0.35, linewidth=7, label="the noise, added up")
    for name, style in _styles(data.names, sheet).items():
        i = data.names.index(name)
        shown = data.drifts[i] / DEGREE_PER_HOUR
        drift.plot(data.samples, shown, **style, markevery=3, label=name)
        noise.plot(sizes, data.noisy[i] / arcsecond, **style, label=name)
    for panel in (drift, noise):
        panel.set(xscale="log", yscale="log")
    drift.set_ylim(LOW, decades(data.drifts / DEGREE_PER_HOUR, LOW, HIGH)[1])
    drift.minorticks_off()
    drift.set_xticks([2.5, 5, 10, 20, 40], ["2.5", "5", "10", "20", "40"])
    legend_below_all(figure, sheet, noise, points=8)
    return figure
