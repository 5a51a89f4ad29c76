"""The ellipse of a gyro that answers late, and the drift that it makes."""

from typing import Any

from driftlab.book.ch07_coning.figures.algorithm_laboratory import STYLES
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, SERIES, decades


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the sums of two increments against each other, and the drift over the delay."""
    table = drawing.table
    panels = drawing.mosaic(
        "ab", (9.6, 4.0), (0.085, 0.15, 0.985, 0.91), spaces=(0.28, 0.2), column_height=5.0
    )
    ellipse, drift = panels["a"], panels["b"]
    ellipse.set(title=f"second gyro late by {table.late * 1e3:g} ms")
    ellipse.set(xlabel="turned along the axis, °", ylabel="seems turned across it, arcsec")
    drawing.curve(ellipse, "along", "across", **SERIES[0])
    drift.set(title=f"shaking at {table.words('frequency', 'g')}", xlabel="delay, s")
    drift.set(xscale="log", yscale="log", ylabel="apparent drift, deg/h")
    drift.set(xlim=(table.delay[0], table.delay[-1]))
    drift.set_ylim(*decades(table.shown("ellipse"), 1e-1, 1e3))
    wide: dict[str, Any] = {
        "color": GREY,
        "linewidth": 5,
        "alpha": 0.4,
        "label": "area of the ellipse",
    }
    drawing.curve(drift, "delay", "ellipse", **wide)
    for name in table.drift:
        look = {k: v for k, v in STYLES[name].items() if k in ("color", "linestyle")}
        drawing.curve(drift, "delay", f"drift, {name}", label=name, **look)
    drift.legend(loc="upper left")
