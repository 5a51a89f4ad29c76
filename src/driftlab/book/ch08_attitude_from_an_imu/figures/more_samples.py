"""What a fourth sample a step gains, over the width of the cone."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GUIDE, SERIES, decades


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the drift of three samples a step, divided by the drift of four."""
    table = drawing.table
    panel = drawing.mosaic("a", (7.2, 4.0), (0.11, 0.14, 0.98, 0.91), column_height=3.0)["a"]
    panel.set(title="three samples a step against four", xlabel="half angle of the cone, °")
    panel.set(xscale="log", yscale="log", ylabel="drift of three / drift of four", xlim=(0.5, 30))
    panel.set_xticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
    panel.minorticks_off()
    panel.set_ylim(*decades([0.1], 0.05, 200))
    panel.axhline(1.0, color=BLACK, linewidth=0.9, label=GUIDE)
    for each, style in zip(table.samples, SERIES, strict=False):
        drawing.curve(
            panel, "half_angle", f"gain, {each}", label=f"{each} samples a round", **style
        )
    panel.legend(loc="upper right")
