"""Functional iteration: drift by samples a round, and what noise of the increments does to it."""

from collections.abc import Iterable
from itertools import cycle
from typing import Any

import numpy as np

from driftlab.book.ch07_coning.figures.algorithm_laboratory import styles
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, SERIES, decades, legend_below_all
from driftlab.book.machinery.figure.sheet import Sheet

WIDTHS = tuple(
    {**SERIES[i], "marker": marker, "markersize": 4.5}
    for i, marker in zip((2, 0, 5, 7), "x*pd", strict=True)
)
"""Line styles of the windows, from the narrowest to the widest."""
LOW, HIGH = 1e-10, 1e6
"""Least reach of the axis of the drift, deg/h; it reaches down no farther."""


def _styles(names: Iterable[str], sheet: Sheet) -> dict[str, dict[str, Any]]:
    widths = cycle(WIDTHS)
    windows = {name: next(widths) for name in names if name.startswith("window of ")}
    return styles([name for name in names if name not in windows], sheet) | windows


@from_table
def draw(drawing: Drawing) -> None:
    """Draw drift over samples a round, and error over noise."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 4.8), (0.075, 0.22, 0.985, 0.92), spaces=(0.22, 0.2), column_height=5.6,
        page_height=3.8,
    )  # fmt: skip
    drift, noise = panels["a"], panels["b"]
    drift.set(title=f"cone of {table.words('half_angle', 'g')}, true increments")
    drift.set(xlabel="samples a round", ylabel="apparent drift, deg/h")
    noise.set(title="white noise", xlabel="deviation of an increment, arc seconds")
    noise.set(ylabel="error of attitude, arc seconds")
    # Wide and pale, behind the curves that lie on it.
    wide: dict[str, Any] = {"color": GREY, "alpha": 0.35, "linewidth": 7}
    drawing.curve(noise, "noise", "noise_added_up", **wide, label="the noise, added up")
    for name, style in _styles(table.drift, sheet).items():
        drawing.curve(drift, "samples_a_round", f"drift, {name}", **style, markevery=3, label=name)
        drawing.curve(noise, "noise", f"error, {name}", **style, label=name)
    for panel in (drift, noise):
        panel.set(xscale="log", yscale="log")
    drifts = np.concatenate([table.shown(f"drift, {name}") for name in table.drift])
    drift.set_ylim(LOW, decades(drifts, LOW, HIGH)[1])
    drift.minorticks_off()
    drift.set_xticks([2.5, 5, 10, 20, 40], ["2.5", "5", "10", "20", "40"])
    legend_below_all(drawing.figure, sheet, noise, points=8)
