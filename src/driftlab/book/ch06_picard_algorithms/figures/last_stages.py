"""Last stages of an algorithm side by side: on cones, about a fixed axis, and their cost."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.constants import arcsecond

from driftlab.book.machinery.picture import GREY, GUIDE, SERIES, in_style, legend_below_all
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


QUANTILES = (0.1, 0.5, 0.9)
"""Of the errors on random motions, over those of the rotation vector."""


def columns(data: LastStageErrors) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV, those of the lower panels by stage."""
    table: dict[str, FloatArray | list[str]] = {"half_angle_deg": np.degrees(data.half_angles)}
    for stage, drift in zip(COMPARED_STAGES, data.drifts, strict=True):
        table[f"drift_arcsec, {LABELS[stage]}"] = np.abs(drift) / arcsecond
    table["step_rad"] = data.step_angles
    for stage, error in zip(COMPARED_STAGES, data.fixed_axis, strict=True):
        table[f"error_arcsec, {LABELS[stage]}"] = _beyond_rounding(error)
    for stage, stretched in zip(COMPARED_STAGES, data.stretched, strict=True):
        table[f"length_less_one, {LABELS[stage]}"] = stretched
    table["stage"] = list(LABELS.values())
    for kind, rows in _ratios(data).items():
        for part, row in zip(QUANTILES, rows, strict=True):
            table[f"ratio, {kind}, {100 * part:g} %"] = row
    return table | {"operations": np.array(data.costs, dtype=float)}


def _beyond_rounding(error: FloatArray) -> FloatArray:
    """Size of an error in arc seconds; NaN where it is rounding."""
    size = np.abs(error)
    return np.where(size > 1e-12, size / arcsecond, np.nan)


def _ratios(data: LastStageErrors) -> dict[str, FloatArray]:
    """Quantiles (quantile, stage) of the errors on random motions over the last stage's."""
    return {
        kind: np.quantile(errors[:-1] / errors[-1], QUANTILES, axis=-1)
        for kind, errors in zip(RANDOM_KINDS, data.random, strict=True)
    }


@in_style
def draw(data: LastStageErrors, sheet: Sheet) -> Figure:
    """Draw drift over half angle, error over step angle, random motions, and the cost."""
    figure, panels = sheet.mosaic(
        "ab;cd", (10.5, 7.2), (0.15, 0.16, 0.985, 0.96), spaces=(0.2, 0.33), column_height=9.0,
        page_height=5.6, column_heights=(1, 1, 1.2, 0.9),
    )  # fmt: skip
    _draw_curves(panels["a"], panels["b"], data)
    kinds = _draw_ratios(panels["c"], data, sheet)
    _draw_costs(panels["d"], data)
    handles, _ = panels["a"].get_legend_handles_labels()
    most = 4 if sheet.on_paper else 5
    legend_below_all(figure, sheet, [*handles, *kinds], most, points=8)
    return figure


def _draw_curves(cones: Axes, fixed: Axes, data: LastStageErrors) -> None:
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
        fixed.plot(
            data.step_angles, _beyond_rounding(data.fixed_axis[i]), **style, label=LABELS[stage]
        )


def _draw_ratios(panel: Axes, data: LastStageErrors, sheet: Sheet) -> list[Line2D]:
    """Draw them, and return what stands for the kinds of motion in the legend."""
    panel.set(title=f"{data.random.shape[-1]} random motions of each kind", xscale="log")
    words = "error over that of sine and cosine: median, 10 to 90 %"
    panel.set_xlabel(words.replace(": ", ":\n") if sheet.narrow else words)
    ratios = _ratios(data)
    every = np.stack(list(ratios.values()))
    panel.set_xlim(min(0.3, every.min() / 1.2), max(300.0, 1.2 * every.max()))
    marks = ("0.3", "1", "3", "10", "30", "100", "300", "1000")
    panel.set_xticks([float(mark) for mark in marks], marks)
    panel.minorticks_off()
    panel.axvline(1, color=GREY, label=GUIDE)
    others = COMPARED_STAGES[:-1]
    colours = [STYLES[stage]["color"] for stage in others]
    handles: list[Line2D] = []
    for j, (mark, (kind, (low, middle, high))) in enumerate(
        zip("oDs", ratios.items(), strict=True)
    ):
        places = np.arange(len(others)) + 0.25 * (j - 1)
        panel.hlines(places, low, high, colors=colours, zorder=2, label=f"{kind}, 10 to 90 %")
        panel.scatter(middle, places, (16 if sheet.on_paper else 36), marker=mark, zorder=2.5,
                      facecolors="white", edgecolors=colours, label=f"{kind}, median")  # fmt: skip
        handles += panel.plot([], [], mark, color=GREY, markerfacecolor="white", label=kind)
    panel.set_yticks(range(len(others)), [LABELS[stage] for stage in others], fontsize="small")
    panel.invert_yaxis()
    return handles


def _draw_costs(panel: Axes, data: LastStageErrors) -> None:
    panel.set(title="operations of a step", xlim=(0, 1.13 * max(data.costs)))
    colours = [STYLES[stage]["color"] for stage in COMPARED_STAGES]
    bars = panel.barh(range(len(COMPARED_STAGES)), data.costs, color=colours)
    panel.bar_label(bars, padding=3)
    # The rows are those of the names beside them.
    panel.set_yticks(range(len(COMPARED_STAGES)), [LABELS[stage] for stage in COMPARED_STAGES])
    panel.tick_params(axis="y", left=False, labelleft=False)
    panel.grid(visible=False, axis="y")
    panel.invert_yaxis()
