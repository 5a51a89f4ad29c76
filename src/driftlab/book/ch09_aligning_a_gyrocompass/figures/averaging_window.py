"""How long to average before an alignment: two kinds of noise, and the heading they leave."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import degree, hour

from driftlab.book.machinery.picture import GREY, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import AveragingWindow

DEGREE_PER_HOUR = degree / hour


def columns(data: AveragingWindow) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees."""
    table = {
        "samples": data.windows,
        "moving_average_samples": np.array([data.moving_average]),
        "rival_window_samples": np.array([data.rival_window]),
    }
    for i, white in enumerate(data.white / DEGREE_PER_HOUR):
        for name in ("simulated", "formula", "white_alone"):
            values = np.degrees(getattr(data, name)[i])
            table[f"{name}_deg, white noise {white:g} deg/h"] = values
    for i, total in enumerate(data.white / DEGREE_PER_HOUR):
        for name in ("rival_simulated", "rival_formula"):
            values = np.degrees(getattr(data, name)[i])
            table[f"{name}_deg, noise {total:g} deg/h"] = values
    return table


@in_style
def draw(data: AveragingWindow, sheet: Sheet) -> Figure:
    """Two families of curves on logarithmic axes, one for each kind of noise."""
    figure, mosaic = sheet.mosaic(
        "ab", (10.0, 4.0), (0.075, 0.13, 0.985, 0.92), spaces=(0.06, 0.2), column_height=5.6,
        page_height=3.6, sharey=True,
    )  # fmt: skip
    panels = list(mosaic.values())
    cases = (
        (f"a slow part of {data.slow / DEGREE_PER_HOUR:.3g} deg/h: a floor", data.simulated,
         data.formula, data.moving_average, data.averaged),
        ("the rival, a rounded angle: no floor", data.rival_simulated, data.rival_formula,
         data.rival_window, data.rival_averaged),
    )  # fmt: skip
    for panel, (title, simulated, formula, window, left) in zip(panels, cases, strict=True):
        panel.set(xscale="log", yscale="log", xlim=(0.9, 1.1 * data.windows[-1]), title=title)
        panel.set(xlabel="samples in the mean (ten a second)")
        panel.axvline(window, color=GREY, linewidth=0.8)
        quiet, noisy = left / DEGREE_PER_HOUR
        panel.annotate(
            f"{quiet:.1g} and {noisy:.1g} deg/h\nafter {window} samples", (1.1 * window, 0.97),
            xycoords=("data", "axes fraction"), fontsize="small", va="top",
        )  # fmt: skip
        for i, white in enumerate(data.white / DEGREE_PER_HOUR):
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
    shown = np.degrees([data.simulated, data.formula, data.rival_simulated, data.rival_formula])
    panels[0].set_ylim(min(0.002, shown.min() / 1.2), max(5.0, 1.6 * shown.max()))
    of_what = "" if sheet.on_paper else f" of {data.runs} alignments"
    for panel in panels if sheet.narrow else panels[:1]:
        panel.set_ylabel(f"spread of the heading{of_what}, degrees")
    if sheet.on_paper:
        legend_below_all(figure, sheet, panels[0], ncols=2, column=1)
    else:
        panels[0].legend(loc="lower left", fontsize=8, labelspacing=0.25, handlelength=1.6)
    return figure
