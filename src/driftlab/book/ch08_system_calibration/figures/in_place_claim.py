"""Does the averaged choice of axes deviate less? The claim after Wu Figs. 3-5, over many units."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.motion.scheme import SCHEMES

from ..experiments import (
    ALL_STARTS,
    AT_REST_SIZES,
    QUANTITIES,
    TRIANGLES,
    Comparison,
    InPlaceClaim,
)

WIDE = (0.3, [0.3, 0.5, 1, 2, 3], 3.3)
NARROW = (0.95, [0.96, 0.98, 1.0, 1.02, 1.04], 1.05)
"""Limits and ticks of the ratios. Typical units differ by more than a few per cent only if they
start from the table's axes."""


def columns(data: InPlaceClaim) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: one row a unit."""
    return {_title(key): ratios.round(7) for key, ratios in data.ratios.items()}


def restore(table: Mapping[str, Sequence[str]]) -> InPlaceClaim:
    """Return the study that a CSV holds."""
    return InPlaceClaim({_comparison(title): np.array(row, float) for title, row in table.items()})


def _title(key: Comparison) -> str:
    return (
        f"{key.scheme}, {key.size} arc seconds, {key.rival}, start from {key.start}, {key.quantity}"
    )


def _comparison(title: str) -> Comparison:
    scheme, size, rival, start, quantity = title.split(", ")
    return Comparison(
        scheme, int(size.split()[0]), rival, start.removeprefix("start from "), quantity
    )


@in_style
def draw(data: InPlaceClaim, sheet: Sheet) -> Figure:
    """Draw a column for each start: distributions of the ratio in one case, counts in all."""
    figure = Figure(figsize=(10.5, 9.0))
    rows = figure.subplots(3, len(ALL_STARTS), gridspec_kw={"height_ratios": [1, 1, 1.75]})
    figure.subplots_adjust(0.085, 0.115, 0.985, 0.965, wspace=0.13, hspace=0.37)
    for size, panels in zip(AT_REST_SIZES, rows, strict=False):
        for start, panel in zip(ALL_STARTS, panels, strict=True):
            _draw_ratios(panel, data, size, start)
        panels[0].set_ylabel("part of the units below")
    for start, panel in zip(ALL_STARTS, rows[-1], strict=True):
        _draw_counts(panel, data, start)
        panel.set_yticks(range(len(QUANTITIES)), QUANTITIES if panel is rows[-1, 0] else [])
    below = (
        (0.465, f"error with averaged axes / with {TRIANGLES[0]}, {next(iter(SCHEMES))}"),
        (0.072, "part of the units with less error in averaged axes"),
    )
    for height, words in below:
        figure.text(0.535, height, words, ha="center", fontsize=10)
    rows[0, 0].legend(loc="lower right", fontsize=8)
    handles, labels = rows[-1, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=4, fontsize=8)
    return figure


def _draw_ratios(panel: Axes, data: InPlaceClaim, size: int, start: str) -> None:
    """Distribution functions of the ratio, on the first scheme and against the first triangle."""
    typical = size == AT_REST_SIZES[0] and start != ALL_STARTS[-1]
    low, ticks, high = NARROW if typical else WIDE
    panel.set(xscale="log", xlim=(low, high), ylim=(0, 1))
    panel.set_title(f"{size}″, start from {start}", fontsize=9)
    panel.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    panel.minorticks_off()
    panel.axvline(1.0, color=BLACK, linewidth=0.8)
    panel.axhline(0.5, color=GREY, linewidth=0.8)
    if start != ALL_STARTS[0]:
        panel.tick_params(labelleft=False)
    for quantity, style in zip(QUANTITIES, SERIES, strict=False):
        key = Comparison(next(iter(SCHEMES)), size, TRIANGLES[0], start, quantity)
        ratios = np.sort(data.ratios[key])
        parts = np.arange(1, len(ratios) + 1) / len(ratios)
        panel.step(ratios, parts, where="post", **style, label=quantity)


def _draw_counts(panel: Axes, data: InPlaceClaim, start: str) -> None:
    """Part of the units that err less with averaged axes, with 95 % intervals, in all cases."""
    panel.set(xlim=(0.3, 0.9), ylim=(len(QUANTITIES) - 0.5, -0.5))
    panel.set_title(f"all, start from {start}", fontsize=9)
    panel.axvline(0.5, color=BLACK, linewidth=0.8)
    counted = data.counted()
    cases = [(s, rival, size) for s in SCHEMES for rival in TRIANGLES for size in AT_REST_SIZES]
    for k, (scheme, rival, size) in enumerate(cases):
        for row, quantity in enumerate(QUANTITIES):
            found = counted[Comparison(scheme, size, rival, start, quantity)]
            part = found.better / found.units
            low, high = found.interval
            panel.errorbar(
                [part], [row + 0.1 * (k - 3.5)], xerr=[[part - low], [high - part]],
                color=SERIES[k // 2]["color"], marker="os^D"[k // 2], markersize=4.5,
                linestyle="none", markerfacecolor="white" if size == AT_REST_SIZES[0] else None,
                label=f"{scheme}, {rival}, {size}″" if row == 0 else None,
            )  # fmt: skip
    for row in range(1, len(QUANTITIES)):
        panel.axhline(row - 0.5, color=GREY, linewidth=0.5)
