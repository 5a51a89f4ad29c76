"""The choice of body axes in a plane; Wu Fig. 2, (43), (44)."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREEN, GREY, VERMILION, plain_axes
from driftlab.checks import FloatArray


@from_table
def draw(drawing: Drawing) -> None:
    """Draw instruments and given axes; then the same gyros with both choices of body axes."""
    table, panels = drawing.table, three_planes(drawing)
    titles = ("four instruments, given axes", "usual: x along the x gyro", "averaged")
    most = max(table.gyros[1], table.accelerometers[1])
    least = min(table.gyros[0], table.accelerometers[0], table.usual)
    limits = {"xlim": (-0.62 - beside(most), 1.98), "ylim": (min(-0.35, lowest(least)), 1.45)}
    for panel, title in zip(panels, titles, strict=True):
        plain_axes(panel, reach=1.3)
        panel.set(title=title, **limits)
    given, usual, averaged = panels
    for panel, angle in ((given, 0.0), (usual, table.usual), (averaged, table.averaged)):
        asides = (0.09, 0.09 if panel is given else -0.09)
        pair(panel, np.full(2, angle), ("$x$", "$y$"), 1.3, color=BLACK)
        pair(panel, table.gyros, ("x gyro", "y gyro"), 1.0, asides, color=BLUE, linestyle="--")
    labels = ("x acc.", "y acc.")
    accelerometers = {"color": VERMILION, "linestyle": ":"}
    pair(given, table.accelerometers, labels, 0.8, (-0.02, -0.02), **accelerometers)
    for panel, angle in ((usual, table.usual), (averaged, table.averaged)):
        pair(panel, np.zeros(2), ("", ""), 0.75, color=GREY)
        arc = np.linspace(0, angle, 30)
        panel.plot(0.62 * np.cos(arc), 0.62 * np.sin(arc), color=GREEN)
        panel.text(0.68, 0.04, f"{angle:.2f} rad")


def three_planes(drawing: Drawing) -> list[Axes]:
    """Room for three drawings in a plane, beside each other or in a column."""
    panels = drawing.mosaic(
        "abc", (10.5, 2.9), (0.01, 0.02, 1.0, 0.9), spaces=(0.02, 0.2), column_height=5.6,
        page_height=1.9,
    )  # fmt: skip
    return list(panels.values())


def beside(angle: float) -> float:
    """How much farther to the left than usual a y instrument reaches that leans by an angle."""
    return max(0.0, 1.3 * float(np.sin(angle)) - 0.39)


def lowest(angle: float) -> float:
    """How far down an x instrument reaches that leans by an angle."""
    return min(-0.2, 1.3 * float(np.sin(angle)) - 0.1)


def pair(
    panel: Axes,
    angles: FloatArray,
    labels: tuple[str, str],
    length: float,
    asides: tuple[float, float] = (0.0, 0.0),
    **style: Any,
) -> None:
    """Draw an x and a y direction, turned by two angles; labels beyond the tips, or beside them."""
    rights = (0.0, np.pi / 2)
    for angle, right, label, aside in zip(angles, rights, labels, asides, strict=True):
        along = np.array([np.cos(angle + right), np.sin(angle + right)])
        tip = length * along
        panel.plot([0, tip[0]], [0, tip[1]], **style)
        x, y = tip + (aside * np.array([-along[1], along[0]]) if aside else 0.05 * along)
        place = "right" if aside > 0 else ("center" if right and not aside else "left")
        panel.text(x, y, label, ha=place, va="center")
