"""Accelerated alignment, then Schuler's tuning: how noise becomes a swing that nothing damps."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES

LEAST, MOST = 1e-6, 200.0
"""Reach of what settles, degrees; less is drawn nowhere."""


@from_table
def draw(drawing: Drawing) -> None:
    """The horizon settles; and what noise does to the heading afterwards."""
    table, on_paper = drawing.table, drawing.sheet.on_paper
    panels = drawing.mosaic(
        "ab", (10.5, 3.8), (0.065, 0.14, 0.985, 0.91), spaces=(0.17, 0.2), page_height=2.8
    )
    left, right = panels["a"], panels["b"]
    what = "accelerated alignment" if on_paper else "accelerated alignment without noise"
    left.set(title=f"{what}, degrees", xlabel="time, minutes")
    left.set(yscale="log", ylim=(LEAST, MOST), xlim=(0, table.shown("settling_time")[-1]))
    what = "then, with noise" if on_paper else "then Schuler's tuning, with noise"
    right.set(title=f"{what}: heading error, degrees")
    right.set(xlabel="time since then, minutes", xlim=(0, table.shown("time")[-1]))
    for name, label, style in zip(
        ("settling_heading_error", "settling_tilt"), ("heading error", "tilt"), SERIES, strict=False
    ):
        drawing.curve(left, "settling_time", name, **style, label=label)
    left.legend(loc="upper right")
    runs = len(table.heading_error)
    for i in range(1, runs + 1):
        style = {"color": GREY, "linewidth": 0.5, "alpha": 0.6}
        drawing.curve(right, "time", f"heading_error, run {i}", **style)
    labels = "formula, one deviation", f"deviation of {runs} runs"
    for sign, (formula, simulated) in (("", labels), ("-", (None, None))):
        drawing.curve(right, "time", f"{sign}formula", **SERIES[1], label=formula)
        drawing.curve(right, "time", f"{sign}simulated", color=BLACK, label=simulated)
    if on_paper:
        reach = 1.05 * np.abs(np.degrees(table.heading_error)).max()
        right.set_ylim(-reach, 1.6 * reach)  # room for the legend
    right.legend(loc="upper left")
