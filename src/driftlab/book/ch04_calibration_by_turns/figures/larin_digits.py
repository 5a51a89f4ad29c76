"""Which assumptions give which of the printed digits of Larin's table."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLUE, GREY, in_style

from ..experiments import LarinDigits
from ..printed_table import NAMES, STEPS


def columns(data: LarinDigits) -> dict[str, Any]:
    """Columns of the figure's CSV: one a number and number of steps, one row a candidate."""
    table: dict[str, Any] = {"candidate": data.labels}
    for steps, agrees in zip(STEPS, data.agrees, strict=True):
        table |= {
            f"{name} in {steps}": column for name, column in zip(NAMES, agrees.T, strict=True)
        }
    return table


@in_style
def draw(data: LarinDigits) -> Figure:
    """A row a candidate, a column a printed number, a panel a number of steps."""
    figure = Figure(figsize=(10.0, 7.0))
    panels = figure.subplots(1, len(STEPS), sharey=True)
    figure.subplots_adjust(0.25, 0.07, 0.98, 0.88, wspace=0.06)
    panels[0].set_yticks(range(len(data.labels)), data.labels)
    panels[0].set_ylim(len(data.labels) - 0.5, -0.5)
    for panel, steps, agrees in zip(panels, STEPS, data.agrees, strict=True):
        panel.set_title(f"{steps} steps in the turn", pad=26)
        panel.xaxis.tick_top()
        panel.set_xticks(range(len(NAMES)), [_pretty(name) for name in NAMES])
        panel.set_xlim(-0.5, len(NAMES) - 0.5)
        panel.tick_params(length=0)
        for side in ("left", "bottom"):
            panel.spines[side].set_visible(False)
        row, column = np.nonzero(agrees)
        panel.plot(column, row, "o", color=BLUE, markersize=8, label="every digit agrees")
        row, column = np.nonzero(agrees == 0)
        panel.plot(column, row, "x", color=GREY, markersize=4, label="does not agree")
    panels[0].legend(
        loc="upper left",
        bbox_to_anchor=(0, -0.01),
        ncols=2,
        fontsize=10,
    )
    return figure


def _pretty(name: str) -> str:
    stars = r"\ast" * name.count("*")
    return rf"$\sigma_{name[5]}^{{{stars}}}$"
