"""What one bent triad leaves of motions that come back, each made several times."""

from typing import Any

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES, plain_axes, project

VIEW = (-15.0, 30.0)
"""Azimuth and elevation from which none of the ways is seen edge on, degrees."""
BESIDE = ((-0.18, 0.06), (0.0, 0.13), (-0.12, 0.0))
"""From each stick to its number, clear of the ways."""
CENTRED: dict[str, Any] = {"ha": "center", "va": "center"}


@from_table
def draw(drawing: Drawing) -> None:
    """Way of the third axis in each motion, and the error with its first order."""
    table, on_paper = drawing.table, drawing.sheet.on_paper
    panels = drawing.mosaic(
        "abe;cde", (10.0, 4.4), (0.005, 0.12, 0.985, 0.92), spaces=(0.12, 0.15),
        width_ratios=(1, 1, 3), column="ab;cd;ee", column_height=5.8, column_heights=(1, 1, 1.4),
        page_height=3.6,
    )  # fmt: skip
    errors = panels["e"]
    errors.set(title="rotation from R to B", xlabel="motions", ylabel="angle, arc minutes")
    errors.set(xlim=table.ends)
    letters = "medium" if on_paper else 9
    dot: dict[str, Any] = {"color": BLACK, "marker": "o", "markersize": 2.5 if on_paper else 4}
    outline = np.linspace(0, 2 * np.pi, 100)
    for place, style, (name, track) in zip("abcd", SERIES, table.track.items(), strict=False):
        panel = panels[place]
        plain_axes(panel, reach=1.15)
        panel.set_title(name)
        panel.plot(np.cos(outline), np.sin(outline), color=GREY, linewidth=0.8)
        for number, tip in enumerate(project(np.eye(3), *VIEW)):
            panel.plot([0, tip[0]], [0, tip[1]], color=BLACK, linewidth=0.8)
            x, y = 0.55 * tip + BESIDE[number]
            panel.text(x, y, f"{number + 1}", fontsize=letters, **CENTRED)
        way = project(track, *VIEW)
        panel.plot(*way.T, color=style["color"], linewidth=1.3 if on_paper else 2)
        panel.plot(*way[0], **dot)
        panel.text(0, 1.1, "start", fontsize=letters, **CENTRED)
        drawing.curve(errors, "motions", f"angle, {name}", **style, label=name)
        drawing.curve(errors, "ends", f"first_order, {name}", color=GREY, linewidth=0.9)
        back: dict[str, Any] = {"every": "places", "linestyle": "none", "clip_on": False}
        drawing.curve(errors, "motions", f"angle, {name}", **dot, **back)
    errors.plot([], [], color=GREY, linewidth=0.9, label="first order")
    errors.set_ylim(bottom=0)
    errors.legend(loc="upper left")
