"""Order of each attitude algorithm, measured on motions that show it and motions that hide it."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import ORDER_MOTIONS, ORDER_SAMPLE_RATES, AlgorithmOrders
from .algorithm_laboratory import STYLES, draw_slopes


def columns(data: AlgorithmOrders) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: errors in rad, except those of pure rounding."""
    table = {"rate_hz": data.rates}
    for motion, errors in zip(("cone_1", "cone_60", "sway", "fixed_axis"), data.worst, strict=True):
        for name, column in zip(data.names, errors, strict=True):
            # On a fixed axis a rotation vector is exact, and what is left differs by machine.
            if column.max() > 1e-13:
                table[f"{motion}_{name}"] = column
    return table


@in_style
def draw(data: AlgorithmOrders, sheet: Sheet) -> Figure:
    """Draw one panel a motion."""
    figure = Figure(figsize=(10.0, 7.2))
    panels = figure.subplots(2, 2, sharex=True, sharey=True).ravel()
    figure.subplots_adjust(0.085, 0.135, 0.985, 0.955, wspace=0.06, hspace=0.16)
    for panel, title, worst in zip(panels, ORDER_MOTIONS, data.worst, strict=True):
        panel.set(title=title, xscale="log", yscale="log", xlim=(21, 900), ylim=(1e-16, 3))
        panel.set_xticks(ORDER_SAMPLE_RATES, [str(rate) for rate in ORDER_SAMPLE_RATES])
        panel.minorticks_off()
        if not title.startswith("fixed axis"):  # there errors lie in the way
            draw_slopes(panel, ORDER_SAMPLE_RATES[0], 1e-11)
        for name, errors in zip(data.names, worst, strict=True):
            # No error at all has no place on a logarithmic axis.
            shown = np.where(errors > 0, errors, np.nan)
            panel.plot(data.rates, shown, **STYLES[name], label=name)
    for panel in panels[2:]:
        panel.set_xlabel("sample rate, Hz")
    for panel in panels[::2]:
        panel.set_ylabel("largest error of attitude, rad")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=len(labels), fontsize=8)
    return figure
