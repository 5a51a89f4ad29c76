"""Error of the attitude after the first steps of an algorithm with memory."""

from matplotlib.ticker import MaxNLocator

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES

from ..experiments import STARTS


@from_table
def draw(drawing: Drawing) -> None:
    """Draw a curve for each way to start."""
    table = drawing.table
    panel = drawing.mosaic("a", (6.4, 3.8), (0.11, 0.14, 0.98, 0.91), column_height=3.2)["a"]
    panel.set(title="the first steps of memory-4, on the ship", xlabel="steps")
    panel.set(ylabel="error of attitude, arc seconds", xlim=(0, max(table.step)))
    panel.xaxis.set_major_locator(MaxNLocator(integer=True))
    for start, style, marker in zip(STARTS, SERIES[:3], "os^", strict=True):
        drawing.curve(
            panel, "step", f"error, {start}", label=start, **style, marker=marker, markersize=5
        )
    panel.set_ylim(bottom=0.0)
    panel.legend(loc="center right")
