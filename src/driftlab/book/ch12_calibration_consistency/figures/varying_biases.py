"""Squared errors and clean innovations of filters whose biases vary."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GUIDE, SERIES, legend_below_all

from ..experiments import TABLES


def caption(table: DataTable) -> str:
    """Say what the two filters make of the largest variation."""
    loose, still = TABLES
    most = float(table.shown("instability")[-1])
    squares = [float(table.shown(f"squares, constants, {name}")[-1]) for name in (loose, still)]
    clean = float(table.shown(f"clean, constants, {loose}")[-1])
    return (
        f"{table.units} random units for each point, whose accelerometer biases vary with a "
        "correlation time of ten minutes. Left: squared errors of the states over expected. With "
        f"{most:g} µg those of a filter of constants are {squares[0]:.0f} times too large if the "
        f"reference velocity is {loose}, and {squares[1]:.0f} times if it is {still}. Right: "
        f"calibrations whose innovations are clean; with {loose} it is {clean:.0f} % of them even "
        "then."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw squared errors on the left, clean innovations on the right."""
    panels = drawing.mosaic(
        "ab", (9.6, 4.2), (0.075, 0.28, 0.985, 0.91), spaces=(0.18, 0.2), page_height=3.2,
        column_height=5.2,
    )  # fmt: skip
    squares, clean = panels["a"], panels["b"]
    names = [f"{kind}, {name}" for name in TABLES for kind in ("constants", "with processes")]
    for name, style in zip(names, SERIES, strict=False):
        for panel, what in ((squares, "squares"), (clean, "clean")):
            drawing.curve(
                panel, "instability", f"{what}, {name}", **style, marker="o", markersize=3,
                label=name,
            )  # fmt: skip
    squares.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
    squares.set(title="squared errors over expected", yscale="log")
    clean.set(title="clean innovations, %", ylim=(-3, 105))
    for panel in (squares, clean):
        panel.set(xscale="log", xlabel="instability of the biases (1σ), µg")
    legend_below_all(drawing.figure, drawing.sheet, squares, ncols=2)
