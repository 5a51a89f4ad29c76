"""Sculling: a swing and a force in step, and the velocity that they make in space."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, SERIES


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the angle and the force over time, and the velocity along the third axis."""
    table = drawing.table
    panels = drawing.mosaic(
        "ab", (9.6, 3.8), (0.08, 0.15, 0.985, 0.9), spaces=(0.26, 0.2), column_height=5.0
    )
    cause, effect = panels["a"], panels["b"]
    cause.set(title="in the body: both average out", xlabel="time, s")
    cause.set(ylabel="swing, ° / force, g", xlim=(0, table.time[-1]))
    drawing.curve(cause, "time", "angle", label="swing about axis 1, °", **SERIES[0])
    drawing.curve(cause, "time", "felt", label="force along axis 2, g", **SERIES[1])
    cause.legend(loc="upper right")
    effect.set(title="in space: velocity along axis 3", xlabel="time, s")
    effect.set(ylabel="velocity, mm/s", xlim=(0, table.time[-1]))
    drawing.curve(effect, "time", "mean", color=GREY, linewidth=3.5, label="mean force × time")
    drawing.curve(effect, "time", "velocity", label="true velocity", **SERIES[0])
    effect.legend(loc="upper left")
