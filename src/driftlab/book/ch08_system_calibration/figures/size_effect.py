"""A lever arm of some centimetres: errors and stated deviations, and what the innovations see."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import centi

from driftlab.book.machinery.picture import BLACK, GREY, GUIDE, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.checks import FloatArray
from driftlab.monte_carlo import mean_square_bounds
from driftlab.motion.scheme import SCHEMES

from ..experiments import SizeEffect

NAMES = ERROR_MODELS["averaged"].names[6:]
KINDS = (
    ("gyro\nbias", 0, 3), ("gyro\nscale", 3, 6), ("gyro\nangles", 6, 9), ("acc.\nbias", 9, 12),
    ("acc.\nscale", 12, 15), ("acc.\nangles", 15, 21),
)  # fmt: skip
FILTERS = ("filter of 27 states", "with the arms as states")
FOUND = ("squares", "noticed", "worst", "bias")
BOTTOM, TOP = 0.85, 500.0
"""Reach of what should be one, unless something leaves it."""
BAND = 3.0
"""Stated deviations within which errors should be."""


def columns(data: SizeEffect) -> dict[str, Any]:
    """Columns of the figure's CSV: a row for each sensor error, and one for each table and arm."""
    shape = data.squares.shape
    scheme, rate, arm = (index.ravel() for index in np.indices(shape))
    names, rates = list(SCHEMES), np.degrees(data.rates)
    return {
        "sensor_error": list(NAMES),
        "number": np.arange(1, len(NAMES) + 1),
        **{f"in_deviations, {name}": row for name, row in zip(FILTERS, data.ratios, strict=True)},
        "innovations_over_expected": data.innovations,
        "with_arms_of_cm": [data.arm / centi],
        "table": [f"{names[i]} at {rates[k]:g} deg/s" for i, k in zip(scheme, rate, strict=True)],
        "rate_deg_per_s": rates[rate],
        "arm_cm": data.sizes[arm] / centi,
        **{name: getattr(data, name).ravel() for name in FOUND},
        "updates": data.updates[scheme, rate],
        "band_from_deviations": [-BAND],
        "band_to_deviations": [BAND],
        "clean_innovations_below": [_bound(data)],
    }


def restore(table: Mapping[str, Sequence[str]]) -> SizeEffect:
    """Return the study that a CSV holds."""

    def numbers(name: str) -> FloatArray:
        return np.array([float(word) for word in table[name] if word])

    arms, rates = (np.array(list(dict.fromkeys(numbers(n)))) for n in ("arm_cm", "rate_deg_per_s"))
    shape = (len(SCHEMES), len(rates), len(arms))
    squares, noticed, worst, bias, updates = (
        numbers(name).reshape(shape) for name in (*FOUND, "updates")
    )
    return SizeEffect(
        float(numbers("with_arms_of_cm")[0] * centi),
        np.radians(rates),
        arms * centi,
        np.stack([numbers(f"in_deviations, {name}") for name in FILTERS]),
        numbers("innovations_over_expected"),
        squares,
        noticed,
        worst,
        bias,
        updates[..., 0],
    )


def caption(data: SizeEffect) -> str:
    """Say how wrong the filter is, and what its innovations show of it."""
    nearest = int(np.abs(data.sizes - data.arm).argmin())
    at = (slice(None), data.shown, nearest)
    squares, noticed, biases = (
        " and ".join(f"{value:{form}}" for value in rows[at])
        for rows, form in ((data.squares, ".0f"), (data.noticed, ".2f"), (data.worst, ".0f"))
    )
    return (
        f"Each accelerometer lies {data.arm / centi:g} cm out on its own axis. Left: one "
        "typical unit on the nineteen positions; the filter of 27 states is wrong by up to "
        f"{np.abs(data.ratios[0]).max():.0f} of its stated deviations, its mean squared innovation "
        f"is {data.innovations[0]:.3f}; with the nine components of the arms as states the largest "
        f"error is {np.abs(data.ratios[1]).max():.1f} deviations. Right: expected squares of the "
        "21 sensor errors and of the innovations, over what they should be; the band ends where "
        "the mean innovation of one calibration would be too large at 95 %. On the nineteen "
        f"positions and on the eighteen rotations {data.sizes[nearest] / centi:g} cm make an "
        f"accelerometer bias wrong by {biases} stated deviations and the squares {squares} times "
        f"too large, while the innovations are {noticed} times what they should be."
    )


