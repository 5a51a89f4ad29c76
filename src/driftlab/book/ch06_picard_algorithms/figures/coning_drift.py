"""Apparent drift on a coning motion: measured over many steps, and from one."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import degree, hour

from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.machinery.picture import in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import BRACKET, BRACKET_SAMPLE_RATE, ConingDrift
from .algorithm_laboratory import STYLES

DEGREE_PER_HOUR = degree / hour
CURVES = {
    "picard-1": "picard-1",
    "two-step-4": "one-step-3, two-step-3, two-step-4 and rotation-vector-2, nearly equal",
    "memory-4": "memory-4",
    "rotation-vector-3": "rotation-vector-3",
}
"""What is drawn, with its label: four algorithms differ in the fourth power of the half angle."""


def columns(data: ConingDrift) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {}
    for i, name in enumerate(data.names):
        curves[f"{name}, rad/s over coning frequency in Hz"] = (
            data.frequencies,
            data.by_frequency[i],
        )
        curves[f"{name}, rad/s over sample rate in Hz"] = (data.rates, data.by_rate[i])
    return long_table(curves)


@in_style
def draw(data: ConingDrift, sheet: Sheet) -> Figure:
    """Draw the drift over coning frequency and over sample rate."""
    figure = Figure(figsize=(10.5, 4.6))
    by_frequency, by_rate = figure.subplots(1, 2, sharey=True)
    figure.subplots_adjust(0.075, 0.2, 0.985, 0.92, wspace=0.06)
    half_angle, frequency = BRACKET.half_angle, BRACKET.frequency
    angle = f"half angle {np.degrees(half_angle):g}°"
    by_frequency.set(title=f"sampled at {BRACKET_SAMPLE_RATE:g} Hz, {angle}")
    by_frequency.set(xlabel="coning frequency, Hz", ylabel="apparent drift, deg/h")
    by_frequency.set(xscale="log", yscale="log", xlim=(0.8, 40), ylim=(1e-7, 1e5))
    by_frequency.set_xticks([1, 2, 5, 10, 20, 40], ["1", "2", "5", "10", "20", "40"])
    by_rate.set(title=f"coning at {frequency:g} Hz, {angle}", xlabel="sample rate, Hz")
    by_rate.set(xscale="log", xlim=(12, 1000))
    by_rate.set_xticks([20, 50, 100, 200, 500], ["20", "50", "100", "200", "500"])
    for panel in (by_frequency, by_rate):
        panel.minorticks_off()
    frequencies, rates = np.geomspace(0.8, 40, 200), np.geomspace(12, 1000, 200)
    handles = []
    for name, label in CURVES.items():
        i = data.names.index(name)
        line = dict(STYLES[name])
        dots = {"color": line["color"], "linestyle": "none", "marker": line.pop("marker")}
        dots["markersize"] = line.pop("markersize")
        for panel, x, formula, at, measured in (
            (
                by_frequency,
                frequencies,
                coning_drift(name, half_angle, frequencies, 1 / BRACKET_SAMPLE_RATE),
                data.frequencies,
                data.by_frequency[i],
            ),
            (
                by_rate,
                rates,
                coning_drift(name, half_angle, frequency, 1 / rates),
                data.rates,
                data.by_rate[i],
            ),
        ):
            panel.plot(x, np.abs(formula) / DEGREE_PER_HOUR, **line)
            panel.plot(at, measured / DEGREE_PER_HOUR, **dots)
        handles += by_frequency.plot([], [], **STYLES[name], label=label)
    figure.legend(handles=handles, loc="lower center", ncols=len(CURVES), fontsize=8)
    return figure
