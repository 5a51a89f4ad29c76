"""What is left of the errors of a real table: over its rate, and by source."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, degree

from driftlab.book.machinery.picture import GREY, SERIES, decades, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import WAYS, RealTableErrors

_MARKERS = "osD^"
LOWEST = 1e-3
"""Arc seconds; what is smaller has no mark in the right panel."""


def columns(data: RealTableErrors) -> dict[str, Any]:
    """Columns of the figure's CSV: the budget over the rate, the simulations, the sources."""
    table: dict[str, Any] = {"rate_deg_per_s": data.rates / degree}
    for way, total in zip(WAYS, data.expected.T, strict=True):
        table[f"{way}, expected_arcsec"] = total / arcsecond
    table["simulated_rate_deg_per_s"] = data.simulated_rates / degree
    for way, found, half in zip(WAYS, data.simulated.T, data.half_width.T, strict=True):
        table[f"{way}, simulated_arcsec"] = found / arcsecond
        table[f"{way}, simulated_from_arcsec"] = (found - half) / arcsecond
        table[f"{way}, simulated_to_arcsec"] = (found + half) / arcsecond
    table["source"] = [*data.budget.sizes, "in quadrature"]
    for way, effects in zip(WAYS, _effects(data).T, strict=True):
        table[f"{way}, of_source_arcsec"] = effects
    return table


def _effects(data: RealTableErrors) -> FloatArray:
    """Error (source, way) by source, and of all in quadrature below them, arc seconds."""
    return np.vstack([data.budget.effects, data.budget.total]) / arcsecond


@in_style
def draw(data: RealTableErrors, sheet: Sheet) -> Figure:
    """A line a way over the rate; beside it a row a source, a mark a way."""
    figure, panels = sheet.mosaic(
        "ab", (11.0, 4.6), (0.065, 0.23, 0.985, 0.92), spaces=(0.62, 0.2), width_ratios=(1, 1.05),
        column_height=6.2, column_heights=(1, 1.4),
    )  # fmt: skip
    over_rate, sources = panels["a"], panels["b"]
    rate = data.rate / degree
    size = 3.0 if sheet.on_paper else 5.0
    over_rate.set(title="all errors together", xscale="log", yscale="log")
    over_rate.set(xlim=(0.9, 110), xlabel="table rate, deg/s")
    over_rate.set_ylim(*decades([*data.expected / arcsecond], 0.2, 1000))
    over_rate.set(ylabel="rms error of a sigma, arc seconds")
    over_rate.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    over_rate.minorticks_off()
    sources.set(title=f"source by source, {rate:.3g} deg/s", xscale="log")
    sources.set_xlim(*decades(data.budget.total / arcsecond, 0.8 * LOWEST, 200))
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
    effects = _effects(data)
    for index, (way, style, marker) in enumerate(zip(WAYS, SERIES, _MARKERS, strict=False)):
        over_rate.plot(data.rates / degree, data.expected[:, index] / arcsecond, **style)
        over_rate.errorbar(
            data.simulated_rates / degree,
            data.simulated[:, index] / arcsecond,
            yerr=data.half_width[:, index] / arcsecond,
            color=style["color"],
            marker=marker,
            markersize=size,
            linestyle="none",
            label=way,
        )
        sources.plot(
            effects[:, index],
            rows + 0.18 * (index - 1.5),
            color=style["color"],
            marker=marker,
            markersize=size,
            linestyle="none",
        )
    legend_below_all(figure, sheet, over_rate, len(WAYS), points=10)
    return figure
