"""Plotnikov Fig. 1, simulated from its description: heading error on a table of three angles."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import PAPER_LARGEST, STOPS, StaticCharacteristic

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


def _beside(lasting: FloatArray, i: int) -> FloatArray:
    """Both kinds of turns are drawn side by side."""
    step = lasting[1] - lasting[0] if len(lasting) > 1 else 1.0
    return lasting + (i - 0.5) * 0.2 * step


def columns(data: StaticCharacteristic) -> dict[str, Any]:
    """Columns of the figure's CSV: those of the turns, then those of drifts and offsets."""
    table: dict[str, Any] = {}
    for name, stops in _abscissas().items():
        table[f"{name}_deg"] = stops
        for i, run in enumerate(data.runs[name]):
            table[f"{name}, run {i + 1}, error_deg"] = np.degrees(run)
        table[f"{name}, mean, error_deg"] = np.degrees(data.runs[name].mean(axis=0))
        table[f"{name}, formula, error_deg"] = np.degrees(data.formula[name])
    for kind, (lasting, quantiles) in _deviations(data).items():
        table[f"lasting {kind}"] = lasting
        for i, turned in enumerate(TURNED):
            table[f"drawn at, {kind}, {turned}"] = _beside(lasting, i)
            for share, row in zip((0.1, 0.5, 0.9), quantiles[:, i], strict=True):
                table[f"largest error_deg of {share:.0%} of units, {kind}, {turned}"] = row
    table["paper_largest_error_deg"] = [PAPER_LARGEST]
    return table


@in_style
def draw(data: StaticCharacteristic, sheet: Sheet) -> Figure:
    """One unit on the table, and which drift or offset makes the paper's largest error."""
    figure, panels = sheet.mosaic(
        "ab;cd", (10.5, 7.2), (0.07, 0.13, 0.985, 0.95), spaces=(0.17, 0.36), page_height=5.6,
        column_height=8.6,
    )  # fmt: skip
    heading, others, drift, offset = panels.values()
    dot = 0.6 if sheet.on_paper else 1.0
    lasting = f"{data.lasting[data.shown]:g} deg/h"
    if sheet.on_paper:
        heading.set_title(f"one unit, lasting drift of {lasting}")
        others.set(title="the same unit, pitched or rolled")
    else:
        heading.set_title(f"one unit, lasting drift drawn with {lasting}")
        others.set(title="the same unit, pitched or rolled, bow to the North")
    heading.set(xlabel="heading, degrees", ylabel="heading error, degrees", xlim=(0, 360))
    others.set(xlabel="pitch from −60, or roll from 0, degrees", xlim=(-60, 360))
    if sheet.narrow:
        others.set_ylabel("heading error, degrees")
    stops = _abscissas()
    for i, run in enumerate(data.runs["heading"]):
        heading.plot(stops["heading"], np.degrees(run), linestyle="none", marker="os^"[i],
                     markersize=4 * dot, color=SERIES[i]["color"],
                     label=f"run {i + 1}")  # fmt: skip
    heading.plot(stops["heading"], np.degrees(data.runs["heading"].mean(axis=0)), color=BLACK,
                 label="mean")  # fmt: skip
    heading.plot(stops["heading"], np.degrees(data.formula["heading"]), **SERIES[3],
                 label="formula, lasting part")  # fmt: skip
    for name, style in (("pitch", SERIES[0]), ("roll", SERIES[2])):
        mean = np.degrees(data.runs[name].mean(axis=0))
        others.plot(stops[name], mean, color=style["color"], label=f"{name}, mean of 3 runs")
        others.plot(stops[name], np.degrees(data.formula[name]), **SERIES[3],
                    label="formula, lasting part" if name == "roll" else None)  # fmt: skip
    drawn = np.degrees([np.append(data.runs[name], data.formula[name]) for name in stops])
    # Room for the legends, which are wider in a column than half of it.
    room = 2.1 if sheet.narrow else 1.5
    low, high = min(-0.6, 1.1 * drawn.min()), max(0.9, room * drawn.max())
    for panel in (heading, others):
        panel.set(ylim=(low, high))
        panel.set_xticks(range(-60 if panel is others else 0, 361, 60))
        panel.legend(loc="upper left", ncols=2, fontsize="small" if sheet.on_paper else None)
    units = data.by_drift.shape[-1]
    top = 1.9
    for panel, (kind, rows) in zip((drift, offset), _deviations(data).items(), strict=True):
        top = max(top, 1.4 * rows[1][1].max())
        words = f"largest error of the mean of 3 runs, {units} units"
        if sheet.on_paper:
            panel.set_title(words, fontsize="medium")
        else:
            panel.set_title(f"{words} each", fontsize=9)
        panel.set(xlabel=f"deviation of the lasting {kind}", ylabel="degrees")
        _draw_largest(panel, *rows, dot)
    for panel in (drift, offset):
        panel.set_ylim(0, top)
    legend_below_all(figure, sheet, drift, 2 if sheet.on_paper else 3, 1)
    return figure


def _draw_largest(panel: Axes, lasting: FloatArray, quantiles: FloatArray, dot: float) -> None:
    """Medians, and bars from 10 to 90 % of the units, for both kinds of turns."""
    for i, turned in enumerate(TURNED):
        low, middle, high = quantiles[:, i]
        panel.errorbar(_beside(lasting, i), middle, [middle - low, high - middle],
                       color=SERIES[2 * i]["color"], marker="os"[i], linestyle="none",
                       capsize=3 * dot, markersize=4 * dot,
                       label=f"{turned}: median, 10 to 90 %")  # fmt: skip
    panel.axhline(PAPER_LARGEST, **SERIES[1], label=f"paper: {PAPER_LARGEST:g}°")
