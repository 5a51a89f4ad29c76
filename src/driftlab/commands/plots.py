"""Plots of a report as SVG whose bytes repeat; the only module of the commands that draws.

Titles stand on the page. The pictures are small, so that two go beside each other on paper.
"""

from __future__ import annotations

import io
from typing import Any

from .findings import Plot

# Okabe and Ito's colours, each with a dash pattern and a marker of its own.
SERIES = (("#0072B2", "-", "o"), ("#D55E00", "--", "s"), ("#009E73", "-.", "^"))
STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "grid.color": "#d9d9d9",
    "grid.linewidth": 0.6,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "lines.linewidth": 0.9,
    "lines.markersize": 3,
    "svg.fonttype": "path",
    "svg.hashsalt": "driftlab",
}


def svg(plot: Plot) -> str:
    """One plot as the text of an SVG."""
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context({**matplotlib.rcParamsDefault, **STYLE}):
        figure = Figure(figsize=(4.4, 2.0), layout="constrained")
        axes = figure.add_subplot()
        for begin, end in plot.shaded:
            axes.axvspan(begin, end, color="#0072B2", alpha=0.12, linewidth=0)
        for curve, (colour, pattern, sign) in zip(plot.curves, SERIES, strict=False):
            marker, line = curve.marker, "--" if curve.dashed else pattern
            if curve.fitted is not None:
                axes.plot(curve.x, curve.fitted, color=colour, linestyle=line)
                marker = sign
            line = "" if marker else line
            axes.plot(
                curve.x, curve.y, label=curve.name, color=colour, marker=marker, linestyle=line
            )
            if curve.low is not None and curve.high is not None:
                axes.fill_between(curve.x, curve.low, curve.high, color=colour, alpha=0.15, lw=0)
        scale = "log" if plot.logarithmic else "linear"
        axes.set(xlabel=plot.across, ylabel=plot.up, xscale=scale, yscale=scale)
        axes.margins(x=0.01)
        if len(plot.curves) > 1:
            axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, borderaxespad=0.1)
        buffer = io.StringIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    return buffer.getvalue()
