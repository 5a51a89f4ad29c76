"""Band width against sample rate, and the floors of rounding and noise under the drift."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree, hour
from scipy.special import factorial, factorial2

from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.machinery.picture import BLACK, GREY, ORANGE, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import (
    ANGLE_RANDOM_WALK,
    BRACKET,
    COMPARED,
    FLOOR_RATES,
    FLOOR_SECONDS,
    QUANTUM,
    SAMPLES_A_ROUND,
    NoiseAndBand,
    carried_floor,
)
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


def columns(data: NoiseAndBand) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {}
    for name in LABELS:
        curves[f"{name}: part missed over samples a round"] = (SAMPLES_A_ROUND, data.missed[name])
        curves[f"{name}: error in rad over sample rate in Hz"] = (FLOOR_RATES, data.drifted[name])
    curves["rounding lost: error in rad over sample rate in Hz"] = (FLOOR_RATES, data.cut_off)
    curves["rounding carried: error in rad over sample rate in Hz"] = (FLOOR_RATES, data.carried)
    return long_table(curves)


@in_style
def draw(data: NoiseAndBand, sheet: Sheet) -> Figure:
    """Draw what is missed of the coning, and the drift on the bracket with its floors."""
    figure = Figure(figsize=(10.5, 4.8))
    band, floors = figure.subplots(1, 2)
    figure.subplots_adjust(0.075, 0.2, 0.985, 0.92, wspace=0.22)
    _draw_band(band, data)
    _draw_floors(floors, data)
    handles = [
        *(band.plot([], [], **LINES[name])[0] for name in LABELS),
        band.plot([], [], color=GREY, linewidth=0.7)[0],
    ]
    names = (*LABELS.values(), "first term of the series (left)")
    figure.legend(handles, names, loc="lower center", ncols=len(names), fontsize=8)
    return figure


def _draw_band(panel: Axes, data: NoiseAndBand) -> None:
    panel.set(title="any narrow cone", xlabel="samples in a round", xscale="log", yscale="log")
    panel.set(ylabel="part of the coning that is missed", xlim=(1, 100), ylim=(1e-9, 30))
    panel.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    panel.minorticks_off()
    panel.axvspan(1, 2, color=GREY, alpha=0.2, linewidth=0)
    panel.text(1.05, 3e-9, "aliased", color=BLACK, fontsize=8)
    x = 2 * np.pi / SAMPLES_A_ROUND
    for name in LABELS:
        line = LINES[name]
        panel.plot(SAMPLES_A_ROUND, data.missed[name], **line)
        m = COMPARED[name].samples
        first = factorial(m) / (2.0**m * factorial2(2 * m + 1)) * x ** (2 * m)
        panel.plot(SAMPLES_A_ROUND, first, color=line["color"], linewidth=0.7)


def _draw_floors(panel: Axes, data: NoiseAndBand) -> None:
    half_angle, frequency = BRACKET.half_angle, BRACKET.frequency
    panel.set(title=f"cone of {np.degrees(half_angle):g}° at {frequency:g} Hz, in a minute")
    panel.set(xlabel="sample rate, Hz", ylabel="apparent drift, deg/h", xscale="log", yscale="log")
    panel.set(xlim=(18, 450), ylim=(1e-5, 3e3))
    panel.set_xticks([20, 50, 100, 200, 400], ["20", "50", "100", "200", "400"])
    panel.minorticks_off()
    rates = np.geomspace(18, 450, 120)
    for name in LABELS:
        drift = np.abs(coning_drift(COMPARED[name], half_angle, frequency, 1 / rates))
        panel.plot(rates, drift / DEGREE_PER_HOUR, **LINES[name])
    unit = DEGREE_PER_HOUR * FLOOR_SECONDS
    panel.plot(FLOOR_RATES, data.cut_off / unit, "x", color=GREY, label="rounding, remainder lost")
    panel.plot(FLOOR_RATES, data.carried / unit, "o", color=ORANGE, label="remainder carried")
    expected = carried_floor(rates, QUANTUM) / unit
    panel.plot(rates, expected, color=ORANGE, linewidth=0.8, label="the same, expected")
    white = ANGLE_RANDOM_WALK * np.sqrt(FLOOR_SECONDS) / unit
    panel.axhline(white, color=GREY, linestyle=":", linewidth=2, label="white noise, one sigma")
    panel.legend(loc="lower left", fontsize=8)
