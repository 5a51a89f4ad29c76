"""A pause of a hand that a rule took for a rest, and what it does to one of five units."""

from textwrap import fill

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import (
    BLACK,
    BLUE,
    GREY,
    GUIDE,
    VERMILION,
    legend_below_all,
)

from ..experiments import ODD, QUIET, UNIT_NAMES, WAY_NAMES

_MARKERS = "osD^v"


@from_table
def draw(drawing: Drawing) -> None:
    """The rate about the pause; below it a row a way: distance from the table, and residual."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "aa;bc", (10.5, 7.2), (0.235, 0.085, 0.985, 0.95), spaces=(0.09, 0.42),
        height_ratios=[1, 1.35], column_height=7.4, column_heights=[1, 1.35, 1.35],
    )  # fmt: skip
    _draw_pause(panels["a"], drawing)
    difference, residual = panels["b"], panels["c"]
    _draw_rows(difference, drawing, "largest_difference")
    _draw_rows(residual, drawing, "angle_left")
    difference.set_xlabel("largest difference from the table's gyro matrix")
    residual.set_xlabel("angle left after a move, rms, deg")
    names = [fill(name, 17) for name in WAY_NAMES] if sheet.on_paper else WAY_NAMES
    difference.set_yticks(range(len(WAY_NAMES)), names)
    residual.set_yticks(range(len(WAY_NAMES)), names if sheet.narrow else [""] * len(WAY_NAMES))
    row = 2
    difference.annotate(
        UNIT_NAMES[ODD], (drawing.table.largest_difference[ODD, row], row), (8, 1),
        textcoords="offset points",
    )  # fmt: skip
    difference.set(xscale="log", xlim=(1e-4, 1e-2))
    residual.set(xlim=(0, 0.34))
    if sheet.on_paper:
        legend_below_all(drawing.figure, sheet, residual, 5, 5, columnspacing=0.8,
                         handletextpad=0.1)  # fmt: skip
    else:
        residual.legend(loc="lower right")


def _draw_pause(panel: Axes, drawing: Drawing) -> None:
    table, narrow = drawing.table, drawing.sheet.narrow
    panel.set(title="unit 2: a rest, or a hand that settles?", yscale="log", ylim=(5e-3, 8))
    panel.set(xlabel="time, s", ylabel="rate, rad/s", xlim=(table.time[0], table.time[-1]))
    drawing.curve(panel, "time", "rate", color=BLUE, linewidth=1.2, label="size of the rate")
    drawing.level(panel, y="quiet_below", color=BLACK, linestyle="--", linewidth=1)
    if narrow:
        panel.text(table.time[-1], 0.8, f"quiet: < {QUIET:g} rad/s", ha="right")
    else:
        panel.text(table.time[3], 1.9 * QUIET, f"quiet below {QUIET:g} rad/s")
    drawing.spans(panel, "rest_begins", "rest_ends", color=VERMILION, alpha=0.7, linewidth=0)
    begin, end = table.rest_begins[0], table.rest_ends[0]
    panel.annotate(
        f"a rest of {table.pause[1] - table.pause[0]} samples", ((begin + end) / 2, 0.012),
        (begin + (0.3 if narrow else 0.55), 0.009), va="center",
        arrowprops={"arrowstyle": "->", "color": VERMILION},
    )  # fmt: skip


def _draw_rows(panel: Axes, drawing: Drawing, name: str) -> None:
    ways = np.arange(len(WAY_NAMES), dtype=float)
    panel.set_ylim(len(ways) - 0.5, -0.5)
    panel.grid(visible=False, axis="y")
    panel.tick_params(axis="y", length=0)
    for border in ways[1:] - 0.5:
        panel.axhline(border, color=GREY, linewidth=0.6, label=GUIDE)
    size = rcParams["lines.markersize"]
    for index, (unit, marker) in enumerate(zip(UNIT_NAMES, _MARKERS, strict=True)):
        odd = index == ODD
        drawing.curve(
            panel, f"{name}, {unit}", ways + 0.13 * (index - 2), marker=marker, linestyle="none",
            color=VERMILION if odd else GREY, markersize=size * (1.2 if odd else 0.85), label=unit,
        )  # fmt: skip
