"""Order of each attitude algorithm, measured on motions that show it and motions that hide it."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import legend_below_all
from driftlab.checks import FloatArray

from .algorithm_laboratory import draw_slopes, styles

SLOPES_FROM = 1e-11
"""Error at which the lines of known order begin, rad."""


@from_table
def draw(drawing: Drawing) -> None:
    """Draw one panel a motion."""
    table, sheet = drawing.table, drawing.sheet
    motions, looks = list(table.orders), styles(next(iter(table.orders.values())), sheet)
    letters = "abcdefghijklmnop"[: len(motions)]
    padded = letters + "." * (len(letters) % 2 if len(letters) > 1 else 0)
    rows = [padded[i : i + 2] for i in range(0, len(padded), 2)]
    mosaic = drawing.mosaic(
        ";".join(rows), (10.0, 3.6 * len(rows)), (0.085, 0.27 / len(rows), 0.985, 0.955),
        spaces=(0.06, 0.16), column_height=0.8 + 1.9 * len(letters), sharex=True, sharey=True,
    )  # fmt: skip
    panels = [mosaic[letter] for letter in letters]
    first, last = table.rate[[0, -1]]
    top = 3.0 if np.nanmax(table.largest_error) < 3 else 10.0
    for place, (panel, motion) in enumerate(zip(panels, motions, strict=True)):
        panel.set(title=motion, xscale="log", yscale="log", ylim=(1e-16, top))
        panel.set(xlim=(0.875 * first, 1.172 * last))
        panel.set_xticks(table.rate, [f"{rate:g}" for rate in table.rate])
        panel.minorticks_off()
        if _leave_room(table.largest_error[place], table.rate):
            named = (2, 4) if sheet.narrow else (2, 3, 4)
            size = "small" if sheet.on_paper else None
            draw_slopes(panel, first, SLOPES_FROM, named, fontsize=size)
        for name, look in looks.items():
            drawing.curve(panel, "rate", f"largest_error, {motion}, {name}", **look, label=name)
        across = 1 if sheet.narrow else 2
        if place >= len(panels) - across:
            panel.set_xlabel("sample rate, Hz")
        if place % across == 0:
            of_what = "" if sheet.on_paper else " of attitude"
            panel.set_ylabel(f"largest error{of_what}, rad")
    handles, _ = panels[0].get_legend_handles_labels()
    most = min(len(handles), 4 if sheet.on_paper else 7)
    legend_below_all(drawing.figure, sheet, handles, most, points=8)


def _leave_room(errors: FloatArray, rates: FloatArray) -> bool:
    """Whether no error lies where the lines of known order and their names stand."""
    there = rates < 14 * rates[0]
    line = SLOPES_FROM * (rates[there] / rates[0]) ** -2.0
    return bool(np.all(errors[:, there] > 2 * line))
