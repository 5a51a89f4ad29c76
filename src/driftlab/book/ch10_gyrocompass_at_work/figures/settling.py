"""Accelerated alignment, then Schuler's tuning: how noise becomes a swing that nothing damps."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import Settling

LEAST, MOST = 1e-6, 200.0
"""Reach of what settles, degrees; less is drawn nowhere."""


def columns(data: Settling) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: those of the left panel, then those of the right one."""
    runs = {f"run {i}, deg": np.degrees(row) for i, row in enumerate(data.heading, 1)}
    return {
        "settling_time_min": data.settling_times / minute,
        "settling_heading_error_deg": np.degrees(data.settling_heading),
        "settling_tilt_deg": np.degrees(data.tilt),
        "time_min": data.times / minute,
        "formula_deg": np.degrees(data.deviation),
        "simulated_deg": np.degrees(data.heading.std(axis=0)),
        **runs,
    }


@in_style
def draw(data: Settling, sheet: Sheet) -> Figure:
    """The horizon settles; and what noise does to the heading afterwards."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 3.8), (0.065, 0.14, 0.985, 0.91), spaces=(0.17, 0.2), page_height=2.8
    )
    left, right = panels["a"], panels["b"]
    minutes, working = data.settling_times / minute, data.times / minute
    settling = {
        "heading error": np.degrees(data.settling_heading), "tilt": np.degrees(data.tilt)
    }  # fmt: skip
    what = "accelerated alignment" if sheet.on_paper else "accelerated alignment without noise"
    left.set(title=f"{what}, degrees", xlabel="time, minutes")
    left.set(yscale="log", ylim=(LEAST, MOST), xlim=(0, minutes[-1]))
    what = "then, with noise" if sheet.on_paper else "then Schuler's tuning, with noise"
    right.set(title=f"{what}: heading error, degrees")
    right.set(xlabel="time since then, minutes", xlim=(0, working[-1]))
    for (name, values), style in zip(settling.items(), SERIES, strict=False):
        left.plot(minutes, values, **style, label=name)
    left.legend(loc="upper right")
    right.plot(working, np.degrees(data.heading.T), color=GREY, linewidth=0.5, alpha=0.6)
    spread, bound = np.degrees(data.heading.std(axis=0)), np.degrees(data.deviation)
    names = "formula, one deviation", f"deviation of {len(data.heading)} runs"
    for sign, (formula, simulated) in ((1, names), (-1, (None, None))):
        right.plot(working, sign * bound, **SERIES[1], label=formula)
        right.plot(working, sign * spread, color=BLACK, label=simulated)
    if sheet.on_paper:
        reach = 1.05 * np.abs(np.degrees(data.heading)).max()
        right.set_ylim(-reach, 1.6 * reach)  # room for the legend
    right.legend(loc="upper left")
    return figure
