"""A straight line through two halves of a step, and a parabola through the past."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, GUIDE, ORANGE, SERIES, legend_below_all


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the rate, its means and the polynomial, for each way; the step is shaded."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "ab", (9.6, 4.0), (0.07, 0.22, 0.985, 0.91), spaces=(0.15, 0.2), column_height=5.0,
        sharey=True,
    )  # fmt: skip
    titles = {"two halves": "two halves of the step", "two before": "two increments before"}
    for panel, (way, title) in zip(panels.values(), titles.items(), strict=True):
        panel.set(title=title, xlabel="time, in steps")
        panel.axvspan(0, 1, color=ORANGE, alpha=0.15, linewidth=0, label=GUIDE)
        time = f"time, {way}"
        drawing.curve(panel, time, f"mean, {way}", color=GREY, label="increments, as mean rates")
        drawing.curve(panel, time, f"true, {way}", label="true rate", **SERIES[0])
        drawing.curve(panel, time, f"polynomial, {way}", label="polynomial", **SERIES[1])
    panels["a"].set_ylabel("rate")
    handles = panels["a"].get_lines()
    legend_below_all(drawing.figure, sheet, handles, 3, column=1, points=8)
