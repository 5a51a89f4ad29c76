"""Settling on a ship that rolls, pitches and sways: time, remaining swing, gain by a turn."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GUIDE, SERIES, legend_below_all
from driftlab.gyrocompass.type_test import LIMITS

from ..experiments.at_sea import HORIZONS

LABELS = "stiff horizon", "soft horizon", "Schuler's period", "gravity in inertial space"


@from_table
def draw(drawing: Drawing) -> None:
    """Times and swings over the period of the waves; deviations over the turn."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "abc", (10.5, 3.7), (0.06, 0.23, 0.985, 0.91), spaces=(0.22, 0.3), column_height=9.0,
        page_height=3.0,
    )  # fmt: skip
    times, swings, turned = (panels[letter] for letter in "abc")
    for style, way, label in zip(SERIES, (*HORIZONS, "inertial"), LABELS, strict=False):
        for panel, name in ((times, "settling"), (swings, "swing")):
            drawing.curve(panel, "period", f"{name}, {way}", **style, marker="o", label=label)
    for panel, limit in ((times, LIMITS["settling at sea"].size / 60), (swings, 1.0)):
        panel.axhline(limit, color=BLACK, linewidth=1.0, label=GUIDE)
        panel.text(table.shown("period")[0], 1.1 * limit, "limit", fontsize="small")
        panel.set(xlabel="period of the waves, s", yscale="log")
        panel.yaxis.set_major_formatter("{x:g}")
    times.set(title="settled after, minutes", ylim=(0.5, 1000))
    swings.set(title="error that stays, over the limit")
    for name, style in zip(table.entry("deviation").names, SERIES, strict=False):
        drawing.curve(turned, "turn", f"deviation, {name}", **style, marker="o", label=name)
    turned.set(title="spread of the heading, degrees", xlabel="turn of the ship, degrees")
    turned.set(xlim=(-5, 185), xticks=range(0, 181, 45), ylim=(0, None))
    turned.legend(loc="center right", fontsize="small")
    legend_below_all(drawing.figure, sheet, times, 2 if sheet.on_paper else 4)
