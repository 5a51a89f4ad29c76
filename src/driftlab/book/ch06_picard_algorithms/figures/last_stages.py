"""Last stages of an algorithm side by side: on cones, about a fixed axis, and their cost."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from driftlab.book.machinery.figure.drawing import Drawing, Rows, from_table
from driftlab.book.machinery.figure.picture import GREY, GUIDE, SERIES, legend_below_all

from ..experiments import RANDOM_KINDS, STAGE_LABELS

STYLES: dict[str, dict[str, Any]] = dict(
    zip(STAGE_LABELS.values(), (SERIES[i] for i in (1, 0, 3, 2, 6, 5, 4)), strict=True)
)
COLOURS = [style["color"] for style in STYLES.values()]
MARKERS = "sovD^Px"


@from_table
def draw(drawing: Drawing) -> None:
    """Draw drift over half angle, error over step angle, random motions, and the cost."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "ab;cd", (10.5, 7.2), (0.15, 0.16, 0.985, 0.96), spaces=(0.2, 0.33), column_height=9.0,
        page_height=5.6, column_heights=(1, 1, 1.2, 0.9),
    )  # fmt: skip
    _draw_curves(panels["a"], panels["b"], drawing)
    kinds = _draw_ratios(panels["c"], drawing)
    _draw_costs(panels["d"], drawing)
    handles, _ = panels["a"].get_legend_handles_labels()
    most = 4 if sheet.on_paper else 5
    legend_below_all(drawing.figure, sheet, [*handles, *kinds], most, points=8)


def _draw_curves(cones: Axes, fixed: Axes, drawing: Drawing) -> None:
    cones.set(title=f"cone, {drawing.table.samples_a_round} samples a round")
    cones.set(xlabel="half angle, degrees", ylabel="drift in one round, arc seconds")
    cones.set(xscale="log", yscale="log")
    cones.set_xticks([1, 2, 5, 10, 20, 45, 90], ["1", "2", "5", "10", "20", "45", "90"])
    fixed.set(title="fixed axis", xlabel="angle of a step, rad", xscale="log", yscale="log")
    fixed.set(ylabel="error of a step, arc seconds", ylim=(1e-7, 1e4))
    for panel in (cones, fixed):
        panel.minorticks_off()
    for i, ((label, style), marker) in enumerate(zip(STYLES.items(), MARKERS, strict=True)):
        look = style | {"marker": marker, "markersize": 4, "markevery": (i % 3, 3)}
        drawing.curve(cones, "half_angle", f"drift, {label}", **look, label=label)
        drawing.curve(fixed, "step", f"error, {label}", **look, label=label)


def _draw_ratios(panel: Axes, drawing: Drawing) -> list[Line2D]:
    """Draw them, and return what stands for the kinds of motion in the legend."""
    table, sheet = drawing.table, drawing.sheet
    panel.set(title=f"{table.motions} random motions of each kind", xscale="log")
    words = "error over that of sine and cosine: median, 10 to 90 %"
    panel.set_xlabel(words.replace(": ", ":\n") if sheet.narrow else words)
    panel.set_xlim(min(0.3, table.ratio.min() / 1.2), max(300.0, 1.2 * table.ratio.max()))
    marks = ("0.3", "1", "3", "10", "30", "100", "300", "1000")
    panel.set_xticks([float(mark) for mark in marks], marks)
    panel.minorticks_off()
    panel.axvline(1, color=GREY, label=GUIDE)
    others, colours = [*STYLES][:-1], COLOURS[:-1]
    handles: list[Line2D] = []
    for j, (mark, kind) in enumerate(zip("oDs", RANDOM_KINDS, strict=True)):
        places = [i + 0.25 * (j - 1) for i in range(len(others))]
        low, middle, high = (f"ratio, {kind}, {part} %" for part in (10, 50, 90))
        bars = panel.hlines(places, table.shown(low), table.shown(high), colors=colours, zorder=2,
                            label=f"{kind}, 10 to 90 %")  # fmt: skip
        drawing.record(panel, bars, [Rows(low, places), Rows(high, places)])
        drawing.curve(
            panel, middle, places, method="scatter", s=16 if sheet.on_paper else 36, marker=mark,
            zorder=2.5, facecolors="white", edgecolors=colours, label=f"{kind}, median",
        )  # fmt: skip
        handles += panel.plot([], [], mark, color=GREY, markerfacecolor="white", label=kind)
    panel.set_yticks(range(len(others)), others, fontsize="small")
    panel.invert_yaxis()
    return handles


def _draw_costs(panel: Axes, drawing: Drawing) -> None:
    panel.set(title="operations of a step", xlim=(0, 1.13 * max(drawing.table.operations)))
    places = range(len(STYLES))
    bars = drawing.bar_chart(panel, places, "operations", across=True, color=COLOURS)
    panel.bar_label(bars, padding=3)
    # The rows are those of the names beside them.
    panel.set_yticks(places, [*STYLES])
    panel.tick_params(axis="y", left=False, labelleft=False)
    panel.grid(visible=False, axis="y")
    panel.invert_yaxis()
