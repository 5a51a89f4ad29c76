"""How long to average before an alignment: two kinds of noise, and the heading they leave."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, SERIES, legend_below_all

from ..experiments import GYROS


@from_table
def draw(drawing: Drawing) -> None:
    """Two families of curves on logarithmic axes, one for each kind of noise."""
    table, sheet = drawing.table, drawing.sheet
    mosaic = drawing.mosaic(
        "ab", (10.0, 4.0), (0.075, 0.13, 0.985, 0.92), spaces=(0.06, 0.2), column_height=5.6,
        page_height=3.6, sharey=True,
    )  # fmt: skip
    panels = list(mosaic.values())
    cases = (
        (f"a slow part of {table.shown('gauss_markov'):.3g} deg/h: a floor", "spread",
         "moving_average",
         table.shown("averaged")),
        ("the rival, a rounded angle: no floor", "rival_spread", "rival_window",
         table.shown("rival_averaged")),
    )  # fmt: skip
    for panel, (title, spread, marked, (quiet, noisy)) in zip(panels, cases, strict=True):
        panel.set(xscale="log", yscale="log", xlim=(0.9, 1.1 * table.samples[-1]), title=title)
        panel.set(xlabel="samples in the mean (ten a second)")
        drawing.level(panel, x=marked, color=GREY, linewidth=0.8)
        (window,) = table.shown(marked)
        panel.annotate(
            f"{quiet:.1g} and {noisy:.1g} deg/h\nafter {window} samples", (1.1 * window, 0.97),
            xycoords=("data", "axes fraction"), fontsize="small", va="top",
        )  # fmt: skip
        for i, (gyro, white) in enumerate(zip(GYROS, table.shown("white"), strict=True)):
            color = SERIES[i]["color"]
            drawing.curve(
                panel, "samples", f"{spread}, {gyro}, simulated", color=color, marker="os"[i],
                linestyle="none", label=f"simulated, {white:g} deg/h a sample",
            )  # fmt: skip
            drawing.curve(
                panel, "samples", f"{spread}, {gyro}, formula", **SERIES[i], label="formula"
            )
            drawing.curve(
                panel, "samples", f"spread, {gyro}, white_alone", color=color, linewidth=1.0,
                linestyle=(":", (0, (1, 4)))[i], label="if all of it were white",
            )  # fmt: skip
    shown = np.degrees([table.spread[:, :2], table.rival_spread])
    panels[0].set_ylim(min(0.002, shown.min() / 1.2), max(5.0, 1.6 * shown.max()))
    of_what = "" if sheet.on_paper else f" of {table.runs} alignments"
    for panel in panels if sheet.narrow else panels[:1]:
        panel.set_ylabel(f"spread of the heading{of_what}, degrees")
    if sheet.on_paper:
        legend_below_all(drawing.figure, sheet, panels[0], ncols=2, column=1)
    else:
        panels[0].legend(loc="lower left", fontsize=8, labelspacing=0.25, handlelength=1.6)
