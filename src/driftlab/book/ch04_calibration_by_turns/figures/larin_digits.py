"""Which assumptions give which digits of Larin's seven numbers."""

from typing import Any

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLUE, GREY, legend_below_all

from ..experiment_numbers import NAMES
from ..experiments import CHOSEN_BY


@from_table
def draw(drawing: Drawing) -> None:
    """A row a candidate, a column a number, a panel a number of steps."""
    table, sheet = drawing.table, drawing.sheet
    letters, count = "abcdefgh"[: len(table.steps)], len(table.candidate)
    height = 0.42 + 0.115 * count
    panels = list(drawing.mosaic(
        letters, (10.0, 7.4), (0.25, 0.12, 0.98, 0.89), spaces=(0.06, 0.2), sharey=True,
        column_height=0.6 + height * len(letters), page_height=0.6 + height,
    ).values())  # fmt: skip
    panels[0].set_yticks(range(count), table.candidate)
    panels[0].set_ylim(count - 0.5, -0.5)
    small = sheet.on_paper
    for panel in panels if small else ():
        panel.tick_params(axis="y", labelsize="small")
    size = "small" if small else 10
    below = count + (0.5 if small else 0.1)
    filled, cross = (4.5, 2.5) if small else (8, 4)
    chosen_by = np.array([name in CHOSEN_BY for name in NAMES])
    dot = {"color": BLUE, "markersize": filled}
    marks: tuple[tuple[Any, int, str, dict[str, Any], str], ...] = (
        (~chosen_by, 1, "o", dot, "every digit agrees"),
        (chosen_by, 1, "o", {**dot, "fillstyle": "none"},
         "agrees, but an assumption was chosen by it"),
        (chosen_by | ~chosen_by, 0, "x", {"color": GREY, "markersize": cross}, "does not agree"),
    )  # fmt: skip
    for panel, steps, agrees in zip(panels, table.steps, table.agrees, strict=True):
        panel.set_title(f"{steps} steps in the turn", pad=18 if small else 26)
        panel.xaxis.tick_top()
        panel.set_xticks(range(len(NAMES)), [pretty(name) for name in NAMES])
        panel.set_xlim(-0.5, len(NAMES) - 0.5)
        panel.tick_params(length=0)
        panel.spines[["left", "bottom"]].set_visible(False)
        for numbers, value, marker, style, label in marks:
            row, column = np.nonzero((value == agrees.T) & numbers)
            (line,) = panel.plot(column, row, marker, linestyle="none", **style, label=label)
            drawing.record(panel, line, [])
        for place, gives in enumerate(table.of_all_candidates):
            panel.text(place, below, str(gives), ha="center", fontsize=size)
        if panel is panels[0] or sheet.narrow:
            panel.text(-0.7, below, f"of all {table.candidates}", ha="right", fontsize=size)
    if small:
        legend_below_all(drawing.figure, sheet, panels[0], ncols=3, column=1)
    else:
        panels[0].legend(loc="upper left", bbox_to_anchor=(-0.45, -0.05), ncols=3, fontsize=size)


def pretty(name: str) -> str:
    """The name of one of the seven numbers as a formula."""
    stars = r"\ast" * name.count("*")
    return rf"$\sigma_{name[5]}^{{{stars}}}$"
