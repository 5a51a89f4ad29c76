"""What is left of the errors of a real table: over its rate, and by source."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, GUIDE, SERIES, decades, legend_below_all

from ..experiments import WAYS

_MARKERS = "osD^"
LOWEST = 1e-3
"""Arc seconds; what is smaller has no mark in the right panel."""


@from_table
def draw(drawing: Drawing) -> None:
    """A line a way over the rate; beside it a row a source, a mark a way."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (11.0, 4.6), (0.065, 0.23, 0.985, 0.92), spaces=(0.62, 0.2), width_ratios=(1, 1.05),
        column_height=6.2, column_heights=(1, 1.4),
    )  # fmt: skip
    over_rate, sources = panels["a"], panels["b"]
    size = 3.0 if sheet.on_paper else 5.0
    over_rate.set(title="all errors together", xscale="log", yscale="log")
    over_rate.set(xlim=(0.9, 110), xlabel="table rate, deg/s")
    over_rate.set_ylim(*decades(table.shown("expected"), 0.2, 1000))
    over_rate.set(ylabel="rms error of a sigma, arc seconds")
    over_rate.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    over_rate.minorticks_off()
    sources.set(title=f"source by source, {table.shown('table_rate'):.3g} deg/s", xscale="log")
    sources.set_xlim(*decades(table.shown("effect")[:, -1], 0.8 * LOWEST, 200))
    sources.set_xlabel("rms error of a sigma, arc seconds")
    rows = np.arange(len(table.source))
    labels = [f"{name}, {size}" for name, size in zip(table.source, table.sizes, strict=False)]
    sources.set_yticks(rows, [*labels, "in quadrature"])
    sources.set_ylim(rows[-1] + 0.5, -0.5)
    # Lines between the rows, none through the marks.
    sources.grid(visible=False, axis="y")
    sources.tick_params(axis="y", length=0)
    for border in rows[:-1] + 0.5:
        width = 0.6 if border < rows[-1] - 1 else 1.2
        sources.axhline(border, color=GREY, linewidth=width, label=GUIDE)
    for index, (way, style, marker) in enumerate(zip(WAYS, SERIES, _MARKERS, strict=False)):
        marks = {"color": style["color"], "marker": marker, "markersize": size, "linestyle": "none"}
        drawing.curve(over_rate, "rate", f"expected, {way}", **style)
        drawing.error_bars(
            over_rate, "simulated_rate",
            *(f"simulated, {way}, {each}" for each in ("rms", "from", "to")), **marks, label=way,
        )  # fmt: skip
        drawing.curve(sources, f"effect, {way}", [*(rows + 0.18 * (index - 1.5))], **marks)
    legend_below_all(drawing.figure, sheet, over_rate, len(WAYS), points=10)
