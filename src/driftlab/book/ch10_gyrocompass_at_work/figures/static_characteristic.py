"""Plotnikov Fig. 1, simulated from its description: heading error on a table of three angles."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import PAPER_LARGEST, SHOWN, STOPS, StaticCharacteristic

TURNED = ("turns in heading", "turns in heading, pitch and roll")


def _abscissas() -> dict[str, FloatArray]:
    """Stops of the angle that turns, degrees."""
    return {name: np.degrees(angles[i]).round(6) for i, (name, angles) in enumerate(STOPS.items())}


def _deviations(data: StaticCharacteristic) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Deviations of what lasts (m,), and quantiles (3, 2, m) of the largest errors, degrees."""
    kinds = {"drift in deg/h": (data.lasting, data.by_drift),
             "offset in mg": (data.offsets, data.by_offset)}  # fmt: skip
    return {
        name: (lasting, np.degrees(np.quantile(largest, [0.1, 0.5, 0.9], axis=-1)))
        for name, (lasting, largest) in kinds.items()
    }


def columns(data: StaticCharacteristic) -> dict[str, Any]:
    """Columns of the figure's CSV."""
    curves = {}
    for name, stops in _abscissas().items():
        for i, run in enumerate(data.runs[name]):
            curves[f"run {i + 1}, degrees over {name}"] = stops, np.degrees(run).round(7)
        mean = data.runs[name].mean(axis=0)
        curves[f"mean, degrees over {name}"] = stops, np.degrees(mean).round(7)
        curves[f"formula, degrees over {name}"] = stops, np.degrees(data.formula[name]).round(7)
    for kind, (lasting, quantiles) in _deviations(data).items():
        for share, rows in zip((0.1, 0.5, 0.9), quantiles, strict=True):
            for turned, row in zip(TURNED, rows, strict=True):
                name = f"largest error, {share:.0%} of units, {turned}, degrees over lasting {kind}"
                curves[name] = lasting, row.round(7)
    return long_table(curves)


@in_style
def draw(data: StaticCharacteristic, sheet: Sheet) -> Figure:
    """One unit on the table, and which drift or offset makes the paper's largest error."""
    figure = Figure(figsize=(10.5, 7.2))
    (heading, others), (drift, offset) = figure.subplots(2, 2)
    figure.subplots_adjust(0.07, 0.13, 0.985, 0.95, wspace=0.17, hspace=0.36)
    heading.set_title(f"one unit, lasting drift drawn with {data.lasting[SHOWN]:g} deg/h")
    heading.set(xlabel="heading, degrees", ylabel="heading error, degrees", xlim=(0, 360))
    others.set(title="the same unit, pitched or rolled, bow to the North")
    others.set(xlabel="pitch from −60, or roll from 0, degrees", xlim=(-60, 360))
    stops = _abscissas()
    for i, run in enumerate(data.runs["heading"]):
        heading.plot(stops["heading"], np.degrees(run), linestyle="none", marker="os^"[i],
                     markersize=4, color=SERIES[i]["color"], label=f"run {i + 1}")  # fmt: skip
    heading.plot(stops["heading"], np.degrees(data.runs["heading"].mean(axis=0)), color=BLACK,
                 label="mean")  # fmt: skip
    heading.plot(stops["heading"], np.degrees(data.formula["heading"]), **SERIES[3],
                 label="formula, lasting part")  # fmt: skip
    for name, style in (("pitch", SERIES[0]), ("roll", SERIES[2])):
        mean = np.degrees(data.runs[name].mean(axis=0))
        others.plot(stops[name], mean, color=style["color"], label=f"{name}, mean of 3 runs")
        others.plot(stops[name], np.degrees(data.formula[name]), **SERIES[3],
                    label="formula, lasting part" if name == "roll" else None)  # fmt: skip
    for panel in (heading, others):
        panel.set(ylim=(-0.6, 0.9))
        panel.set_xticks(range(-60 if panel is others else 0, 361, 60))
        panel.legend(loc="upper left", ncols=2)
    units = data.by_drift.shape[-1]
    for panel, (kind, rows) in zip((drift, offset), _deviations(data).items(), strict=True):
        panel.set_title(f"largest error of the mean of 3 runs, {units} units each", fontsize=9)
        panel.set(xlabel=f"deviation of the lasting {kind}", ylabel="degrees", ylim=(0, 1.9))
        _draw_largest(panel, *rows)
    handles, labels = drift.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=3)
    return figure


def _draw_largest(panel: Axes, lasting: FloatArray, quantiles: FloatArray) -> None:
    """Medians, and bars from 10 to 90 % of the units, for both kinds of turns."""
    step = lasting[1] - lasting[0]
    for i, turned in enumerate(TURNED):
        low, middle, high = quantiles[:, i]
        panel.errorbar(lasting + (i - 0.5) * 0.2 * step, middle, [middle - low, high - middle],
                       color=SERIES[2 * i]["color"], marker="os"[i], linestyle="none", capsize=3,
                       markersize=4, label=f"{turned}: median, 10 to 90 %")  # fmt: skip
    panel.axhline(PAPER_LARGEST, **SERIES[1], label=f"paper: {PAPER_LARGEST:g}°")
