"""Plotnikov Fig. 1, simulated from its description: heading error on a table of three angles."""

import numpy as np
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES, legend_below_all

from ..experiments import PAPER_LARGEST, STOPS, TURNED


@from_table
def draw(drawing: Drawing) -> None:
    """One unit on the table, and which drift or offset makes the paper's largest error."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "ab;cd", (10.5, 7.2), (0.07, 0.13, 0.985, 0.95), spaces=(0.17, 0.36), page_height=5.6,
        column_height=8.6,
    )  # fmt: skip
    heading, others, drift, offset = panels.values()
    lasting = f"{drawing.table.shown('shown_drift'):g} deg/h"
    if sheet.on_paper:
        heading.set_title(f"one unit, lasting drift of {lasting}")
        others.set(title="the same unit, pitched or rolled")
    else:
        heading.set_title(f"one unit, lasting drift drawn with {lasting}")
        others.set(title="the same unit, pitched or rolled, bow to the North")
    heading.set(xlabel="heading, degrees", ylabel="heading error, degrees", xlim=(0, 360))
    others.set(xlabel="pitch from −60, or roll from 0, degrees", xlim=(-60, 360))
    if sheet.narrow:
        others.set_ylabel("heading error, degrees")
    _draw_unit(drawing, heading, others)
    _draw_largest(drawing, {"drift in deg/h": drift, "offset in mg": offset})
    legend_below_all(drawing.figure, sheet, drift, 2 if sheet.on_paper else 3, 1)


def _draw_unit(drawing: Drawing, heading: Axes, others: Axes) -> None:
    """Heading errors of one unit at the stops of the table."""
    table, sheet = drawing.table, drawing.sheet
    for i, style in enumerate(SERIES[:3]):
        drawing.curve(heading, "heading_stop", f"heading_error, run {i + 1}", linestyle="none",
                      marker="os^"[i], markersize=2.4 if sheet.on_paper else 4.0,
                      color=style["color"], label=f"run {i + 1}")  # fmt: skip
    for panel, name, colour, mean, formula in (
        (heading, "heading", BLACK, "mean", "formula, lasting part"),
        (others, "pitch", SERIES[0]["color"], "pitch, mean of 3 runs", None),
        (others, "roll", SERIES[2]["color"], "roll, mean of 3 runs", "formula, lasting part"),
    ):
        stop, error = f"{name}_stop", f"{name}_error"
        drawing.curve(panel, stop, f"{error}, mean", color=colour, label=mean)
        drawing.curve(panel, stop, f"{error}, formula", **SERIES[3], label=formula)
    errors = [getattr(table, f"{name}_error") for name in STOPS]
    drawn = np.degrees([[*runs, formula] for *runs, _, formula in errors])
    # Room for the legends, which are wider in a column than half of it.
    room = 2.1 if sheet.narrow else 1.5
    low, high = min(-0.6, 1.1 * drawn.min()), max(0.9, room * drawn.max())
    for panel in (heading, others):
        panel.set(ylim=(low, high))
        panel.set_xticks(range(-60 if panel is others else 0, 361, 60))
        panel.legend(loc="upper left", ncols=2, fontsize="small" if sheet.on_paper else None)


def _draw_largest(drawing: Drawing, panels: dict[str, Axes]) -> None:
    """Medians, and bars from 10 to 90 % of the units, for both kinds of turns."""
    table, on_paper = drawing.table, drawing.sheet.on_paper
    dot, top = 0.6 if on_paper else 1.0, 1.9
    for kind, panel in panels.items():
        name = kind.split()[0]
        words = f"largest error of the mean of 3 runs, {table.by_drift.shape[-1]} units"
        if on_paper:
            panel.set_title(words, fontsize="medium")
        else:
            panel.set_title(f"{words} each", fontsize=9)
        panel.set(xlabel=f"deviation of the lasting {kind}", ylabel="degrees")
        for i, turned in enumerate(TURNED):
            most = f"largest_by_{name}, {turned}"
            drawing.error_bars(
                panel, f"{name}_drawn_at, {turned}", f"{most}, 50%", f"{most}, 10%", f"{most}, 90%",
                color=SERIES[2 * i]["color"], marker="os"[i], linestyle="none", capsize=3 * dot,
                markersize=4 * dot, label=f"{turned}: median, 10 to 90 %",
            )  # fmt: skip
            top = max(top, 1.4 * table.shown(f"{most}, 50%").max())
        drawing.level(panel, y="paper_largest_error", **SERIES[1],
                      label=f"paper: {PAPER_LARGEST:g}°")  # fmt: skip
    for panel in panels.values():
        panel.set_ylim(0, top)
