"""What the innovations of one log say of the noise that the filter assumes."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES


def caption(table: DataTable) -> str:
    """Say from which reference velocity on the squares are as large as they should be."""
    squares = np.asarray(table.squares)
    inside = (squares > table.squares_low) & (squares < table.squares_high)
    most = f"{1e3 * float(np.max(table.reference_velocity[inside])):.2g}" if inside.any() else "no"
    return (
        "One log of a table that does not move, calibrated with one assumed reference velocity "
        "after another. Left: mean squared innovation over expected, its bounds (dotted), and the "
        f"correlation of neighbours. Up to {most} mm/s the squares are within their bounds. Right: "
        "stated 1σ and true error of the accelerometer biases, largest of three. With too large a "
        "reference velocity the filter states far more than it errs."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the test on the left, the biases on the right."""
    panels = drawing.mosaic(
        "ab", (9.6, 3.9), (0.075, 0.17, 0.985, 0.91), spaces=(0.18, 0.2), page_height=3.0,
        column_height=4.8,
    )  # fmt: skip
    test, biases = panels["a"], panels["b"]
    x = "reference_velocity"
    drawing.curve(test, x, "squares", **SERIES[0], marker="o", markersize=3, label="squares")
    drawing.curve(test, x, "correlation", **SERIES[1], marker="s", markersize=3,
                  label="correlation")  # fmt: skip
    for end, label in (("low", None), ("high", "bounds of the squares")):
        drawing.level(test, y=f"squares_{end}", color=BLACK, linestyle=":", linewidth=1,
                      label=label)  # fmt: skip
    test.set(
        title="innovations",
        xscale="log",
        ylim=(-0.1, 1.9),
        xlabel="assumed reference velocity, mm/s",
    )
    test.legend()
    drawing.curve(biases, x, "stated", **SERIES[0], marker="o", markersize=3, label="stated 1σ")
    drawing.curve(biases, x, "error", **SERIES[1], marker="s", markersize=3, label="true error")
    biases.set(title="accelerometer biases, µg", xscale="log", yscale="log")
    biases.set(xlabel="assumed reference velocity, mm/s")
    biases.legend()
