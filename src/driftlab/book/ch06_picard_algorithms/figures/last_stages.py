"""Last stages of an algorithm side by side: on cones, about a fixed axis, and their cost."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond

from driftlab.book.machinery.picture import SERIES, in_style, long_table
from driftlab.checks import FloatArray

from ..experiments import COMPARED_STAGES, LastStageErrors

STYLES = dict(zip(COMPARED_STAGES, (SERIES[i] for i in (1, 0, 3, 2, 6, 4)), strict=True))
MARKERS = dict(zip(COMPARED_STAGES, "sovD^x", strict=True))
LABELS = {
    "third iterate": "cubic term of γ",
    "tangent": "tangent, of γ + c",
    "tangent, dimension 3": "tangent, dimension 3",
    "series": "series of sine, cosine",
    "series, normalised": "the same, normalised",
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
    places = np.arange(1.0, len(COMPARED_STAGES) + 1)
    curves["operations over place in the list"] = (places, np.array(data.costs, dtype=float))
    return long_table(curves)


@in_style
def draw(data: LastStageErrors) -> Figure:
    """Draw drift over half angle, error over step angle, and the cost."""
    figure = Figure(figsize=(10.5, 4.4))
    cones, fixed, cost = figure.subplots(1, 3, width_ratios=(1, 1, 0.8))
    figure.subplots_adjust(0.07, 0.23, 0.985, 0.92, wspace=0.28)
    cones.set(title=f"cone, {data.samples_a_round} samples a round", xlabel="half angle, degrees")
    cones.set(xscale="log", yscale="log", ylabel="drift in one round, arc seconds")
    cones.set_xticks([1, 2, 5, 10, 20, 45, 90], ["1", "2", "5", "10", "20", "45", "90"])
    fixed.set(title="fixed axis", xlabel="angle of a step, rad", xscale="log", yscale="log")
    fixed.set(ylabel="error of a step, arc seconds", ylim=(1e-7, 1e4))
    for panel in (cones, fixed):
        panel.minorticks_off()
    for i, stage in enumerate(COMPARED_STAGES):
        style = STYLES[stage] | {"marker": MARKERS[stage], "markersize": 4, "markevery": 3}
        drift = np.abs(data.drifts[i]) / arcsecond
        cones.plot(np.degrees(data.half_angles), drift, **style, label=LABELS[stage])
        error = np.abs(data.fixed_axis[i])
        shown = np.where(error > 1e-12, error / arcsecond, np.nan)
        fixed.plot(data.step_angles, shown, **style)
    cost.set(title="operations of a step", xlim=(0, 52))
    colours = [STYLES[stage]["color"] for stage in COMPARED_STAGES]
    bars = cost.barh(range(len(COMPARED_STAGES)), data.costs, color=colours)
    cost.bar_label(bars, padding=3)
    cost.set_yticks([])
    cost.invert_yaxis()
    figure.legend(*cones.get_legend_handles_labels(), loc="lower center", ncols=6, fontsize=8)
    return figure
