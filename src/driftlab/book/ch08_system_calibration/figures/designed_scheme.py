"""What a designed rotation scheme shows better, and random ones; simulated units confirm it."""

import numpy as np
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREEN, GREY, GUIDE, VERMILION
from driftlab.motion.scheme import SCHEMES

from ..experiments import BEST, CLASSES, FREE, UNIT, rows_of, short_name

NINETEEN, EIGHTEEN = SCHEMES
DESIGNS = {BEST: "designed, two axes", FREE: "designed, three axes"}


def caption(table: DataTable) -> str:
    """Say how good the rows are, and whether simulated units confirm it."""
    nineteen, eighteen, best, free = (
        table.least_known[name][0] for name in (NINETEEN, EIGHTEEN, BEST, FREE)
    )
    worst = table.criterion[0]
    drawn = worst[rows_of(table, "random")]
    first, second = (f"{worst[rows_of(table, UNIT + n)].mean():.2f}" for n in (NINETEEN, BEST))
    turns = len(table.rotations[table.name.index(BEST)].split())
    return (
        f"Rows of {turns} quarter and half turns, all in the time of the nineteen positions. Left: "
        "deviations of the sensor errors over those after the nineteen positions; bars, nine in "
        f"ten of {drawn.size} random rows; hollow, errors of {table.units} "
        "simulated units after the designed row over those of the same units after the nineteen "
        f"positions, with standard errors (NEES / 27: {second} and {first}). Right: how much of "
        "what was unknown before is left of the sensor error that is known worst: "
        f"{nineteen:.2%} after nineteen positions, {eighteen:.2%} after eighteen rotations, "
        f"{best:.2%} after the row designed for two axes, {free:.2%} for three; "
        f"{np.mean(drawn < nineteen):.0%} of the random rows leave less than the nineteen "
        "positions."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw deviations of all sensor errors, and the criterion of all rows."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 4.9), (0.065, 0.28, 0.985, 0.93), width_ratios=(1.0, 0.5),
        page_height=4.2, column_height=6.6, column_heights=(1.35, 1.0),
    )  # fmt: skip
    errors, worst = panels["a"], panels["b"]
    names = [short_name(name) for name in table.sensor_error]
    places = np.arange(len(names), dtype=np.float64)
    small = "small" if sheet.on_paper else 8
    dot = 0.6 if sheet.on_paper else 1.0
    errors.set(title="deviation, over that after the nineteen positions", yscale="log")
    top = max(60.0, 2 * table.random_95_percent.max())
    bottom = min(0.4, 0.8 * table.random_5_percent.min())
    errors.set(xlim=(-0.7, len(names) - 0.3), ylim=(bottom, top))
    errors.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
    drawing.bar_chart(
        errors, places, "random_95_percent", begin="random_5_percent", width=0.8, color="#dcdcdc",
        label="random rows, 90 %",
    )  # fmt: skip
    drawing.curve(errors, places, "random_median", color=GREY, marker="_", linestyle="none",
                  label="random rows, median")  # fmt: skip
    for name, color, marker, beside in (
        (EIGHTEEN, VERMILION, "s", -0.25),
        (FREE, GREEN, "^", 0.25),
        (BEST, BLUE, "o", 0.0),
    ):
        drawing.curve(
            errors, places + beside, f"after, {name}", color=color, marker=marker,
            markersize=4 * dot, linestyle="none", label=DESIGNS.get(name, name),
        )  # fmt: skip
    drawing.error_bars(
        errors, places + 0.08, "simulated", "simulated_low", "simulated_high", color=BLUE,
        marker="o", markersize=5 * dot, linewidth=dot, markerfacecolor="none", linestyle="none",
        label="the same, simulated units",
    )  # fmt: skip
    errors.set_yticks([0.5, 1, 2, 5, 10, 20, 50], ["0.5", "1", "2", "5", "10", "20", "50"])
    errors.minorticks_off()
    if sheet.narrow:
        errors.set_xticks(places, names, rotation=90, fontsize=5.8)
    else:
        size = 6 if sheet.on_paper else 7
        errors.set_xticks(places, names, rotation=55, ha="right", fontsize=size)
    handles, _ = errors.get_legend_handles_labels()  # lines first, then bars
    errors.legend(handles=[handles[4], *handles[:4], *handles[5:]], loc="upper left",
                  ncols=2 if sheet.narrow else 3, fontsize=small, framealpha=1.0)  # fmt: skip
    _draw_worst(drawing, worst)


def _draw_worst(drawing: Drawing, panel: Axes) -> None:
    """How many random rows leave how much of the least known error, and where the others are."""
    panel.set(title="the least known of the 21 errors", xscale="log")
    panel.set(xlim=(CLASSES[0], CLASSES[-1]))
    panel.set(xlabel="deviation after, over that before", ylabel="random rows")
    drawing.bar_chart(
        panel, "worst_of_random_rows", "random_rows", width=np.diff(CLASSES), color="#dcdcdc",
        edgecolor=GREY, linewidth=0.5,
    )  # fmt: skip
    for name, color, style in (
        (NINETEEN, BLACK, "-"),
        (EIGHTEEN, VERMILION, "--"),
        (BEST, BLUE, "-"),
        (FREE, GREEN, "-."),
    ):
        label = DESIGNS.get(name, name)
        drawing.level(panel, x=f"least_known, {name}", color=color, linestyle=style, label=label)
    panel.set_xticks([0.03, 0.1, 0.3, 1], ["3 %", "10 %", "30 %", "100 %"])
    panel.minorticks_off()
    if drawing.sheet.on_paper:
        panel.set_ylim(0, 1.5 * drawing.table.random_rows.max())  # room for the legend
        panel.legend(loc="upper right", fontsize="small")
    else:
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2, fontsize=8)
