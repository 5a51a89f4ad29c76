"""What the Earth adds to a turn: over the latitude, and in the course of one turn."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES


@from_table
def draw(drawing: Drawing) -> None:
    """A line a rate over the latitude; beside it one turn in both directions."""
    table, on_paper = drawing.table, drawing.sheet.on_paper
    panels = drawing.mosaic(
        "ab", (10.0, 4.0), (0.075, 0.14, 0.985, 0.9), spaces=(0.22, 0.2), column_height=5.2
    )
    places, turn = panels["a"], panels["b"]
    places.set(title="a perfect triad", xlabel="latitude, °", xlim=(-90, 90))
    places.set(ylabel="seeming sigma, arc seconds", xticks=range(-90, 91, 30))
    for name, style, marker in zip(table.entry("offset").names, SERIES, "osD^vx", strict=False):
        drawing.curve(places, "latitude", f"offset, {name}", **style, label=name)
        look = {"color": style["color"], "linestyle": "none", "marker": marker}
        drawing.curve(
            places, "turned_latitude", f"turned, {name}", **look, markersize=3 if on_paper else 5
        )
    places.legend(loc="upper left")
    sigma = f"{table.shown('sigma'):.3g}".replace("-", "−")
    turn.set(title=f"a triad with sigma = {sigma}″", xlabel="turned so far, °", xlim=(0, 360))
    turn.set(ylabel="error along the axis / 2π, arc seconds", xticks=range(0, 361, 60))
    for name, style in zip(("counter-clockwise", "clockwise"), SERIES, strict=False):
        drawing.curve(turn, "angle", f"direction, {name}", **style, label=name)
    drawing.curve(turn, "angle", "mean", color=BLACK, linewidth=2, label="mean of both")
    turn.legend(loc="lower left")
