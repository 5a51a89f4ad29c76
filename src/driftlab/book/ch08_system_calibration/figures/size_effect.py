"""A lever arm of three centimetres: errors and stated deviations, and what the innovations see."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.monte_carlo import mean_square_bounds
from driftlab.motion.scheme import SCHEMES

from ..experiments import ARM, ARM_SIZES, RATES, SizeEffect

KINDS = (
    ("gyro\nbias", 0, 3), ("gyro\nscale", 3, 6), ("gyro\nangles", 6, 9), ("acc.\nbias", 9, 12),
    ("acc.\nscale", 12, 15), ("acc.\nangles", 15, 21),
)  # fmt: skip
SHOWN = RATES.index(10.0)


@in_style
def draw(data: SizeEffect, sheet: Sheet) -> Figure:
    """Draw the errors of one unit, and how both tests grow with the arm."""
    figure = Figure(figsize=(10.5, 4.3))
    errors, tests = figure.subplots(1, 2)
    figure.subplots_adjust(0.07, 0.25, 0.985, 0.92, wspace=0.2)
    _draw_errors(errors, data)
    _draw_tests(tests, data)
    return figure


def _draw_errors(panel: Axes, data: SizeEffect) -> None:
    panel.set(title=f"errors with arms of {100 * ARM:.0f} cm, in stated deviations")
    panel.axhspan(-3, 3, facecolor="#e4eef5", edgecolor="none", label="within three deviations")
    panel.axhline(0, color=BLACK, linewidth=0.8)
    places = np.arange(data.ratios.shape[-1])
    words = "filter of 27 states", "with the arms as states"
    for ratios, style, marker, label in zip(data.ratios, SERIES, "os", words, strict=False):
        panel.plot(places, ratios, color=style["color"], marker=marker, markersize=5,
                   linestyle="none", label=label)  # fmt: skip
    for _, begin, _ in KINDS[1:]:
        panel.axvline(begin - 0.5, color=GREY, linewidth=0.6)
    middles = [(begin + end - 1) / 2 for _, begin, end in KINDS]
    panel.set_xticks(middles, [words for words, *_ in KINDS], fontsize=8)
    panel.set(xlim=(-0.5, len(places) - 0.5))
    panel.tick_params(axis="x", length=0)
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=8)


def _draw_tests(panel: Axes, data: SizeEffect) -> None:
    panel.set(title=f"what should be one, table at {RATES[SHOWN]:.0f}°/s", xscale="log",
              yscale="log", xlabel="lever arm, cm", ylim=(0.85, 500))  # fmt: skip
    _, high = mean_square_bounds(3, int(data.updates[0, SHOWN]))
    panel.axhspan(0.85, high / 3, facecolor="#b9d6ea", edgecolor="none")
    panel.axhline(high / 3, color=BLACK, linewidth=1, linestyle=":",
                  label="95 % of clean innovations below")  # fmt: skip
    centimetres = 100 * np.array(ARM_SIZES)
    for i, (scheme, marker) in enumerate(zip(SCHEMES, "os", strict=True)):
        for rows, style, face, words in (
            (data.squares, SERIES[0], SERIES[0]["color"], "errors"),
            (data.noticed, SERIES[1], "white", "innovations"),
        ):
            panel.plot(centimetres, rows[i, SHOWN], color=style["color"], marker=marker,
                       markerfacecolor=face, linestyle=("-", "--")[i],
                       label=f"{words}, {scheme}")  # fmt: skip
    panel.set_xticks(centimetres, [f"{x:g}" for x in centimetres])
    panel.set_yticks([1, 10, 100], ["1", "10", "100"])
    panel.minorticks_off()
    panel.legend(loc="upper left", fontsize=8)
