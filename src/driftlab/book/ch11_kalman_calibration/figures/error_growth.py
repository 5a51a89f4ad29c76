"""Velocity errors that four causes make, with one turn of the table."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES

from ..experiments import CAUSES


def caption(table: DataTable) -> str:
    """Say when the table turns, and what the picture shows."""
    begin, end = (float(table.shown(f"turn_{name}")[0]) for name in ("begins", "ends"))
    return (
        f"Velocity error North on a table that turns about x from {begin:g} to {end:g} s (dotted), "
        "by each of four causes alone, from the error equations. Defaults: x East, y North, z Up "
        "at first, a quarter turn. A tilt and an accelerometer bias grow alike, until the turn "
        "points y up; the scale factor of the gyro shows only from the turn on, through the tilt "
        "that it left."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the four over time."""
    panels = drawing.mosaic("a", (8.0, 3.9), (0.09, 0.16, 0.98, 0.96), page_height=3.2)
    panel = panels["a"]
    for (name, _), style in zip(CAUSES.values(), SERIES, strict=False):
        drawing.curve(panel, "time", f"velocity, {name}", **style, label=name)
    for name, label in (("turn_begins", "the table turns"), ("turn_ends", None)):
        drawing.level(panel, x=name, color=BLACK, linestyle=":", linewidth=1, label=label)
    panel.set(xlabel="time, s", ylabel="velocity error North, mm/s")
    panel.legend()
