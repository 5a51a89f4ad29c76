"""Position error of a unit that stops every few minutes, by what it makes of its stops."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES

NAMES = {"alone": "unaided", "reset": "velocity set to zero", "ZUPT": "zero-velocity update"}


def caption(table: DataTable) -> str:
    """Say which unit it is, and what it is worth to stop."""
    alone, reset, update = table.shown("last")
    return (
        "Position error (root mean square) of navigation-grade units that stop every "
        f"{table.words('every', 'g')}: gyros 0.01 °/h, accelerometers 50 µg, initial tilt 10″ and "
        f"azimuth 2′. At the end the unaided ones are {alone:.0f} m off, those that set their "
        f"velocity to zero {reset:.0f} m, and those with a Kalman filter {update:.0f} m."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the three over time, with a logarithmic scale."""
    table = drawing.table
    (panel,) = drawing.mosaic(
        "a", (8.5, 4.0), (0.09, 0.14, 0.985, 0.97), column_height=2.8, page_height=3.0
    ).values()
    panel.set(xlabel="time, hours", ylabel="position error, m", yscale="log")
    for (name, words), style in zip(NAMES.items(), SERIES, strict=False):
        drawing.curve(panel, "time", f"distance, {name}", **style, label=words)
    panel.set_xlim(0, table.shown("time")[-1])
    panel.set_ylim(bottom=1.0)
    panel.legend(loc="lower right")
