"""A body turned right over: what its heading loses in the vertical, and what its attitude keeps."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES


@from_table
def draw(drawing: Drawing) -> None:
    """The angles on the left, their errors on the right."""
    panels = drawing.mosaic(
        "ab", (10.5, 3.6), (0.07, 0.14, 0.985, 0.91), spaces=(0.2, 0.2), column_height=4.6,
        page_height=2.8,
    )  # fmt: skip
    left, right = panels["a"], panels["b"]
    for panel in (left, right):
        panel.set(xlabel="turned about the right axis, degrees", xlim=(0, 180))
        panel.set_xticks([0, 30, 60, 90, 120, 150, 180])
    left.set(title="one smooth turn, told in angles", ylabel="degrees", ylim=(-190, 190))
    left.set_yticks([-180, -90, 0, 90, 180])
    right.set(title="errors after alignment, root mean square", ylabel="degrees", yscale="log")
    # Half a turn of roll is both 180 and -180 degrees; the jump at the vertical is what matters.
    for name, style in zip(("heading", "roll", "pitch"), SERIES, strict=False):
        drawing.curve(left, "angle", f"true_{name}", **style, label=name)
    errors = (
        ("heading", "heading_error", SERIES[0]),
        ("roll", "roll_error", SERIES[1]),
        ("heading + roll", "heading_and_roll_error", SERIES[3]),
        ("attitude", "attitude_error", SERIES[4]),
    )
    for label, name, style in errors:
        drawing.curve(right, "angle", name, **style, label=label)
    every = np.array([drawing.table.shown(name) for _, name, _ in errors])
    right.set_ylim(min(0.05, every.min() / 1.2), max(30.0, 1.2 * every.max()))
    left.legend(loc="lower left")
    right.legend(loc="upper left")
