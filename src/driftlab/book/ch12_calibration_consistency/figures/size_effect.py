"""A lever arm of some centimetres: errors and stated deviations, and what the innovations see."""

import numpy as np
from matplotlib.axes import Axes
from scipy.constants import centi

from driftlab.book.ch11_kalman_calibration.experiments import TYPICAL_NOISE
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, GUIDE, SERIES
from driftlab.checks import FloatArray
from driftlab.motion.scheme import SCHEMES

from ..experiments import FILTERS, on_tables

KINDS = (
    ("gyro\nbias", 0, 3), ("gyro\nscale", 3, 6), ("gyro\nangles", 6, 9), ("acc.\nbias", 9, 12),
    ("acc.\nscale", 12, 15), ("acc.\nangles", 15, 21),
)  # fmt: skip
BOTTOM, TOP = 0.85, 500.0
"""Reach of what should be one, unless something leaves it."""


def caption(table: DataTable) -> str:
    """Say how wrong the filter is, and what its innovations show of it."""
    (arm,), arms = table.with_arms_of, on_tables(table, "arm")[0, 0]
    nearest = int(np.abs(arms - arm).argmin())
    squares, noticed, biases = (
        " and ".join(f"{value:{form}}" for value in _drawn(table, name)[:, nearest])
        for name, form in (("squares", ".0f"), ("noticed", ".2f"), ("worst", ".0f"))
    )
    ratios = np.abs(table.in_deviations)
    return (
        f"Each accelerometer lies {arm / centi:g} cm out on its own axis; the filter takes a "
        f"reference velocity of {100 * TYPICAL_NOISE.reference_velocity:g} cm/s. Left: one "
        "typical unit on the nineteen positions; the filter of 27 states is wrong by up to "
        f"{ratios[0].max():.0f} stated σ, its mean squared innovation "
        f"is {table.innovations_over_expected[0]:.3f}; with the nine components of the arms as "
        f"states the largest error is {ratios[1].max():.1f} σ. Right: expected squares of "
        "the 21 sensor errors and of the innovations, over what they should be; the band ends "
        "where the mean innovation of one calibration would pass its two-sided 95 % bound. On the "
        "nineteen "
        f"positions and on the eighteen rotations {arms[nearest] / centi:g} cm make an "
        f"accelerometer bias wrong by {biases} stated σ and the squares {squares} times "
        f"too large, while the innovations are {noticed} times what they should be."
    )


def _drawn(table: DataTable, name: str) -> FloatArray:
    """A column by scheme and arm, at the rate that is drawn."""
    return on_tables(table, name)[:, table.shape[1] // 2]


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the errors of one unit, and how both tests grow with the arm."""
    panels = drawing.mosaic(
        "ab", (10.5, 4.3), (0.07, 0.25, 0.985, 0.92), column_height=5.6, page_height=3.6
    )
    _draw_errors(drawing, panels["a"])
    _draw_tests(drawing, panels["b"])


def _draw_errors(drawing: Drawing, panel: Axes) -> None:
    table, on_paper = drawing.table, drawing.sheet.on_paper
    (arm,) = table.shown("with_arms_of")
    panel.set(title=f"errors with arms of {arm:g} cm, in stated deviations")
    drawing.spans(
        panel, "band_from_deviations", "band_to_deviations", along="y", facecolor="#e4eef5",
        edgecolor="none", label="within three deviations",
    )  # fmt: skip
    panel.axhline(0, color=BLACK, linewidth=0.8, label=GUIDE)
    size = 3 if on_paper else 5
    for name, style, marker in zip(FILTERS, SERIES, "os", strict=False):
        drawing.curve(panel, "number", f"in_deviations, {name}", color=style["color"],
                      marker=marker, markersize=size, linestyle="none", label=name)  # fmt: skip
    for _, begin, _ in KINDS[1:]:
        panel.axvline(begin + 0.5, color=GREY, linewidth=0.6, label=GUIDE)
    middles = [(begin + end + 1) / 2 for _, begin, end in KINDS]
    small = "small" if on_paper else 8
    panel.set_xticks(middles, [words for words, *_ in KINDS], fontsize=small)
    panel.set(xlim=(0.5, len(table.number) + 0.5))
    panel.tick_params(axis="x", length=0)
    if on_paper:
        panel.legend(loc="best", fontsize="small")
    else:
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=8)


def _draw_tests(drawing: Drawing, panel: Axes) -> None:
    table = drawing.table
    rate = np.degrees(_drawn(table, "rate")[0, 0])
    top = max(TOP, 2 * _drawn(table, "squares").max())
    panel.set(title=f"what should be one, table at {rate:g}°/s",
              xscale="log", yscale="log", xlabel="lever arm, cm", ylim=(BOTTOM, top))  # fmt: skip
    (high,) = table.clean_innovations_below
    panel.axhspan(BOTTOM, high, facecolor="#b9d6ea", edgecolor="none", label=GUIDE)
    drawing.level(panel, y="clean_innovations_below", color=BLACK, linewidth=1, linestyle=":",
                  label="95 % of clean innovations below")  # fmt: skip
    for scheme, marker, line in zip(SCHEMES, "os", ("-", "--"), strict=True):
        for name, style, face, words in (
            ("squares", SERIES[0], SERIES[0]["color"], "errors"),
            ("noticed", SERIES[1], "white", "innovations"),
        ):
            drawing.curve(
                panel, "arm", name, where={"table": f"{scheme} at {rate:g} deg/s"},
                color=style["color"], marker=marker, markerfacecolor=face, linestyle=line,
                label=f"{words}, {scheme}",
            )  # fmt: skip
    centimetres = _drawn(table, "arm")[0] / centi
    panel.set_xticks(centimetres, [f"{x:g}" for x in centimetres])
    decades = [10.0**k for k in range(int(np.log10(top)) + 1)]
    panel.set_yticks(decades, [f"{tick:g}" for tick in decades])
    panel.minorticks_off()
    panel.legend(loc="upper left", fontsize="small" if drawing.sheet.on_paper else 8)