@in_style
def draw(data: SizeEffect, sheet: Sheet) -> Figure:
    """Draw the errors of one unit, and how both tests grow with the arm."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.3), (0.07, 0.25, 0.985, 0.92), column_height=5.6, page_height=3.6
    )
    _draw_errors(panels["a"], data, sheet)
    _draw_tests(panels["b"], data, sheet)
    return figure


def _draw_errors(panel: Axes, data: SizeEffect, sheet: Sheet) -> None:
    panel.set(title=f"errors with arms of {data.arm / centi:g} cm, in stated deviations")
    panel.axhspan(
        -BAND, BAND, facecolor="#e4eef5", edgecolor="none", label="within three deviations"
    )
    panel.axhline(0, color=BLACK, linewidth=0.8, label=GUIDE)
    places = np.arange(1, data.ratios.shape[-1] + 1)
    size = 3 if sheet.on_paper else 5
    for ratios, style, marker, label in zip(data.ratios, SERIES, "os", FILTERS, strict=False):
        panel.plot(places, ratios, color=style["color"], marker=marker, markersize=size,
                   linestyle="none", label=label)  # fmt: skip
    for _, begin, _ in KINDS[1:]:
        panel.axvline(begin + 0.5, color=GREY, linewidth=0.6, label=GUIDE)
    middles = [(begin + end + 1) / 2 for _, begin, end in KINDS]
    small = "small" if sheet.on_paper else 8
    panel.set_xticks(middles, [words for words, *_ in KINDS], fontsize=small)
    panel.set(xlim=(0.5, len(places) + 0.5))
    panel.tick_params(axis="x", length=0)
    if sheet.on_paper:
        panel.legend(loc="best", fontsize="small")
    else:
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=8)


def _bound(data: SizeEffect) -> float:
    """What 95 % of the mean squared innovations of right filters are below, over expected."""
    _, high = mean_square_bounds(3, int(data.updates[0, data.shown]))
    return high / 3


def _draw_tests(panel: Axes, data: SizeEffect, sheet: Sheet) -> None:
    shown = data.shown
    top = max(TOP, 2 * data.squares[:, shown].max())
    panel.set(title=f"what should be one, table at {np.degrees(data.rates[shown]):g}°/s",
              xscale="log", yscale="log", xlabel="lever arm, cm", ylim=(BOTTOM, top))  # fmt: skip
    high = _bound(data)
    panel.axhspan(BOTTOM, high, facecolor="#b9d6ea", edgecolor="none", label=GUIDE)
    panel.axhline(high, color=BLACK, linewidth=1, linestyle=":",
                  label="95 % of clean innovations below")  # fmt: skip
    centimetres = data.sizes / centi
    for i, (scheme, marker) in enumerate(zip(SCHEMES, "os", strict=True)):
        for rows, style, face, words in (
            (data.squares, SERIES[0], SERIES[0]["color"], "errors"),
            (data.noticed, SERIES[1], "white", "innovations"),
        ):
            panel.plot(centimetres, rows[i, shown], color=style["color"], marker=marker,
                       markerfacecolor=face, linestyle=("-", "--")[i],
                       label=f"{words}, {scheme}")  # fmt: skip
    panel.set_xticks(centimetres, [f"{x:g}" for x in centimetres])
    decades = [10.0**k for k in range(int(np.log10(top)) + 1)]
    panel.set_yticks(decades, [f"{tick:g}" for tick in decades])
    panel.minorticks_off()
    panel.legend(loc="upper left", fontsize="small" if sheet.on_paper else 8)
