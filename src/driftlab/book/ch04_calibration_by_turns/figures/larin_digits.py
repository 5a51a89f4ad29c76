"""Which assumptions give which digits of Larin's seven numbers."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLUE, GREY, in_style
from driftlab.book.machinery.sheet import Sheet

from ..experiment_numbers import NAMES, STEPS
from ..experiments import LarinDigits


def columns(data: LarinDigits) -> dict[str, Any]:
    """Columns of the figure's CSV: one a number and number of steps, one row a candidate."""
    table: dict[str, Any] = {"candidate": data.labels}
    for steps, agrees in zip(STEPS, data.agrees, strict=True):
        table |= {
            f"{name} in {steps}": column for name, column in zip(NAMES, agrees.T, strict=True)
        }
    return table


@in_style
def draw(data: LarinDigits, sheet: Sheet) -> Figure:
    """A row a candidate, a column a number, a panel a number of steps."""
    figure = Figure(figsize=(10.0, 7.4))
    panels = figure.subplots(1, len(STEPS), sharey=True)
    figure.subplots_adjust(0.25, 0.12, 0.98, 0.89, wspace=0.06)
    panels[0].set_yticks(range(len(data.labels)), data.labels)
    panels[0].set_ylim(len(data.labels) - 0.5, -0.5)
    chosen_by = np.array(data.chosen_by)
    marks = (
        (~chosen_by, 1, "o", {"color": BLUE, "markersize": 8}, "every digit agrees"),
        (
            chosen_by,
            1,
            "o",
            {"color": BLUE, "markersize": 8, "fillstyle": "none"},
            "agrees, but an assumption was chosen by it",
        ),
        (chosen_by | ~chosen_by, 0, "x", {"color": GREY, "markersize": 4}, "does not agree"),
    )
    for panel, steps, agrees in zip(panels, STEPS, data.agrees, strict=True):
        panel.set_title(f"{steps} steps in the turn", pad=26)
        panel.xaxis.tick_top()
        panel.set_xticks(range(len(NAMES)), [pretty(name) for name in NAMES])
        panel.set_xlim(-0.5, len(NAMES) - 0.5)
        panel.tick_params(length=0)
        for side in ("left", "bottom"):
            panel.spines[side].set_visible(False)
        for columns_of, value, marker, style, label in marks:
            row, column = np.nonzero((agrees == value) & columns_of)
            panel.plot(column, row, marker, linestyle="none", **style, label=label)
        for place, count in enumerate(data.counts):
            panel.text(place, len(data.labels) + 0.1, str(count), ha="center", fontsize=10)
    panels[0].text(
        -0.7, len(data.labels) + 0.1, f"of all {data.candidates}", ha="right", fontsize=10
    )
    panels[0].legend(loc="upper left", bbox_to_anchor=(-0.45, -0.05), ncols=3, fontsize=10)
    return figure


def pretty(name: str) -> str:
    """The name of one of the seven numbers as a formula."""
    stars = r"\ast" * name.count("*")
    return rf"$\sigma_{name[5]}^{{{stars}}}$"
