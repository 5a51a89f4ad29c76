"""The way of the rod on the sphere, with the mark that it carries along."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES, VERMILION, project

SEEN_FROM = 40.0, 28.0


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the sphere, the way of the rod's tip, and the mark at each point."""
    table = drawing.table
    panel = drawing.mosaic("a", (5.6, 4.6), (0.01, 0.01, 0.99, 0.93), column_height=3.2)["a"]
    panel.set_title("the rod comes back, and its mark has turned")
    panel.set_aspect("equal")
    panel.axis("off")
    around = np.linspace(0, 2 * np.pi, 181)
    panel.plot(np.cos(around), np.sin(around), color=GREY, linewidth=0.9)
    tips, marks = table.tip.T, table.mark.T
    way = project(tips, *SEEN_FROM)
    panel.plot(*way.T, **SERIES[0])
    for at, (tip, mark) in enumerate(zip(tips, marks, strict=True)):
        start, end = project(np.stack([tip, tip + 0.16 * mark]), *SEEN_FROM)
        ends = at in (0, len(tips) - 1)
        panel.plot(
            [start[0], end[0]], [start[1], end[1]], color=VERMILION if ends else BLACK,
            linewidth=2.6 if ends else 1.1,
        )  # fmt: skip
    corner = tips[(len(tips) - 1) // 3]
    named = {"East": tips[0], f"{table.words('along', 'g')} on": corner, "zenith": np.eye(3)[2]}
    for name, direction in named.items():
        place = 1.17 * project(direction, *SEEN_FROM) - [0, 0.06]
        panel.annotate(name, tuple(place), ha="center", va="center")
    panel.set(xlim=(-1.3, 1.3), ylim=(-1.1, 1.3))
