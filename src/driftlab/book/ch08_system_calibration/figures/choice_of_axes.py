"""Which choice of body axes leaves out least: means over many units, and unit by unit."""

import numpy as np
from matplotlib.axes import Axes

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GUIDE, SERIES, legend_below_all
from driftlab.motion.scheme import SCHEMES

from ..experiments import PASSES, compared


def caption(table: DataTable) -> str:
    """Say in how many units bent most averaged axes err less, and what a second pass does."""
    size = table.sizes[-1]
    counts = []
    for rival in BODY_FRAMES[1:]:
        first, second = (compared(table, scheme, size, rival) for scheme in SCHEMES)
        counts.append(f"{rival} {first.better} and {second.better}")
    twice = [
        mean
        for words, mean in zip(table.mean_of, table.mean, strict=True)
        if words.endswith(PASSES[2])
    ]
    return (
        f"{first.units // 2} random units in each case, {first.units} of those bent most; the "
        "same ones for each of five choices of body axes, on the nineteen positions and on "
        "eighteen rotations, commonly quoted as those of Camberlein, whom the paper cites (not "
        "confirmed), with short pauses. "
        "Left and middle: squared normalised errors, means with their standard errors. Right: how "
        "often averaged axes err less in a unit, with 95 % "
        f"intervals. After one pass over the record of units bent by {size:g}″ they err less than "
        f"{', '.join(counts)} times, on the first scheme and on the second. After a second pass, "
        "linearised about the first, all means lie between "
        f"{min(twice):.2f} and {max(twice):.2f} (hollow)."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw two panels of means, one for each scheme, and one of units."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "abc", (10.5, 4.6), (0.055, 0.26, 0.985, 0.92), spaces=(0.38, 0.2),
        column_height=7.6, page_height=3.6,
    )  # fmt: skip
    schemes, units = (panels["a"], panels["b"]), panels["c"]
    sizes = table.sizes
    dot = 0.6 if sheet.on_paper else 1.0
    highest, lowest = table.mean_high.max(), table.mean.min()
    for panel, scheme in zip(schemes, SCHEMES, strict=True):
        words = f"27 states, {scheme}" if sheet.on_paper else f"27 states at the end, {scheme}"
        panel.set(title=words, xscale="log", yscale="log")
        panel.set(xlabel="installation errors, arc seconds")
        panel.set(xlim=(0.825 * sizes[0], 1.4 * sizes[-1]))
        panel.set(ylim=(min(0.85, 0.9 * lowest), max(25.0, 1.2 * highest)))
        panel.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
        for frame, style, marker in zip(BODY_FRAMES, SERIES, "os^Dv", strict=False):
            bars = "drawn_at", "mean", "mean_low", "mean_high"
            once, twice = (
                {"axes": frame, "mean_of": f"{scheme}; {words}"} for words in PASSES.values()
            )
            drawing.error_bars(panel, *bars, where=once, **style, marker=marker,
                               markersize=4 * dot, label=frame)  # fmt: skip
            drawing.error_bars(
                panel, *bars, where=twice, color=style["color"], marker=marker, markersize=5 * dot,
                markerfacecolor="white", linestyle="none",
            )  # fmt: skip
        panel.set_xticks(sizes, [f"{size:g}" for size in sizes])
        ticks = [k for k in (1, 2, 5, 10, 20, 50, 100, 200, 500) if k <= max(20.0, highest)]
        panel.set_yticks(ticks, [f"{tick}" for tick in ticks])
        panel.minorticks_off()
    schemes[0].set_ylabel("mean over what it should be")
    if sheet.narrow:
        schemes[1].set_ylabel("mean over what it should be")
    _draw_units(drawing, units)
    handles, labels = schemes[0].get_legend_handles_labels()
    if sheet.on_paper:
        more, others = units.get_legend_handles_labels()
        legend_below_all(drawing.figure, sheet, [*handles, *more], labels=[*labels, *others],
                         fontsize="small")  # fmt: skip
    else:
        drawing.figure.legend(
            handles, labels, loc="lower left", ncols=3, fontsize=8, bbox_to_anchor=(0.09, 0.02)
        )


def _draw_units(drawing: Drawing, panel: Axes) -> None:
    """Part of the units in which averaged axes err less than each rival, with 95 % intervals."""
    table, on_paper = drawing.table, drawing.sheet.on_paper
    size = table.sizes[-1]
    panel.set(title=f"averaged axes err less, {size:g}″", xlabel="part of the units")
    panel.axvline(0.5, color=BLACK, linewidth=0.8, label=GUIDE)
    places = np.arange(len(BODY_FRAMES) - 1.0)
    cases = [f"{scheme}; {words}" for words in PASSES.values() for scheme in SCHEMES]
    for k, case in enumerate(cases):
        drawing.error_bars(
            panel, "part", places + 0.18 * (k - 1.5), "part_low", "part_high", across=True,
            where={"part_of": case}, color=SERIES[k % 2]["color"], marker="os"[k % 2],
            markersize=3 if on_paper else 5, linestyle="none",
            markerfacecolor="white" if k > 1 else None, label=case.replace(";", ","),
        )  # fmt: skip
    names = ["than upper\ntriangle", "than lower\ntriangle", "than accel-\nerometers",
             "than averaged\naccelerometers"]  # fmt: skip
    panel.set_yticks(places, names, fontsize="small" if on_paper else 8)
    reach = min(0.2, table.part_low.min() - 0.02), max(0.9, table.part_high.max() + 0.02)
    panel.set(xlim=reach, ylim=(len(places) - 0.4, -0.6))
    if not on_paper:
        panel.legend(loc="upper center", bbox_to_anchor=(0.35, -0.15), ncols=2, fontsize=8)
