"""Which assumptions give which digits of Larin's seven numbers."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLUE, GREY, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet

from ..experiment_numbers import NAMES
from ..experiments import LarinDigits


def columns(data: LarinDigits) -> dict[str, Any]:
    """Columns of the figure's CSV: one a number and number of steps, one row a candidate."""
    table: dict[str, Any] = {"candidate": data.labels}
    for steps, agrees in zip(data.steps, data.agrees, strict=True):
        table |= {
            f"{name} in {steps}": column for name, column in zip(NAMES, agrees.T, strict=True)
        }
    return {**table, "number": NAMES, "digits": data.texts, "of_all_candidates": data.counts}


@in_style
def draw(data: LarinDigits, sheet: Sheet) -> Figure:
    """A row a candidate, a column a number, a panel a number of steps."""
    letters = "abcdefgh"[: len(data.steps)]
    height = 0.42 + 0.115 * len(data.labels)
    figure, by_letter = sheet.mosaic(
        letters, (10.0, 7.4), (0.25, 0.12, 0.98, 0.89), spaces=(0.06, 0.2), sharey=True,
        column_height=0.6 + height * len(letters), page_height=0.6 + height,
    )  # fmt: skip
    panels = list(by_letter.values())
    panels[0].set_yticks(range(len(data.labels)), data.labels)
    panels[0].set_ylim(len(data.labels) - 0.5, -0.5)
    small = sheet.on_paper
    for panel in panels if small else ():
        panel.tick_params(axis="y", labelsize="small")
    size = "small" if small else 10
    below = 0.5 if small else 0.1
    filled, cross = (4.5, 2.5) if small else (8, 4)
    chosen_by = np.array(data.chosen_by)
    marks: tuple[tuple[Any, int, str, dict[str, Any], str], ...] = (
        (~chosen_by, 1, "o", {"color": BLUE, "markersize": filled}, "every digit agrees"),
        (
            chosen_by,
            1,
            "o",
            {"color": BLUE, "markersize": filled, "fillstyle": "none"},
            "agrees, but an assumption was chosen by it",
        ),
        (chosen_by | ~chosen_by, 0, "x", {"color": GREY, "markersize": cross}, "does not agree"),
    )
    for panel, steps, agrees in zip(panels, data.steps, data.agrees, strict=True):
        panel.set_title(f"{steps} steps in the turn", pad=18 if small else 26)
        panel.xaxis.tick_top()
        panel.set_xticks(range(len(NAMES)), [pretty(name) for name in NAMES])
        panel.set_xlim(-0.5, len(NAMES) - 0.5)
        panel.tick_params(length=0)
        for side in ("left", "bottom"):
            panel.spines[side].set_visible(False)
        for numbers, value, marker, style, label in marks:
            row, column = np.nonzero((agrees == value) & numbers)
            panel.plot(column, row, marker, linestyle="none", **style, label=label)
        for place, count in enumerate(data.counts):
            panel.text(place, len(data.labels) + below, str(count), ha="center", fontsize=size)
        if panel is panels[0] or sheet.narrow:
            words = f"of all {data.candidates}"
            panel.text(-0.7, len(data.labels) + below, words, ha="right", fontsize=size)
    if small:
        legend_below_all(figure, sheet, panels[0], ncols=3, column=1)
    else:
        panels[0].legend(loc="upper left", bbox_to_anchor=(-0.45, -0.05), ncols=3, fontsize=size)
    return figure


def pretty(name: str) -> str:
    """The name of one of the seven numbers as a formula."""
    stars = r"\ast" * name.count("*")
    return rf"$\sigma_{name[5]}^{{{stars}}}$"
