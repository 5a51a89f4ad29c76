"""Band width against sample rate, and the floors of rounding and noise under the drift."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from driftlab.book.ch07_coning.figures.algorithm_laboratory import STYLES
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, GUIDE, ORANGE, legend_below_all

LABELS = {
    "picard-1": "picard-1",
    "two-step-4": "two samples",
    "rotation-vector-3": "three samples",
    "four, spread": "four samples",
}
DASHES = ("-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)))
LINES: dict[str, dict[str, Any]] = {
    name: {"color": STYLES[name]["color"] if name in STYLES else BLACK, "linestyle": dashes}
    for name, dashes in zip(LABELS, DASHES, strict=True)
}
"""Colours as in the other figures; dashes that differ where the curves lie close together."""
DECADES = (-5, 3.5)
"""Least reach of the axis of the drift: powers of ten, deg/h."""


@from_table
def draw(drawing: Drawing) -> None:
    """Draw what is missed of the coning, and the drift on the cone with its floors."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 4.8), (0.075, 0.2, 0.985, 0.92), spaces=(0.22, 0.2), column_height=6.2,
        page_height=3.7,
    )  # fmt: skip
    band, floors = panels["a"], panels["b"]
    _draw_band(band, drawing)
    marks = _draw_floors(floors, drawing)
    handles = [band.plot([], [], **LINES[name], label=label)[0] for name, label in LABELS.items()]
    where = "above" if sheet.narrow else "left"
    words = f"first term of the series ({where})"
    handles += band.plot([], [], color=GREY, linewidth=0.7, label=words)
    if sheet.narrow:
        handles += marks
    else:
        floors.legend(handles=marks, loc="lower left", fontsize="small")
    legend_below_all(drawing.figure, sheet, handles, ncols=5, points=8)


def _draw_band(panel: Axes, drawing: Drawing) -> None:
    panel.set(title="any narrow cone", xlabel="samples in a round", xscale="log", yscale="log")
    panel.set(ylabel="part of the coning that is missed", xlim=(1, 100), ylim=(1e-9, 30))
    panel.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    panel.minorticks_off()
    panel.axvspan(1, 2, color=GREY, alpha=0.2, linewidth=0, label=GUIDE)
    panel.text(1.05, 3e-9, "aliased", color=BLACK, fontsize="small")
    for name, label in LABELS.items():
        line, missed = LINES[name], f"missed, {name}"
        drawing.curve(panel, "samples_a_round", missed, **line, label=label)
        thin = {"color": line["color"], "linewidth": 0.7, "label": f"{label}, first term"}
        drawing.curve(panel, "samples_a_round", f"{missed}, first term", **thin)


def _draw_floors(panel: Axes, drawing: Drawing) -> list[Line2D]:
    """Draw them, and return the rows of their legend."""
    table = drawing.table
    cone = f"cone of {table.words('half_angle', 'g')} at {table.words('frequency', 'g')}"
    panel.set(title=f"{cone}, in {table.words('seconds', 'g')}")
    panel.set(xlabel="sample rate, Hz", ylabel="apparent drift, deg/h", xscale="log", yscale="log")
    panel.set(xlim=table.curve_rate[[0, -1]])
    panel.set_xticks([20, 50, 100, 200, 400], ["20", "50", "100", "200", "400"])
    panel.minorticks_off()
    for name, label in LABELS.items():
        drawing.curve(panel, "curve_rate", f"drift, {name}", **LINES[name], label=label)
    marks = [
        drawing.curve(panel, "rate", "rounding_lost", linestyle="none", marker="x", color=GREY,
                      label="rounding, remainder lost"),
        drawing.curve(panel, "rate", "rounding_carried", linestyle="none", marker="o",
                      color=ORANGE, label="remainder carried"),
        drawing.curve(panel, "curve_rate", "rounding_carried_expected", color=ORANGE,
                      linewidth=0.8, label="the same, expected"),
        drawing.curve(panel, "curve_rate", "white_noise", color=GREY, linestyle=":", linewidth=2,
                      label="white noise, one sigma"),
    ]  # fmt: skip
    lost, carried, white = map(table.shown, ("rounding_lost", "rounding_carried", "white_noise"))
    floors = np.log10([lost.max(), carried.min(), carried.max(), white[0]])
    low, high = min(DECADES[0], floors.min() - 2), max(DECADES[1], floors.max() + 1)
    panel.set_ylim(10.0**low, 10.0**high)
    return marks
