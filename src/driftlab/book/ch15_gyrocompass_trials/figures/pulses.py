"""A laser gyro unit on a parked car: the heading of a damped compass, read in two ways."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES, VERMILION, legend_below_all


@from_table
def draw(drawing: Drawing) -> None:
    """Both readings; and the one from the integrals, three hundred times larger."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 3.6), (0.065, 0.15, 0.985, 0.91), spaces=(0.17, 0.2), page_height=3.0
    )
    both, near = panels["a"], panels["b"]
    both.set(title="heading of a parked car, degrees", ylim=(-180, 180))
    both.set_yticks(range(-180, 181, 90))
    drawing.curve(both, "time", "by_whole_rate", color=VERMILION, linestyle="none", marker=".",
                  markersize=2 if sheet.on_paper else 4, label="from the whole rate")  # fmt: skip
    for panel in (both, near):
        drawing.curve(panel, "time", "by_integrals", **SERIES[0], label="from the integrals")
        panel.set(xlabel="time, minutes", xlim=(0, table.shown("time")[-1]))
    if sheet.on_paper:
        legend_below_all(drawing.figure, sheet, both, 2)
    else:
        both.legend(loc="upper right")
    middle = table.shown("by_integrals").mean()
    near.set(title="from the integrals, degrees", ylim=(middle - 0.3, middle + 0.3))
