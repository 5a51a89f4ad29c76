"""Three sensor errors and two days: the position error of each, East and North."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import GUIDE, Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES, legend_below_all

from ..experiments import CAUSES

NAMES = ("East gyro", "North gyro", "East accelerometer")


def caption(table: DataTable) -> str:
    """Say what is drawn, and how far each of the three leads."""
    return (
        f"Position error of a unit at rest at {table.words('latitude', 'g')} with one constant "
        f"bias at a time: gyros {table.words('gyro_bias', 'g')}, accelerometer "
        f"{table.words('accelerometer_bias', '.4g')}. The East gyro's error comes back every 24 "
        f"hours; the North gyro's has a line of {table.words('line', '.1f')} a day; the "
        f"accelerometer's never gets farther than {table.words('farthest', '.2f')}. Dotted: "
        f"without the Schuler oscillation, period {table.words('schuler_period', '.0f')}. In the "
        "last panel the oscillation moves from East to North and back: Foucault's oscillation."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw a panel for each cause, one above the other."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "a;b;c", (10.5, 7.2), (0.075, 0.12, 0.985, 0.95), column_height=6.4, page_height=5.4,
        spaces=(0.1, 0.34), sharex=True,
    )  # fmt: skip
    width = 1.0 if sheet.on_paper else 1.5
    for panel, cause, name in zip(panels.values(), CAUSES, NAMES, strict=True):
        kind = "accelerometer_bias" if "accelerometer" in cause else "gyro_bias"
        panel.set_title(f"{name}, {table.words(kind, '.4g')}")
        panel.set_ylabel("error, nmi")
        panel.axhline(0.0, color=BLACK, linewidth=0.8, label=GUIDE)
        for axis, style in zip(("East", "North"), SERIES, strict=False):
            look = {**style, "linewidth": width}
            drawing.curve(panel, "time", f"position, {axis}, {cause}", **look, label=axis)
        for axis in ("East", "North"):
            label = "without the Schuler oscillation" if axis == "East" else "_"
            drawing.curve(
                panel, "time", f"slow, {axis}, {cause}", color=GREY, linewidth=width,
                linestyle=":", label=label,
            )  # fmt: skip
        panel.set_xlim(0, table.shown("time")[-1])
    last = panels["c"]
    last.set_xlabel("time, hours")
    if table.shown("time")[-1] == 48:
        last.set_xticks(range(0, 49, 6))
    handles, _ = panels["a"].get_legend_handles_labels()
    legend_below_all(drawing.figure, sheet, handles, 3, column=2)
