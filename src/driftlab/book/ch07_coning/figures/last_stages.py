"""Last stages of an algorithm side by side: on cones, about a fixed axis, and their cost."""

from typing import Any

from matplotlib.axes import Axes

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES, legend_below_all

from ..experiments import STAGE_LABELS

STYLES: dict[str, dict[str, Any]] = dict(
    zip(STAGE_LABELS.values(), (SERIES[i] for i in (1, 0, 3, 2, 6, 5, 4)), strict=True)
)
COLOURS = [style["color"] for style in STYLES.values()]
MARKERS = "sovD^Px"


@from_table
def draw(drawing: Drawing) -> None:
    """Draw drift over half angle, error over step angle, a map of motions, and the cost."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "ab;dc", (10.5, 7.2), (0.15, 0.16, 0.985, 0.96), spaces=(0.2, 0.33), column_height=9.0,
        page_height=5.6, column_heights=(1, 1, 0.9, 1.2),
    )  # fmt: skip
    _draw_curves(panels["a"], panels["b"], drawing)
    _draw_map(panels["c"], drawing)
    _draw_costs(panels["d"], drawing)
    handles, _ = panels["a"].get_legend_handles_labels()
    most = 4 if sheet.on_paper else 5
    legend_below_all(drawing.figure, sheet, handles, most, points=8)


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


def _draw_map(panel: Axes, drawing: Drawing) -> None:
    """Draw where the tangent errs less than sine and cosine, and where it errs more."""
    panel.set(title="error, tangent over sine and cosine", yscale="log")
    panel.set(xlabel="turns of the body in a cycle of the vibration")
    panel.set_ylabel("amplitude of the vibration, rad")
    levels = (-2, -1, -0.5, -0.1, 0.1, 0.5, 1, 2)
    filled = drawing.contours(panel, "turns", "amplitude", "gain", levels=levels, cmap="PuOr_r")
    bar = drawing.figure.colorbar(filled, ax=panel, pad=0.02, ticks=(-2, -1, 0, 1, 2))
    bar.set_ticklabels(["¼", "½", "1", "2", "4"])
    panel.grid(visible=False)


def _draw_costs(panel: Axes, drawing: Drawing) -> None:
    panel.set(title="operations of a step", xlim=(0, 1.13 * max(drawing.table.operations)))
    places = range(len(STYLES))
    bars = drawing.bar_chart(panel, places, "operations", across=True, color=COLOURS)
    panel.bar_label(bars, padding=3)
    panel.set_yticks(places, [*STYLES], fontsize="small")
    panel.grid(visible=False, axis="y")
    panel.invert_yaxis()
