"""A meridian with a unit on its way North: local axes, and axes that were carried along."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREY, VERMILION, plain_axes

LENGTH = 0.3
"""Of the axes, in radii of the Earth."""


def caption(table: DataTable) -> str:
    """Say what the two sets of axes are, and by how much they differ."""
    return (
        "A unit goes North along a meridian. Solid: North and Up at each place. Dashed: the axes "
        "of the start, carried along without turning, as gyros hold them. On the way the local "
        f"axes turn by {table.words('turned', '.0f')} about West, as much as the latitude changes: "
        "one arc minute per nautical mile."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw a quarter of the Earth, seen from the East, with the unit at its places."""
    table = drawing.table
    (panel,) = drawing.mosaic(
        "a", (7.0, 4.6), (0.01, 0.01, 0.99, 0.99), column_height=2.9, page_height=3.2
    ).values()
    plain_axes(panel)
    panel.set(xlim=(-0.35, 1.75), ylim=(-0.25, 1.35))
    arc = np.linspace(-0.15, np.pi / 2 + 0.15, 100)
    panel.plot(np.cos(arc), np.sin(arc), color=BLACK, linewidth=1.2)
    panel.plot([0, 0], [-0.12, 1.25], color=GREY, linestyle="-.")
    panel.text(0.03, 1.22, "to the pole", color=BLACK)
    panel.plot([0, 1.0], [0, 0], color=GREY, linestyle="-.")
    first = table.latitude[0]
    for place in table.latitude:
        here = np.array([np.cos(place), np.sin(place)])
        panel.plot([0, here[0]], [0, here[1]], color=GREY, linewidth=0.7)
        for angle, style in ((first, "--"), (place, "-")):
            if style == "--" and place == first:
                continue
            for right, color, name in ((0.0, BLUE, "Up"), (np.pi / 2, VERMILION, "North")):
                way = LENGTH * np.array([np.cos(angle + right), np.sin(angle + right)])
                tip = here + way
                panel.plot(*np.stack([here, tip], axis=1), color=color, linestyle=style)
                if style == "-":
                    x, y = here + 1.06 * way
                    side = "left" if name == "Up" else "center"
                    level = "center" if name == "Up" else "baseline"
                    panel.text(x, y, f" {name}", ha=side, va=level)
        panel.plot(*here, color=BLACK, marker="s", markersize=5)
