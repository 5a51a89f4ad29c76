"""What a turn between two rests makes of the heading: over its angle, and over the time."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.constants import minute

from driftlab.book.machinery.picture import GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import TwoPositions

WAYS = ("one position", "two positions", "inertial frame")
TICKS = tuple(k * 10.0**power for power in range(-6, 2) for k in (1, 2, 5))
"""Marks at the axes of the spread, degrees."""


def _turns(data: TwoPositions) -> tuple[str, str]:
    return "turn known exactly", f"turn known to {np.degrees(data.turn_error):.1g}°"


def columns(data: TwoPositions) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees and seconds."""
    table = {"turn_deg": np.degrees(data.turns)}
    for i, name in enumerate(_turns(data)):
        table[f"simulated_deg, {name}"] = np.degrees(data.by_turn[i])
        table[f"formula_deg, {name}"] = np.degrees(data.by_turn_formula[i])
    table["time_s"] = data.times
    for i, name in enumerate(WAYS):
        table[f"simulated_deg, {name}"] = np.degrees(data.by_time[i])
        table[f"formula_deg, {name}"] = np.degrees(data.by_time_formula[i])
    return table | {"white_noise_alone_deg": np.degrees(data.bound)}


@in_style
def draw(data: TwoPositions, sheet: Sheet) -> Figure:
    """Deviations as markers for the simulation and lines for the formulas."""
    figure, panels = sheet.mosaic(
        "ab", (10.0, 4.0), (0.075, 0.13, 0.985, 0.92), spaces=(0.2, 0.2), column_height=5.0,
        page_height=3.0,
    )  # fmt: skip
    left, right = panels["a"], panels["b"]
    by_turn = [
        _pair(left, np.degrees(data.turns), data.by_turn[i], data.by_turn_formula[i], i, name)
        for i, name in enumerate(_turns(data))
    ]
    left.set(yscale="log", xlim=(0, 185), xticks=range(0, 181, 30), xlabel="turn, degrees")
    left.set(title=f"{data.duration / minute:g} minutes, over the turn")
    left.set(ylabel="spread of the heading, degrees")
    right.plot(data.times, np.degrees(data.bound), color=GREY, linewidth=0.9, linestyle=":",
               label="white noise alone")  # fmt: skip
    right.text(data.times[-2], np.degrees(data.bound[-2]) * 0.9, "white noise alone",
               fontsize="small", color=GREY, ha="right", va="top")  # fmt: skip
    by_time = [
        _pair(right, data.times, data.by_time[i], data.by_time_formula[i], i, name)
        for i, name in enumerate(WAYS)
    ]
    right.set(xscale="log", yscale="log", xlabel="time of the alignment, s", title="over the time")
    for panel, marks in ((left, by_turn), (right, by_time)):
        shown = np.concatenate([np.ravel(line.get_ydata()) for line in panel.lines])
        low, high = min(0.002, shown.min() / 1.2), max(0.2, 1.2 * shown.max())
        ticks = [tick for tick in TICKS if 0.999 * low < tick < 1.001 * high]
        panel.set(ylim=(low, high), yticks=ticks if len(ticks) < 12 else ticks[::3])
        panel.yaxis.set_major_formatter("{x:g}")
        panel.yaxis.set_minor_formatter("")
        below = sheet.narrow and panel is right  # where nothing lies in a low panel
        panel.legend(
            handles=marks,
            loc="lower left" if below else "upper right",
            fontsize="small",
            labelspacing=0.3,
        )
    return figure


def _pair(
    panel: Axes, x: FloatArray, simulated: FloatArray, formula: FloatArray, which: int, name: str
) -> Line2D:
    """Draw a curve and its marks, and return the marks."""
    style = SERIES[which]
    panel.plot(x, np.degrees(formula), **style, label=f"{name}, formula")
    return panel.plot(x, np.degrees(simulated), color=style["color"], marker="os^"[which],
                      markersize=4.5, linestyle="none", label=name)[0]  # fmt: skip
