"""The error of third order on a cone: a closed circle across the axis, a small drift along it."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES, legend_below_all


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the error across the cone's axis, and the error about the axis over the rounds."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (9.0, 4.4), (0.09, 0.21, 0.985, 0.91), spaces=(0.3, 0.2), column_height=5.0
    )
    across, along = panels["a"], panels["b"]
    across.set(title="across the axis: it goes round", aspect="equal", adjustable="datalim")
    across.set(xlabel="error along the first tilt axis, arcsec", ylabel="the other way, arcsec")
    along.set(title="about the axis: it grows", xlabel="rounds", ylabel="error, arcsec")
    handles = []
    for each, style in zip(table.samples, SERIES, strict=False):
        label = f"{each} samples a round"
        drawing.curve(across, f"first, {each}", f"second, {each}", label=label, **style)
        drawing.curve(along, f"rounds, {each}", f"along, {each}", label=label, **style)
        handles += along.plot([], [], label=label, **style)
    legend_below_all(drawing.figure, sheet, handles, len(handles), column=1, points=8)
