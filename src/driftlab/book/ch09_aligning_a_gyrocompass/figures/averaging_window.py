"""How long to average before an alignment: two kinds of noise, and the heading they leave."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import MOVING_AVERAGE, RIVAL_WINDOW, SLOW, WHITE, AveragingWindow


def columns(data: AveragingWindow) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees."""
    table = {"samples": data.windows}
    for i, white in enumerate(WHITE):
        for name in ("simulated", "formula", "white_alone"):
            values = np.degrees(getattr(data, name)[i])
            table[f"{name}_deg, white noise {white} deg/h"] = values.round(8)
    for i, total in enumerate(WHITE):
        for name in ("rival_simulated", "rival_formula"):
            values = np.degrees(getattr(data, name)[i])
            table[f"{name}_deg, noise {total} deg/h"] = values.round(8)
    return table


@in_style
def draw(data: AveragingWindow, sheet: Sheet) -> Figure:
    """Two families of curves on logarithmic axes, one for each kind of noise."""
    figure = Figure(figsize=(10.0, 4.0))
    panels = figure.subplots(1, 2, sharey=True)
    figure.subplots_adjust(0.075, 0.13, 0.985, 0.92, wspace=0.06)
    cases = (
        (f"a slow part of {SLOW:g} deg/h: a floor", data.simulated, data.formula, MOVING_AVERAGE),
        ("the rival, a rounded angle: no floor", data.rival_simulated, data.rival_formula,
         RIVAL_WINDOW),
    )  # fmt: skip
    for panel, (title, simulated, formula, window) in zip(panels, cases, strict=True):
        panel.set(xscale="log", yscale="log", xlim=(0.9, 22000), ylim=(0.002, 5), title=title)
        panel.set(xlabel="samples in the mean (ten a second)")
        panel.axvline(window, color=GREY, linewidth=0.8)
        panel.text(window * 1.1, 3.4, f"0.01 and 0.02 deg/h\nafter {window} samples", fontsize=8,
                   va="top")  # fmt: skip
        for i, white in enumerate(WHITE):
            style = SERIES[i]
            panel.plot(
                data.windows, np.degrees(simulated[i]), color=style["color"], marker="os"[i],
                linestyle="none", label=f"simulated, {white:g} deg/h a sample",
            )  # fmt: skip
            panel.plot(data.windows, np.degrees(formula[i]), **style, label="formula")
            panel.plot(
                data.windows, np.degrees(data.white_alone[i]), color=style["color"],
                linestyle=(":", (0, (1, 4)))[i], linewidth=1.0, label="if all of it were white",
            )  # fmt: skip
    panels[0].set_ylabel(f"spread of the heading of {data.runs} alignments, degrees")
    panels[0].legend(loc="lower left", fontsize=8, labelspacing=0.25, handlelength=1.6)
    return figure
