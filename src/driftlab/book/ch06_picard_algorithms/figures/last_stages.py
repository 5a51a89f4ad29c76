"""Last stages of an algorithm side by side: on cones, about a fixed axis, and their cost."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond

from driftlab.book.machinery.picture import GREY, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import COMPARED_STAGES, RANDOM_KINDS, LastStageErrors

STYLES = dict(zip(COMPARED_STAGES, (SERIES[i] for i in (1, 0, 3, 2, 6, 5, 4)), strict=True))
MARKERS = dict(zip(COMPARED_STAGES, "sovD^Px", strict=True))
LABELS = {
    "third iterate": "cubic term of γ",
    "tangent": "tangent, of γ + c",
    "tangent, dimension 3": "tangent, dimension 3",
    "series": "series of sine, cosine",
    "series, normalised": "the same, normalised",
    "sine series and root": "series of sine, root",
    "rotation vector": "sine and cosine",
}


def columns(data: LastStageErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {}
    for i, stage in enumerate(COMPARED_STAGES):
        curves[f"{stage}: drift a round in rad over half angle in rad"] = (
            data.half_angles,
            data.drifts[i],
        )
        name = f"{stage}: error about a fixed axis in rad over step in rad"
        curves[name] = (data.step_angles, data.fixed_axis[i])
        curves[f"{stage}: length less one over step in rad"] = (
            data.step_angles,
            data.stretched[i],
        )
    motions = np.arange(1.0, data.random.shape[-1] + 1)
    for kind, errors in zip(RANDOM_KINDS, data.random, strict=True):
        for stage, row in zip(COMPARED_STAGES, errors, strict=True):
            curves[f"{stage}: {kind}, error in rad over number"] = (motions, row)
    places = np.arange(1.0, len(COMPARED_STAGES) + 1)
    curves["operations over place in the list"] = (places, np.array(data.costs, dtype=float))
    return long_table(curves)


@in_style
def draw(data: LastStageErrors, sheet: Sheet) -> Figure:
    """Draw drift over half angle, error over step angle, and the cost."""
    figure = Figure(figsize=(10.5, 7.2))
    (cones, fixed), (ratios, cost) = figure.subplots(2, 2)
    figure.subplots_adjust(0.15, 0.16, 0.985, 0.96, wspace=0.2, hspace=0.33)
    cones.set(title=f"cone, {data.samples_a_round} samples a round", xlabel="half angle, degrees")
    cones.set(xscale="log", yscale="log", ylabel="drift in one round, arc seconds")
    cones.set_xticks([1, 2, 5, 10, 20, 45, 90], ["1", "2", "5", "10", "20", "45", "90"])
    fixed.set(title="fixed axis", xlabel="angle of a step, rad", xscale="log", yscale="log")
    fixed.set(ylabel="error of a step, arc seconds", ylim=(1e-7, 1e4))
    for panel in (cones, fixed):
        panel.minorticks_off()
    for i, stage in enumerate(COMPARED_STAGES):
        style = STYLES[stage] | {"marker": MARKERS[stage], "markersize": 4, "markevery": (i % 3, 3)}
        drift = np.abs(data.drifts[i]) / arcsecond
        cones.plot(np.degrees(data.half_angles), drift, **style, label=LABELS[stage])
        error = np.abs(data.fixed_axis[i])
        shown = np.where(error > 1e-12, error / arcsecond, np.nan)
        fixed.plot(data.step_angles, shown, **style)
    ratios.set(title=f"{data.random.shape[-1]} random motions of each kind", xscale="log")
    ratios.set(xlabel="error over that of sine and cosine: median, 10 to 90 %", xlim=(0.3, 300))
    ratios.set_xticks([0.3, 1, 3, 10, 30, 100, 300], ["0.3", "1", "3", "10", "30", "100", "300"])
    ratios.minorticks_off()
    ratios.axvline(1, color=GREY)
    others = COMPARED_STAGES[:-1]
    for j, errors in enumerate(data.random):
        low, middle, high = np.quantile(errors[:-1] / errors[-1], [0.1, 0.5, 0.9], axis=-1)
        for i, stage in enumerate(others):
            place = i + 0.25 * (j - 1)
            colour = STYLES[stage]["color"]
            ratios.plot([low[i], high[i]], [place, place], color=colour)
            ratios.plot(middle[i], place, "oDs"[j], color=colour, markerfacecolor="white")
    ratios.set_yticks(range(len(others)), [LABELS[stage] for stage in others], fontsize=8)
    ratios.invert_yaxis()
    for mark, kind in zip("oDs", RANDOM_KINDS, strict=True):
        ratios.plot([], [], mark, color=GREY, markerfacecolor="white", label=kind)
    ratios.legend(loc="upper right", fontsize=8)
    cost.set(title="operations of a step", xlim=(0, 52))
    colours = [STYLES[stage]["color"] for stage in COMPARED_STAGES]
    bars = cost.barh(range(len(COMPARED_STAGES)), data.costs, color=colours)
    cost.bar_label(bars, padding=3)
    cost.set_yticks([])
    cost.invert_yaxis()
    figure.legend(*cones.get_legend_handles_labels(), loc="lower center", ncols=4, fontsize=8)
    return figure
