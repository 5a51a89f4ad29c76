"""Does the averaged choice of axes deviate less? The claim after Wu Figs. 3-5, over many units."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.checks import FloatArray

from ..experiments import ALL_STARTS, QUANTITIES, InPlaceClaim


def columns(data: InPlaceClaim) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the ratios in rising order."""
    return {
        f"{quantity}, start from {start}": ratios.round(3)
        for (start, quantity), ratios in data.ratios.items()
    }


@in_style
def draw(data: InPlaceClaim) -> Figure:
    """Draw distribution functions of the ratio."""
    figure = Figure(figsize=(10.5, 3.9))
    panels = figure.subplots(1, 3, sharey=True)
    figure.subplots_adjust(0.065, 0.23, 0.985, 0.91, wspace=0.08)
    for panel, start in zip(panels, ALL_STARTS, strict=True):
        panel.set(title=f"start from {start}", xscale="log", xlim=(0.3, 3.3), ylim=(0, 1))
        panel.set_xticks([0.3, 0.5, 1, 2, 3], ["0.3", "0.5", "1", "2", "3"])
        panel.minorticks_off()
        panel.set_xlabel("error with averaged axes / with usual axes")
        panel.axvline(1.0, color=BLACK, linewidth=0.8)
        panel.axhline(0.5, color=GREY, linewidth=0.8)
        for quantity, style in zip(QUANTITIES, SERIES, strict=False):
            ratios = data.ratios[start, quantity]
            parts = np.arange(1, len(ratios) + 1) / len(ratios)
            panel.step(ratios, parts, where="post", **style, label=quantity)
    panels[0].set_ylabel("part of the units below")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=3)
    return figure
