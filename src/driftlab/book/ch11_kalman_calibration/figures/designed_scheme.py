"""What a designed rotation scheme shows better, and random ones; simulated units confirm it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import PercentFormatter
from scipy.constants import milli

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREEN, GREY, GUIDE, VERMILION
from driftlab.motion.scheme import SCHEMES

from ..experiments import BEST, LOOSE, MEAN, STANDING, rows_of, short_name

NINETEEN, EIGHTEEN = SCHEMES
DESIGNS = {BEST: "designed, worst", MEAN: "designed, mean", LOOSE: "designed, for 1 cm/s"}


def caption(table: DataTable) -> str:
    """Say how good the sequences are."""
    here = np.abs(table.reference_velocity / STANDING - 1).argmin()
    standing, moving = (
        [f"{left[i]:.2%}" for left in table.least_known.values()] for i in (here, -1)
    )
    turns = len(table.rotations[table.name.index(BEST)].split())
    velocity = f"{STANDING / milli:g}"
    return (
        f"Sequences of {turns} quarter and half turns on two axes, all in the time of the nineteen "
        f"positions. Left: reference velocity {velocity} mm/s. Deviations of "
        "the sensor errors over those after the nineteen positions, after sequences designed for "
        "the worst and for the mean of them; bars, nine in ten of "
        f"{rows_of(table, 'random').size} random sequences; hollow, errors of {table.units} "
        "simulated units after the sequence for the mean over those of the same units after the "
        "nineteen positions, with standard errors. Right: how much of what was unknown before is "
        "left of the sensor error that is known worst, for other reference velocities. After "
        f"nineteen positions, eighteen rotations, and the sequences designed for {velocity} mm/s "
        f"and for 1 cm/s it is {', '.join(standing)} at {velocity} mm/s, and {', '.join(moving)} "
        "at 1 cm/s."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw deviations of all sensor errors, and the worst over the reference velocity."""
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
    top = max(60.0, 5 * table.random_95_percent.max())  # room for the legend
    bottom = min(0.4, 0.8 * table.random_5_percent.min())
    errors.set(xlim=(-0.7, len(names) - 0.3), ylim=(bottom, top))
    errors.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
    drawing.bar_chart(
        errors, places, "random_95_percent", begin="random_5_percent", width=0.8, color="#dcdcdc",
        label="random, 90 %",
    )  # fmt: skip
    drawing.curve(errors, places, "random_median", color=GREY, marker="_", linestyle="none",
                  label="random, median")  # fmt: skip
    for name, color, marker, beside in (
        (EIGHTEEN, VERMILION, "s", -0.25),
        (BEST, GREEN, "^", 0.25),
        (MEAN, BLUE, "o", 0.0),
    ):
        drawing.curve(
            errors, places + beside, f"after, {name}", color=color, marker=marker,
            markersize=4 * dot, linestyle="none", label=DESIGNS.get(name, name),
        )  # fmt: skip
    drawing.error_bars(
        errors, places + 0.08, "simulated", "simulated_low", "simulated_high", color=BLUE,
        marker="o", markersize=5 * dot, linewidth=dot, markerfacecolor="none", linestyle="none",
        label="mean, simulated units",
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
    """What is left of the least known error, over the reference velocity."""
    panel.set(title="the least known of the 21 errors", xscale="log")
    panel.set(xlabel="reference velocity, mm/s", ylabel="deviation after, over that before")
    for name, color, style in (
        (NINETEEN, BLACK, "-"),
        (EIGHTEEN, VERMILION, "--"),
        (LOOSE, GREY, "-."),
        (BEST, GREEN, "-"),
    ):
        drawing.curve(panel, "reference_velocity", f"least_known, {name}", color=color,
                      linestyle=style, label=DESIGNS.get(name, name))  # fmt: skip
    panel.set_xticks([0.01, 0.1, 1, 10], ["0.01", "0.1", "1", "10"])
    panel.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=1))
    panel.minorticks_off()
    if drawing.sheet.on_paper:
        panel.legend(loc="best", fontsize="small")
    else:
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2, fontsize=8)
