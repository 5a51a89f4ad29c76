"""How long to average before an alignment: white noise, a slow part, and the heading they leave."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import SERIES, in_style
from driftlab.checks import FloatArray

from ..experiments import SLOW, WHITE, AveragingWindow


def columns(data: AveragingWindow) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees."""
    table = {"samples": data.windows}
    for i, white in enumerate(WHITE):
        for name in ("simulated", "formula", "white_alone"):
            values = np.degrees(getattr(data, name)[i])
            table[f"{name}_deg, white noise {white} deg/h"] = values.round(8)
    return table


@in_style
def draw(data: AveragingWindow) -> Figure:
    """Two families of curves on logarithmic axes."""
    figure = Figure(figsize=(9.0, 3.9))
    panel = figure.subplots()
    figure.subplots_adjust(0.085, 0.14, 0.985, 0.92)
    panel.set(xscale="log", yscale="log", xlim=(0.9, 22000), ylim=(0.004, 5))
    panel.set(xlabel="samples in the mean (ten a second)", ylabel="heading, degrees")
    panel.set_title(f"spread of the heading of {data.runs} alignments")
    for i, white in enumerate(WHITE):
        style = SERIES[i]
        panel.plot(
            data.windows, np.degrees(data.simulated[i]), color=style["color"], marker="os"[i],
            linestyle="none", label=f"simulated, {white:g} deg/h a sample",
        )  # fmt: skip
        panel.plot(data.windows, np.degrees(data.formula[i]), **style,
                   label=f"formula, with a slow part of {SLOW:g} deg/h")  # fmt: skip
        panel.plot(
            data.windows, np.degrees(data.white_alone[i]), color=style["color"],
            linestyle=(":", (0, (1, 4)))[i], linewidth=1.0, label="formula, white noise alone",
        )  # fmt: skip
    panel.legend(loc="upper right")
    return figure
