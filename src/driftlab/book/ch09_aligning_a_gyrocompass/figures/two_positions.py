"""What a turn between two rests makes of the heading: over its angle, and over the time."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import MINUTES, TURN_ERROR, TwoPositions

WAYS = ("one position", "two positions", "inertial frame")
TURNS = ("turn known exactly", f"turn known to {np.degrees(TURN_ERROR):.1g}°")


def columns(data: TwoPositions) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees and seconds; the two panels one under the other."""
    gap_turns, gap_times = (np.full(len(x), np.nan) for x in (data.turns, data.times))
    table = {
        "turn_deg": np.append(np.degrees(data.turns), gap_times),
        "time_s": np.append(gap_turns, data.times),
    }
    for i, name in enumerate(TURNS):
        for kind, rows in (("simulated", data.by_turn), ("formula", data.by_turn_formula)):
            table[f"{kind}_deg, {name}"] = np.append(np.degrees(rows[i]).round(8), gap_times)
    for i, name in enumerate(WAYS):
        for kind, rows in (("simulated", data.by_time), ("formula", data.by_time_formula)):
            table[f"{kind}_deg, {name}"] = np.append(gap_turns, np.degrees(rows[i]).round(8))
    table["white_noise_alone_deg"] = np.append(gap_turns, np.degrees(data.bound).round(8))
    return table


@in_style
def draw(data: TwoPositions, sheet: Sheet) -> Figure:
    """Deviations as markers for the simulation and lines for the formulas."""
    figure = Figure(figsize=(10.0, 4.0))
    left, right = figure.subplots(1, 2)
    figure.subplots_adjust(0.075, 0.13, 0.985, 0.92, wspace=0.2)
    for i, name in enumerate(TURNS):
        _pair(left, np.degrees(data.turns), data.by_turn[i], data.by_turn_formula[i], i, name)
    left.set(yscale="log", xlim=(0, 185), xticks=range(0, 181, 30), xlabel="turn, degrees")
    left.set(title=f"{MINUTES:g} minutes, over the turn", ylabel="spread of the heading, degrees")
    right.plot(data.times, np.degrees(data.bound), color=GREY, linewidth=0.9, linestyle=":")
    right.text(data.times[-2], np.degrees(data.bound[-2]) * 0.9, "white noise alone", fontsize=8,
               color=GREY, ha="right", va="top")  # fmt: skip
    for i, name in enumerate(WAYS):
        _pair(right, data.times, data.by_time[i], data.by_time_formula[i], i, name)
    right.set(xscale="log", yscale="log", xlabel="time of the alignment, s", title="over the time")
    for panel in (left, right):
        panel.set(ylim=(0.002, 0.2), yticks=(0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2))
        panel.yaxis.set_major_formatter("{x:g}")
        panel.yaxis.set_minor_formatter("")
        panel.legend(loc="upper right", fontsize=8, labelspacing=0.3)
    return figure


def _pair(
    panel: Axes, x: FloatArray, simulated: FloatArray, formula: FloatArray, which: int, name: str
) -> None:
    style = SERIES[which]
    panel.plot(x, np.degrees(formula), **style)
    panel.plot(x, np.degrees(simulated), color=style["color"], marker="os^"[which], markersize=4.5,
               linestyle="none", label=name)  # fmt: skip
