"""What a word of 32 bits does to an attitude of many steps, on four motions."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond

from driftlab.attitude.finite_precision import UPDATES
from driftlab.book.machinery.picture import GREY, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import (
    ARITHMETICS,
    STEP_ANGLES,
    STORED_AS_ONE,
    WORD_MOTIONS,
    WORD_STEPS,
    ShortWord,
)

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
PAPERS_STEP = 2e-5
"""Angle of a step, in rad, whose vector part is 1e-5: the paper speaks of that and less."""


def columns(data: ShortWord) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {}
    for j, motion in enumerate(WORD_MOTIONS):
        for i, arithmetic in enumerate(ARITHMETICS):
            for u, update in enumerate(UPDATES):
                name = f"{motion}, {arithmetic}, {update}: rad over step in rad"
                curves[name] = (data.angles[j], data.errors[i, j, u])
        for u, update in enumerate(UPDATES):
            name = f"{motion}, length by {update}, over step in rad"
            curves[name] = (data.angles[j], data.stretched[j, u])
    return long_table(curves)


def restore(table: Mapping[str, Sequence[str]]) -> ShortWord:
    """Return the study that a CSV holds."""
    angles, values = (
        np.array(table[column], float).reshape(len(WORD_MOTIONS), -1, len(STEP_ANGLES))
        for column in ("x", "y")
    )
    # By motion: the errors by arithmetic and update, then the lengths by update.
    lengths = len(UPDATES)
    errors = values[:, :-lengths].reshape(len(WORD_MOTIONS), -1, lengths, len(STEP_ANGLES))
    return ShortWord(angles[:, 0], errors.swapaxes(0, 1), values[:, -lengths:])


@in_style
def draw(data: ShortWord, sheet: Sheet) -> Figure:
    """Draw the error of attitude over the angle of a step."""
    figure = Figure(figsize=(10.5, 6.6))
    panels = figure.subplots(2, 4, sharex=True, sharey=True)
    figure.subplots_adjust(0.075, 0.14, 0.985, 0.95, wspace=0.06, hspace=0.16)
    names = list(ARITHMETICS)
    for number, (arithmetic, title) in enumerate(DRAWN.items()):
        row = panels[number]
        for j, (panel, motion) in enumerate(zip(row, WORD_MOTIONS, strict=True)):
            panel.set(title="" if number else motion, xscale="log", yscale="log")
            panel.set(xlim=(7e-7, 1.4e-2), ylim=(1e-3, 1e2))
            panel.axvspan(7e-7, PAPERS_STEP, color=GREY, alpha=0.15)
            panel.axvline(STORED_AS_ONE, color=GREY, linestyle=":", linewidth=1.2)
            for u, (style, label) in enumerate(zip(STYLES, LABELS, strict=True)):
                error = data.errors[names.index(arithmetic), j, u]
                # No error at all has no place on a logarithmic axis.
                shown = np.where(error > 0, error / arcsecond, np.nan)
                panel.plot(data.angles[j], shown, **style, label=label)
        row[0].set(ylabel=f"{title}:\nerror after {WORD_STEPS} steps, arc seconds")
    for panel in panels[1]:
        panel.set(xlabel="angle of a step, rad")
    first = panels[0, 0]
    first.text(8e-7, 1.3e-3, "the paper's\nsteps", va="bottom", fontsize=8)
    first.text(1.15 * STORED_AS_ONE, 1.3e-3, r"$\lambda_0$ stored as 1" "\nto the left", fontsize=8)
    handles, labels = first.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=4)
    return figure
