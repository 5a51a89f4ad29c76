"""Does the averaged choice of axes deviate less? The claim after Wu Figs. 3-5, over many units."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.checks import FloatArray

from ..experiments import ALL_STARTS, AT_REST_SIZES, QUANTITIES, InPlaceClaim


def columns(data: InPlaceClaim) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the ratios in rising order."""
    return {
        f"{quantity}, start from {start}, {size} arc seconds": ratios.round(4)
        for (size, start, quantity), ratios in data.ratios.items()
    }


@in_style
def draw(data: InPlaceClaim) -> Figure:
    """Draw distribution functions of the ratio: a row for each size, a column for each start."""
    figure = Figure(figsize=(10.5, 5.8))
    panels = figure.subplots(len(AT_REST_SIZES), len(ALL_STARTS), sharex=True, sharey=True)
    figure.subplots_adjust(0.065, 0.15, 0.985, 0.94, wspace=0.08, hspace=0.2)
    cases = [(size, start) for size in AT_REST_SIZES for start in ALL_STARTS]
    for panel, (size, start) in zip(panels.flat, cases, strict=True):
        panel.set(xscale="log", xlim=(0.3, 3.3), ylim=(0, 1))
        panel.set_title(f"{size}″, start from {start}", fontsize=9)
        panel.set_xticks([0.3, 0.5, 1, 2, 3], ["0.3", "0.5", "1", "2", "3"])
        panel.minorticks_off()
        panel.axvline(1.0, color=BLACK, linewidth=0.8)
        panel.axhline(0.5, color=GREY, linewidth=0.8)
        for quantity, style in zip(QUANTITIES, SERIES, strict=False):
            ratios = data.ratios[size, start, quantity]
            parts = np.arange(1, len(ratios) + 1) / len(ratios)
            panel.step(ratios, parts, where="post", **style, label=quantity)
    for panel in panels[:, 0]:
        panel.set_ylabel("part of the units below")
    figure.supxlabel("error with averaged axes / with usual axes", y=0.06, fontsize=10)
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=3)
    return figure
