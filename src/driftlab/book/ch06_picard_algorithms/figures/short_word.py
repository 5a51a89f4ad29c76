"""What a word of 32 bits does to an attitude of many steps, on four motions."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond

from driftlab.attitude.finite_precision import UPDATES
from driftlab.book.machinery.picture import GREY, GUIDE, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import (
    ARITHMETICS,
    STORED_AS_ONE,
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
KEYS = ("motion", "arithmetic", "update")
"""Columns of words in the CSV."""
DRAWN = {"rounded": "each product and sum rounded", "fused, normalised": "fused, and normalised"}
"""The two of `ARITHMETICS` that differ most, with their titles."""
STORED = "$\\lambda_0$ stored as 1\nto the left"
PAPERS_STEP = 2e-5
"""Angle of a step, in rad, whose vector part is 1e-5: the paper speaks of that and less."""


STEPS = (7e-7, 1.4e-2)
ERRORS = (1e-3, 1e2)
"""Least reach of the axes, rad and arc seconds."""


def columns(data: ShortWord) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV, a row for each motion, arithmetic, update and angle of a step.

    `length_error` is without fused products and without mending.
    """
    shape = (len(data.motions), len(ARITHMETICS), len(UPDATES), data.angles.shape[-1])
    names = (data.motions, ARITHMETICS, UPDATES)
    keys = np.indices(shape)[:3]
    lengths = np.full(shape, np.nan)
    lengths[:, list(ARITHMETICS).index("rounded")] = data.stretched
    words = {
        name: [of[i] for i in k.ravel()]
        for name, of, k in zip(KEYS, map(list, names), keys, strict=True)
    }
    return {
        **words,
        "step_rad": np.broadcast_to(data.angles[:, np.newaxis, np.newaxis], shape).ravel(),
        "error_arcsec": _shown(data.errors).swapaxes(0, 1).ravel(),
        "length_error": lengths.ravel(),
        "stored_as_one_rad": np.array([STORED_AS_ONE]),
    }


def restore(table: Mapping[str, Sequence[str]]) -> ShortWord:
    """Return the study that the published CSV holds."""
    motions = tuple(dict.fromkeys(table[KEYS[0]]))
    angles, errors, lengths = (
        np.array([float(word or "nan") for word in table[column]]).reshape(
            len(motions), len(ARITHMETICS), len(UPDATES), -1
        )
        for column in ("step_rad", "error_arcsec", "length_error")
    )
    stretched = lengths[:, list(ARITHMETICS).index("rounded")]
    return ShortWord(motions, angles[:, 0, 0], arcsecond * errors.swapaxes(0, 1), stretched)


@in_style
def draw(data: ShortWord, sheet: Sheet) -> Figure:
    """Draw the error of attitude over the angle of a step."""
    many, letters = len(data.motions), "abcdefghijklmnop"
    rows = [letters[:many], letters[many : 2 * many]]
    figure, mosaic = sheet.mosaic(
        ";".join(rows), (1.1 + 2.35 * many, 6.6), (0.075, 0.14, 0.985, 0.95), spaces=(0.06, 0.16),
        column=";".join(map("".join, zip(*rows, strict=True))), column_height=1.0 + 1.8 * many,
        page_height=5.0, sharex=True, sharey=True,
    )  # fmt: skip
    names = list(ARITHMETICS)
    drawn = _shown(data.errors[[names.index(arithmetic) for arithmetic in DRAWN]])
    bottom, top = min(ERRORS[0], np.nanmin(drawn) / 2), max(ERRORS[1], 2 * np.nanmax(drawn))
    bottom *= 0.3 if sheet.narrow else 1.0  # room for words
    for row, errors, (short, title) in zip(rows, drawn, DRAWN.items(), strict=True):
        first = row == rows[0]
        for j, letter in enumerate(row):
            panel, motion = mosaic[letter], data.motions[j]
            panel.set(xscale="log", yscale="log", xlim=STEPS, ylim=(bottom, top))
            panel.axvspan(STEPS[0], PAPERS_STEP, color=GREY, alpha=0.15, label=GUIDE)
            panel.axvline(STORED_AS_ONE, color=GREY, linestyle=":", linewidth=1.2)
            for style, label, error in zip(STYLES, LABELS, errors[j], strict=True):
                panel.plot(data.angles[j], error, **style, label=label)
            if sheet.narrow:
                panel.set_title(motion if j else f"{short}:\n{motion}")
            elif first:
                panel.set_title(motion)
            if j == many - 1 if sheet.narrow else not first:
                panel.set_xlabel("angle of a step, rad")
            if sheet.narrow and first:
                panel.set_ylabel("error, arc seconds")
        if not sheet.narrow:
            mosaic[row[0]].set_ylabel(_ordinate(title, data.steps, sheet))
    first_panel = mosaic["a"]
    stored = "left: $\\lambda_0$\nstored as 1" if sheet.on_paper else STORED
    for x, words in ((8e-7, "the paper's\nsteps"), (1.15 * STORED_AS_ONE, stored)):
        first_panel.text(x, 1.3 * bottom, words, va="bottom", fontsize="small")
    legend_below_all(figure, sheet, first_panel, column=1)
    return figure


def _shown(errors: FloatArray) -> FloatArray:
    """Errors in arc seconds, but none where there is none: it has no place on such an axis."""
    return np.where(errors > 0, errors / arcsecond, np.nan)


def _ordinate(title: str, steps: int, sheet: Sheet) -> str:
    if sheet.on_paper:
        return f"{title}:\nerror, arc seconds"
    return f"{title}:\nerror after {steps} steps, arc seconds"
