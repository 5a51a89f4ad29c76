"""What a turn between two rests makes of the heading: over its angle, and over the time."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, SERIES

TICKS = tuple(k * 10.0**power for power in range(-6, 2) for k in (1, 2, 5))
"""Marks at the axes of the spread, degrees."""


@from_table
def draw(drawing: Drawing) -> None:
    """Deviations as markers for the simulation and lines for the formulas."""
    table = drawing.table
    panels = drawing.mosaic(
        "ab", (10.0, 4.0), (0.075, 0.13, 0.985, 0.92), spaces=(0.2, 0.2), column_height=5.0,
        page_height=3.0,
    )  # fmt: skip
    left, right = panels["a"], panels["b"]
    by_turn = _pairs(drawing, left, "turn")
    left.set(yscale="log", xlim=(0, 185), xticks=range(0, 181, 30), xlabel="turn, degrees")
    left.set(title=f"{table.shown('duration'):g} minutes, over the turn")
    left.set(ylabel="spread of the heading, degrees")
    name, words = "white_noise_alone", "white noise alone"
    drawing.curve(right, "time", name, color=GREY, linewidth=0.9, linestyle=":", label=words)
    right.text(table.time[-2], table.shown(name)[-2] * 0.9, words, fontsize="small", color=GREY,
               ha="right", va="top")  # fmt: skip
    by_time = _pairs(drawing, right, "time")
    right.set(xscale="log", yscale="log", xlabel="time of the alignment, s", title="over the time")
    for panel, marks in ((left, by_turn), (right, by_time)):
        shown = np.concatenate([np.ravel(line.get_ydata()) for line in panel.lines])
        low, high = min(0.002, shown.min() / 1.2), max(0.2, 1.2 * shown.max())
        ticks = [tick for tick in TICKS if 0.999 * low < tick < 1.001 * high]
        panel.set(ylim=(low, high), yticks=ticks if len(ticks) < 12 else ticks[::3])
        panel.yaxis.set_major_formatter("{x:g}")
        panel.yaxis.set_minor_formatter("")
        below = drawing.sheet.narrow and panel is right  # where nothing lies in a low panel
        panel.legend(handles=marks, loc="lower left" if below else "upper right",
                     fontsize="small", labelspacing=0.3)  # fmt: skip


def _pairs(drawing: Drawing, panel: Axes, over: str) -> list[Line2D]:
    """Draw curves and their marks, and return the marks."""
    marks = []
    names, _ = drawing.table.entry(f"by_{over}").names
    for name, style, marker in zip(names, SERIES, "os^", strict=False):
        title = f"by_{over}, {name}"
        drawing.curve(panel, over, f"{title}, formula", **style, label=f"{name}, formula")
        mark = {"color": style["color"], "marker": marker, "markersize": 4.5, "label": name}
        marks += [drawing.curve(panel, over, f"{title}, simulated", linestyle="none", **mark)]
    return marks
