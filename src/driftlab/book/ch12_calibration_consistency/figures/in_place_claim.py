"""Does the averaged choice of axes deviate less? The claim after Wu Figs. 3-5, over many units."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from driftlab.book.ch11_kalman_calibration.experiments import ALL_STARTS
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, GUIDE, SERIES, legend_below_all
from driftlab.book.machinery.figure.sheet import Sheet
from driftlab.motion.scheme import SCHEMES

from ..experiments import QUANTITIES, TRIANGLES, Comparison, comparisons

WIDE = (0.3, [0.3, 0.5, 1, 2, 3], 3.3)
NARROW = (0.95, [0.96, 0.98, 1.0, 1.02, 1.04], 1.05)
"""Limits and ticks of the ratios; narrow ones where half of them lie within."""


def caption(table: DataTable) -> str:
    """Say how many comparisons are certain, and for whom."""
    verdicts = comparisons(table)
    units = next(iter(verdicts.values())).units
    said = []
    for start in ALL_STARTS:
        these = [each for key, each in verdicts.items() if key.start == start]
        sure = [each for each in these if each.chance < table.certain]
        wins = sum(each.better > units / 2 for each in sure)
        said.append(f"from {start} {wins} and {len(sure) - wins}")
    sizes = " or ".join(f"{size:g}″" for size in table.sizes)
    return (
        f"Random units, {units} bent by {sizes} each, calibrated in averaged axes and in two "
        "triangles on the same data, on the nineteen positions and on eighteen rotations, then at "
        f"rest for {table.shown('at_rest_for')[0]:g} hours; the two computers begin from four "
        "starts. "
        "Above: root mean square error with averaged axes over that with the upper triangle, on "
        "the nineteen positions; the scales differ. Below: part of the units in which averaged "
        f"axes err less, with 95 % intervals, in all {len(verdicts)} comparisons. Certain "
        f"(each below 0.05/{len(verdicts)}) are, in the "
        f"{len(verdicts) // len(ALL_STARTS)} comparisons for each start, these gains "
        f"and losses of averaged axes: {', '.join(said)}."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw a column for each start: distributions of the ratio in one case, counts in all.

    On a narrow sheet the starts stand one below the other.
    """
    table, sheet = drawing.table, drawing.sheet
    rows, starts = len(table.sizes) + 1, len(ALL_STARTS)
    letters = np.array([chr(ord("a") + i) for i in range(rows * starts)]).reshape(rows, starts)
    heights = [1.0] * (rows - 1) + [1.75]
    wide, *halves = (
        ";".join("".join(row) for row in part)
        for part in (letters, letters[:, : starts // 2], letters[:, starts // 2 :])
    )
    panels = drawing.mosaic(
        wide, (10.5, 9.0), (0.085, 0.115, 0.985, 0.965), column=";".join(halves),
        page_height=7.4, column_height=9.4, spaces=(0.13, 0.37),
        height_ratios=heights, column_heights=2 * heights,
    )  # fmt: skip
    first = {0, starts // 2} if sheet.narrow else {0}
    for row, size in zip(letters, table.sizes, strict=False):
        for i, start in enumerate(ALL_STARTS):
            panel = panels[row[i]]
            _draw_ratios(drawing, panel, size, start)
            panel.tick_params(labelleft=i in first)
            if i in first:
                panel.set_ylabel("part below" if sheet.narrow else "part of the units below")
    for i, start in enumerate(ALL_STARTS):
        panel = panels[letters[-1, i]]
        _draw_counts(drawing, panel, start)
        panel.set_yticks(range(len(QUANTITIES)), QUANTITIES if i in first else [])
    _label(drawing, panels, letters)


def _label(drawing: Drawing, panels: Mapping[str, Axes], letters: NDArray[np.str_]) -> None:
    """Words below the panels, and the legends."""
    figure, sheet = drawing.figure, drawing.sheet
    small = "small" if sheet.on_paper else 8
    last = panels[letters[-1, 0]]
    panels["a"].legend(loc="lower right", fontsize=small)
    if sheet.on_paper:
        for above, below in letters[-2:].T:
            panels[above].set_xlabel(f"averaged / {TRIANGLES[0]}")
            panels[below].set_xlabel("part that errs less")
        legend_below_all(figure, sheet, last, fontsize=small,
                         title="schemes, triangles, installation errors", title_fontsize=small,
                         handlelength=1.2, columnspacing=1.2)  # fmt: skip
        return
    for height, words in (
        (0.465, f"error with averaged axes / with {TRIANGLES[0]}, {next(iter(SCHEMES))}"),
        (0.072, "part of the units with less error in averaged axes"),
    ):
        figure.text(0.535, height, words, ha="center", fontsize=10)
    legend_below_all(figure, sheet, last, fontsize=small)


def _say(panel: Axes, size: str, start: str, sheet: Sheet) -> None:
    words = f"{size}, from {start}" if sheet.narrow else f"{size}, start from {start}"
    panel.set_title(words, fontsize="small" if sheet.on_paper else 9)


def _draw_ratios(drawing: Drawing, panel: Axes, size: float, start: str) -> None:
    """Distribution functions of the ratio, on the first scheme and against the first triangle."""
    sheet = drawing.sheet
    drawn = {
        quantity: str(Comparison(next(iter(SCHEMES)), size, TRIANGLES[0], start, quantity))
        for quantity in QUANTITIES
    }
    ratios = [drawing.table.ratio[words] for words in drawn.values()]
    # From the table's axes, and for units bent much, the ratios differ by more than per cents.
    spread = np.concatenate([np.quantile(each, [0.25, 0.75]) for each in ratios])
    typical = NARROW[0] < spread.min() and spread.max() < NARROW[2]
    low, ticks, high = NARROW if typical else WIDE
    panel.set(xscale="log", xlim=(low, high), ylim=(0, 1))
    _say(panel, f"{size:g}″", start, sheet)
    if sheet.narrow:
        ticks = ticks[:: 2 if typical else 1]
    panel.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    panel.minorticks_off()
    panel.axvline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
    panel.axhline(0.5, color=GREY, linewidth=0.8, label=GUIDE)
    for (quantity, words), style in zip(drawn.items(), SERIES, strict=False):
        drawing.distribution(panel, f"ratio, {words}", **style, label=quantity)


def _draw_counts(drawing: Drawing, panel: Axes, start: str) -> None:
    """Part of the units that err less with averaged axes, with 95 % intervals, in all cases."""
    table, sheet = drawing.table, drawing.sheet
    panel.set(ylim=(len(QUANTITIES) - 0.5, -0.5))
    _say(panel, "all", start, sheet)
    panel.axvline(0.5, color=BLACK, linewidth=0.8, label=GUIDE)
    cases = [(s, rival, size) for s in SCHEMES for rival in TRIANGLES for size in table.sizes]
    places = np.arange(len(QUANTITIES), dtype=np.float64)
    dot = 0.55 if sheet.on_paper else 1.0
    for k, (scheme, rival, size) in enumerate(cases):
        kind, bent = divmod(k, len(table.sizes))
        word = rival.removesuffix(" triangle") if sheet.on_paper else rival
        drawing.error_bars(
            panel, "part", places + 0.1 * (k - (len(cases) - 1) / 2),
            "part_low", "part_high", across=True,
            where={"case": f"{scheme}; {rival}; {size:g}″", "start": start},
            color=SERIES[kind]["color"], marker="os^D"[kind], markersize=4.5 * dot,
            elinewidth=1.5 * dot, linestyle="none", markerfacecolor=None if bent else "white",
            label=f"{scheme}, {word}, {size:g}″",
        )  # fmt: skip
    own = np.array(table.start) == start
    low, high = table.part_low[own].min() - 0.02, table.part_high[own].max() + 0.02
    panel.set_xlim(min(0.3, low), max(0.9, high))
    for row in range(1, len(QUANTITIES)):
        panel.axhline(row - 0.5, color=GREY, linewidth=0.5, label=GUIDE)
