"""What is left of the errors of a real table: over its rate, and by source."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, degree

from driftlab.book.machinery.picture import GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet

from ..experiments import WAYS, RealTable, RealTableErrors

_MARKERS = "osD^"
LOWEST = 1e-3
"""Arc seconds; what is smaller has no mark in the right panel."""


def columns(data: RealTableErrors) -> dict[str, Any]:
    """Columns of the figure's CSV: the left panel; expected, then simulated with its interval."""
    table: dict[str, Any] = {"rate_deg_per_s": data.rates / degree}
    for way, total in zip(WAYS, data.expected.T, strict=True):
        table[f"{way}, expected_arcsec"] = total / arcsecond
    found = np.full((2, len(data.rates), len(WAYS)), np.nan)
    places = np.searchsorted(data.rates, data.simulated_rates)
    found[:, places] = data.simulated, data.half_width
    for index, way in enumerate(WAYS):
        table[f"{way}, simulated_arcsec"] = found[0, :, index] / arcsecond
        table[f"{way}, half_width_arcsec"] = found[1, :, index] / arcsecond
    return table


@in_style
def draw(data: RealTableErrors, sheet: Sheet) -> Figure:
    """A line a way over the rate; beside it a row a source, a mark a way."""
    figure = Figure(figsize=(11.0, 4.6))
    over_rate, sources = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1, 1.05]})
    figure.subplots_adjust(0.065, 0.23, 0.985, 0.92, wspace=0.62)
    rate = RealTable().rate / degree
    over_rate.set(title="all errors together", xscale="log", yscale="log")
    over_rate.set(xlim=(0.9, 110), xlabel="table rate, deg/s", ylim=(0.2, 1000))
    over_rate.set(ylabel="rms error of a sigma, arc seconds")
    over_rate.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    over_rate.minorticks_off()
    sources.set(title=f"source by source, {rate:g} deg/s", xscale="log", xlim=(0.8 * LOWEST, 200))
    sources.set_xlabel("rms error of a sigma, arc seconds")
    rows = np.arange(len(data.budget.sizes) + 1)
    labels = [f"{name}, {size}" for name, size in data.budget.sizes.items()]
    sources.set_yticks(rows, [*labels, "in quadrature"])
    sources.set_ylim(rows[-1] + 0.5, -0.5)
    # Lines between the rows, none through the marks.
    sources.grid(visible=False, axis="y")
    sources.tick_params(axis="y", length=0)
    for border in rows[:-1] + 0.5:
        sources.axhline(border, color=GREY, linewidth=0.6 if border < rows[-1] - 1 else 1.2)
    effects = np.vstack([data.budget.effects, data.budget.total]) / arcsecond
    for index, (way, style, marker) in enumerate(zip(WAYS, SERIES, _MARKERS, strict=False)):
        over_rate.plot(data.rates / degree, data.expected[:, index] / arcsecond, **style)
        over_rate.errorbar(
            data.simulated_rates / degree,
            data.simulated[:, index] / arcsecond,
            yerr=data.half_width[:, index] / arcsecond,
            color=style["color"],
            marker=marker,
            markersize=5,
            linestyle="none",
            label=way,
        )
        seen = effects[:, index] >= LOWEST
        sources.plot(
            effects[seen, index],
            rows[seen] + 0.18 * (index - 1.5),
            color=style["color"],
            marker=marker,
            markersize=5,
            linestyle="none",
        )
    handles, names = over_rate.get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncols=len(WAYS), fontsize=10)
    return figure
