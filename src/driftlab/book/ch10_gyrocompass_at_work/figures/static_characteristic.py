"""Plotnikov Fig. 1, simulated from its description: heading error around the dial of a table."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, long_table

from ..experiments import DIAL, PAPER_LARGEST, SHOWN, StaticCharacteristic


def columns(data: StaticCharacteristic) -> dict[str, Any]:
    """Columns of the figure's CSV."""
    dial, worst = np.degrees(DIAL).round(6), np.degrees(data.largest)
    curves = {
        f"run {i + 1}, degrees over dial": (dial, np.degrees(run).round(7))
        for i, run in enumerate(data.runs)
    }
    curves["mean, degrees over dial"] = dial, np.degrees(data.runs.mean(axis=0)).round(7)
    curves["formula, degrees over dial"] = dial, np.degrees(data.formula).round(7)
    for share in (0.1, 0.5, 0.9):
        name = f"largest error, {share:.0%} of units, degrees over lasting drift in deg/h"
        curves[name] = data.lasting, np.quantile(worst, share, axis=1).round(7)
    return long_table(curves)


@in_style
def draw(data: StaticCharacteristic) -> Figure:
    """One unit around the dial, and which drift makes the printed largest error."""
    figure = Figure(figsize=(10.5, 3.9))
    left, right = figure.subplots(1, 2)
    figure.subplots_adjust(0.07, 0.14, 0.985, 0.91, wspace=0.18)
    left.set(title=f"one unit, lasting drift drawn with {data.lasting[SHOWN]:g} deg/h")
    left.set(xlabel="dial, degrees", ylabel="heading error, degrees", xlim=(0, 360))
    left.set_xticks(range(0, 361, 60))
    runs, units = len(data.runs), data.largest.shape[1]
    right.set(title=f"largest error of the mean of {runs} runs, {units} units each")
    right.set(xlabel="deviation of the lasting drift, deg/h", ylabel="degrees")
    right.set(xlim=(-0.005, 0.105), ylim=(0, 1.6))
    dial = np.degrees(DIAL)
    for i, run in enumerate(data.runs):
        left.plot(dial, np.degrees(run), linestyle="none", marker="os^"[i], markersize=4,
                  color=SERIES[i]["color"], label=f"run {i + 1}")  # fmt: skip
    left.plot(dial, np.degrees(data.runs.mean(axis=0)), color=BLACK, label="mean")
    left.plot(dial, np.degrees(data.formula), **SERIES[3],
              label="formula, lasting part")  # fmt: skip
    left.legend(loc="best", ncols=2)
    worst = np.degrees(data.largest)
    middle = np.median(worst, axis=1)
    low, high = np.quantile(worst, [0.1, 0.9], axis=1)
    right.errorbar(data.lasting, middle, [middle - low, high - middle], color=SERIES[0]["color"],
                   marker="o", linestyle="none", capsize=3,
                   label="median, and 10 to 90 % of the units")  # fmt: skip
    right.axhline(PAPER_LARGEST, **SERIES[1],
                  label=f"printed: {PAPER_LARGEST:g}°")  # fmt: skip
    right.legend(loc="upper left")
    return figure
