"""Yates's weighing against its rivals, with and without an offset common to all turns."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, BLUE, ORANGE, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet

from ..experiments import METHODS, WeighingDesigns


def columns(data: WeighingDesigns) -> dict[str, Any]:
    """Columns of the figure's CSV: one row a method."""
    names = ("without_offset", "with_offset")
    table: dict[str, Any] = {"method": METHODS}
    for i, name in enumerate(names):
        table |= {
            f"rms_{name}": data.measured[i],
            f"rms_{name}_from": data.measured[i] - data.half_width[i],
            f"rms_{name}_to": data.measured[i] + data.half_width[i],
            f"expected_{name}": data.expected[i],
        }
    return table


@in_style
def draw(data: WeighingDesigns, sheet: Sheet) -> Figure:
    """Two marks a method, with the closed form beside them."""
    figure, panels = sheet.mosaic("a", (9.0, 3.6), (0.24, 0.15, 0.98, 0.9), column_height=2.7)
    axes = panels["a"]
    title = (
        "rms error of the sigmas" if sheet.narrow else "root mean square error of the three sigmas"
    )
    axes.set(title=title, xscale="log")
    narrow = "error / noise of one turn estimate"
    axes.set_xlabel(narrow if sheet.narrow else "error in units of the noise of one turn estimate")
    axes.set_yticks(range(len(METHODS)), METHODS)
    axes.invert_yaxis()
    dash = 9 if sheet.on_paper else 14
    rows = np.arange(len(METHODS))
    styles = (
        ("no offset", BLUE, "o", -0.12),
        (f"common offset, {data.offset:.3g} times the noise", ORANGE, "s", 0.12),
    )
    for i, (label, colour, marker, shift) in enumerate(styles):
        axes.errorbar(
            data.measured[i],
            rows + shift,
            xerr=data.half_width[i],
            elinewidth=1.5,
            color=colour,
            marker=marker,
            linestyle="none",
            label=label,
        )
        closed = "closed form" if i else None
        axes.plot(data.expected[i], rows + shift, "|", color=BLACK, markersize=dash, label=closed)
    if sheet.on_paper:
        legend_below_all(figure, sheet, axes, ncols=3, column=1)
    else:
        axes.legend(loc="upper right", fontsize=10)
    return figure
