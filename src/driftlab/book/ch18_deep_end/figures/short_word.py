"""What a word of 32 bits does to an attitude of many steps, on four motions."""

import numpy as np

from driftlab.attitude.finite_precision import UPDATES
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, GUIDE, SERIES, legend_below_all

from ..experiments import STORED_AS_ONE

LABELS = (
    r"product with $\lambda_0$",
    "small terms first",
    r"sum, with $1-\lambda_0$ (the paper's advice)",
    "compensated sum",
)
STYLES = tuple(
    {**style, "marker": marker, "markersize": 4}
    for style, marker in zip((SERIES[1], SERIES[3], SERIES[0], SERIES[2]), "sDov", strict=True)
)
DRAWN = {"rounded": "each product and sum rounded", "fused, normalised": "fused, and normalised"}
"""The two of `ARITHMETICS` that differ most, with their titles."""
STORED = "$\\lambda_0$ stored as 1\nto the left"
PAPERS_STEP = 2e-5
"""Angle of a step, in rad, whose vector part is 1e-5: the paper speaks of that and less."""
STEPS = (7e-7, 1.4e-2)
ERRORS = (1e-3, 1e2)
"""Least reach of the axes, rad and arc seconds."""


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the error of attitude over the angle of a step."""
    table, sheet = drawing.table, drawing.sheet
    motions, letters = [*dict.fromkeys(table.motion)], "abcdefghijklmnop"
    many = len(motions)
    rows = [letters[:many], letters[many : 2 * many]]
    mosaic = drawing.mosaic(
        ";".join(rows), (1.1 + 2.35 * many, 6.6), (0.075, 0.14, 0.985, 0.95), spaces=(0.06, 0.16),
        column=";".join(map("".join, zip(*rows, strict=True))), column_height=1.0 + 1.8 * many,
        page_height=5.0, sharex=True, sharey=True,
    )  # fmt: skip
    drawn = table.shown("error")[np.isin(table.arithmetic, [*DRAWN])]
    bottom, top = min(ERRORS[0], np.nanmin(drawn) / 2), max(ERRORS[1], 2 * np.nanmax(drawn))
    bottom *= 0.3 if sheet.narrow else 1.0  # room for words
    for row, (arithmetic, title) in zip(rows, DRAWN.items(), strict=True):
        first = row == rows[0]
        for letter, motion in zip(row, motions, strict=True):
            panel = mosaic[letter]
            panel.set(xscale="log", yscale="log", xlim=STEPS, ylim=(bottom, top))
            panel.axvspan(STEPS[0], PAPERS_STEP, color=GREY, alpha=0.15, label=GUIDE)
            drawing.level(panel, x="stored_as_one", color=GREY, linestyle=":", linewidth=1.2)
            for update, style, label in zip(UPDATES, STYLES, LABELS, strict=True):
                where = {"motion": motion, "arithmetic": arithmetic, "update": update}
                drawing.curve(panel, "step", "error", where=where, **style, label=label)
            if sheet.narrow:
                panel.set_title(f"{arithmetic}:\n{motion}" if letter == row[0] else motion)
            elif first:
                panel.set_title(motion)
            if letter == row[-1] if sheet.narrow else not first:
                panel.set_xlabel("angle of a step, rad")
            if sheet.narrow and first:
                panel.set_ylabel("error, arc seconds")
        if not sheet.narrow:
            when = "" if sheet.on_paper else f" after {table.steps} steps"
            mosaic[row[0]].set_ylabel(f"{title}:\nerror{when}, arc seconds")
    first_panel = mosaic["a"]
    stored = "left: $\\lambda_0$\nstored as 1" if sheet.on_paper else STORED
    for x, words in ((8e-7, "the paper's\nsteps"), (1.15 * STORED_AS_ONE, stored)):
        first_panel.text(x, 1.3 * bottom, words, va="bottom", fontsize="small")
    legend_below_all(drawing.figure, sheet, first_panel, column=1)
