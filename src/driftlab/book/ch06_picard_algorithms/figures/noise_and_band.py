"""Band width against sample rate, and the floors of rounding and noise under the drift."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.constants import degree, hour

from driftlab.book.machinery.picture import (
    BLACK,
    GREY,
    GUIDE,
    ORANGE,
    in_style,
    legend_below_all,
)
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import NoiseAndBand
from .algorithm_laboratory import STYLES

DEGREE_PER_HOUR = degree / hour
LABELS = {
    "picard-1": "picard-1",
    "two-step-4": "two samples",
    "rotation-vector-3": "three samples",
    "four, spread": "four samples",
}
DASHES = ("-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)))
LINES: dict[str, dict[str, Any]] = {
    name: {"color": STYLES[name]["color"] if name in STYLES else BLACK, "linestyle": dashes}
    for name, dashes in zip(LABELS, DASHES, strict=True)
}
"""Colours as in the other figures; dashes that differ where the curves lie close together."""


DECADES = (-5, 3.5)
"""Least reach of the axis of the drift: powers of ten, deg/h."""


def columns(data: NoiseAndBand) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, errors as the drift that would make them."""
    table = {"samples_a_round": data.samples}
    for name, label in LABELS.items():
        table[f"part_missed, {label}"] = data.missed[name]
        table[f"first_term, {label}"] = data.first_terms[name]
    unit = DEGREE_PER_HOUR * data.seconds
    table |= {
        "rate_hz": data.rates,
        "rounding_lost_deg_per_h": data.cut_off / unit,
        "rounding_carried_deg_per_h": data.carried / unit,
        "curve_rate_hz": data.fine_rates,
        "rounding_carried_expected_deg_per_h": data.expected / unit,
        "white_noise_deg_per_h": np.full(len(data.fine_rates), data.white / unit),
    }
    return table | {
        f"drift_deg_per_h, {label}": data.fine_drifted[name] / unit
        for name, label in LABELS.items()
    }


@in_style
def draw(data: NoiseAndBand, sheet: Sheet) -> Figure:
    """Draw what is missed of the coning, and the drift on the cone with its floors."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.8), (0.075, 0.2, 0.985, 0.92), spaces=(0.22, 0.2), column_height=6.2,
        page_height=3.7,
    )  # fmt: skip
    band, floors = panels["a"], panels["b"]
    _draw_band(band, data)
    marks = _draw_floors(floors, data)
    handles = [band.plot([], [], **LINES[name], label=label)[0] for name, label in LABELS.items()]
    where = "above" if sheet.narrow else "left"
    words = f"first term of the series ({where})"
    handles += band.plot([], [], color=GREY, linewidth=0.7, label=words)
    if sheet.narrow:
        handles += marks
    else:
        floors.legend(handles=marks, loc="lower left", fontsize="small")
    legend_below_all(figure, sheet, handles, ncols=5, points=8)
    return figure


def _draw_band(panel: Axes, data: NoiseAndBand) -> None:
    panel.set(title="any narrow cone", xlabel="samples in a round", xscale="log", yscale="log")
    panel.set(ylabel="part of the coning that is missed", xlim=(1, 100), ylim=(1e-9, 30))
    panel.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    panel.minorticks_off()
    panel.axvspan(1, 2, color=GREY, alpha=0.2, linewidth=0, label=GUIDE)
    panel.text(1.05, 3e-9, "aliased", color=BLACK, fontsize="small")
    for name, label in LABELS.items():
        line = LINES[name]
        panel.plot(data.samples, data.missed[name], **line, label=label)
        panel.plot(data.samples, data.first_terms[name], color=line["color"], linewidth=0.7,
                   label=f"{label}, first term")  # fmt: skip


def _draw_floors(panel: Axes, data: NoiseAndBand) -> list[Line2D]:
    """Draw them, and return the rows of their legend."""
    half_angle, frequency = np.degrees(data.cone.half_angle), data.cone.frequency
    panel.set(title=f"cone of {half_angle:g}° at {frequency:g} Hz, in {data.seconds:g} s")
    panel.set(xlabel="sample rate, Hz", ylabel="apparent drift, deg/h", xscale="log", yscale="log")
    first, last = data.fine_rates[[0, -1]]
    panel.set(xlim=(first, last))
    panel.set_xticks([20, 50, 100, 200, 400], ["20", "50", "100", "200", "400"])
    panel.minorticks_off()
    rates, unit = data.fine_rates, DEGREE_PER_HOUR * data.seconds
    for name, label in LABELS.items():
        panel.plot(rates, data.fine_drifted[name] / unit, **LINES[name], label=label)
    lost, carried = data.cut_off / unit, data.carried / unit
    marks = [
        *panel.plot(data.rates, lost, "x", color=GREY, label="rounding, remainder lost"),
        *panel.plot(data.rates, carried, "o", color=ORANGE, label="remainder carried"),
        *panel.plot(rates, data.expected / unit, color=ORANGE, linewidth=0.8,
                    label="the same, expected"),
        *panel.plot(rates, np.full(len(rates), data.white / unit), color=GREY, linestyle=":",
                    linewidth=2, label="white noise, one sigma"),
    ]  # fmt: skip
    floors = np.log10([lost.max(), carried.min(), carried.max(), data.white / unit])
    low, high = min(DECADES[0], floors.min() - 2), max(DECADES[1], floors.max() + 1)
    panel.set_ylim(10.0**low, 10.0**high)
    return marks
