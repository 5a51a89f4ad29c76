"""Allan plots of a cheap and a dear gyro, with the lines of their noise labelled where they run."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import arcsecond, degree, hour

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.noise_terms import TERMS, NoiseTerms

from ..experiments.allan_lines import CHEAP_FROM, DEAR_FROM, PULSE, ROUNDING, AllanLines, Lines

LABELS = {
    "quantisation": "slope −1",
    "angle_random_walk": "angle random walk",
    "bias_instability": "bias instability",
    "rate_random_walk": "rate random walk",
    "rate_ramp": "rate ramp",
}
UNIT = degree / hour
ROOM = 1.75
"""Factor between heights at which two labels do not touch."""


def columns(data: AllanLines) -> dict[str, Any]:
    """Columns of the figure's CSV, in SI units: all that it is drawn from."""
    curves: dict[str, tuple[FloatArray, FloatArray]] = {}
    for gyro, lines in (("cheap", data.cheap), ("dear", data.dear)):
        for name in ("deviation", "lower", "upper"):
            curves[f"{gyro}: {name}, rad/s over s"] = (lines.times, getattr(lines, name))
        for name in ("terms", "uncertainty", "bounds"):
            curves[f"{gyro}: {name} over term"] = (np.arange(5.0), getattr(lines, name))
    curves["dear: missed without and with slope -1"] = (np.arange(2.0), data.missed.round(5))
    curves["dear: rocking, rad"] = (np.zeros(1), np.array([data.rocking]))
    curves["dear: coherence with the forward gyro"] = (np.zeros(1), np.array([data.shared]))
    curves["forward: walk by fit, at most by headings"] = (np.arange(2.0), data.forward)
    return long_table(curves)


def restore(table: Mapping[str, list[str]]) -> AllanLines:
    """Return the data from the columns of the CSV."""
    curve, x, y = np.array(table["curve"]), *(np.array(table[key], float) for key in "xy")

    def lines(gyro: str) -> Lines:
        times = x[curve == f"{gyro}: deviation, rad/s over s"]
        points = (
            y[curve == f"{gyro}: {name}, rad/s over s"] for name in ("deviation", "lower", "upper")
        )
        terms = (y[curve == f"{gyro}: {name} over term"]
                 for name in ("terms", "uncertainty", "bounds"))  # fmt: skip
        return Lines(times, *points, *terms)

    return AllanLines(
        lines("cheap"),
        lines("dear"),
        y[curve == "dear: missed without and with slope -1"],
        float(y[curve == "dear: rocking, rad"][0]),
        float(y[curve == "dear: coherence with the forward gyro"][0]),
        y[curve == "forward: walk by fit, at most by headings"],
    )


@in_style
def draw(data: AllanLines, sheet: Sheet) -> Figure:
    """Two panels with the same axes for times and deviations."""
    figure = Figure(figsize=(10.5, 4.6))
    panels = figure.subplots(1, 2, sharey=True)
    figure.subplots_adjust(0.075, 0.115, 0.985, 0.93, wspace=0.05)
    _panel(panels[0], data.cheap, CHEAP_FROM)
    _panel(panels[1], data.dear, DEAR_FROM, angle_random_walk="slope −½")
    panels[0].set(title="a cheap gyro: MPU-9150, 9 seconds at rest", ylabel="Allan deviation, °/h")
    panels[1].set(title="a dear one: laser gyro, 440 seconds on a parked car")
    times = np.array([0.01, 110.0])
    pulse = NoiseTerms(quantisation=ROUNDING).deviation(times) / UNIT
    panels[1].plot(times, pulse, color=GREY, linestyle=":")
    panels[1].text(0.0125, 1.3, f"rounding of its pulses of {PULSE / arcsecond:.1f}″",
                   color=GREY, fontsize=8, rotation=-43, rotation_mode="anchor")  # fmt: skip
    panels[0].annotate("a hump near 10 Hz", (0.02, 190), (0.06, 500), fontsize=8,
                       arrowprops={"arrowstyle": "-", "color": GREY})  # fmt: skip
    panels[1].annotate("the car rocks", (0.13, 62), (0.7, 240), fontsize=8,
                       arrowprops={"arrowstyle": "-", "color": GREY})  # fmt: skip
    return figure


def _panel(panel: Axes, lines: Lines, begin: float, **names: str) -> None:
    """Points with their intervals, lines that are seen, and bounds of those that are not."""
    labelled = LABELS | names
    panel.set(xscale="log", yscale="log", xlim=(0.008, 20000), ylim=(0.004, 3000))
    panel.set(xlabel="averaging time, s")
    fitted = lines.times >= begin
    for chosen, face in ((fitted, BLACK), (~fitted, "white")):
        if chosen.any():
            middle, low, high = (
                part[chosen] / UNIT for part in (lines.deviation, lines.lower, lines.upper)
            )
            panel.errorbar(
                lines.times[chosen], middle, [middle - low, high - middle], fmt="o", markersize=4,
                color=BLACK, markerfacecolor=face, linewidth=0.9,
            )  # fmt: skip
    times = np.geomspace(max(begin, lines.times[0]), lines.times[-1], 50)
    total = NoiseTerms(*map(float, lines.terms)).deviation(times) / UNIT
    panel.plot(times, total, color=BLACK, linewidth=0.8)
    wide = np.array([lines.times[0], lines.times[-1]])
    labels = []
    for i, name in enumerate(TERMS):
        seen = lines.terms[i] > 0
        size = float(lines.terms[i] if seen else lines.bounds[i])
        if np.isfinite(size):
            line = NoiseTerms(**{name: size}).deviation(wide) / UNIT
            color = SERIES[i]["color"]
            style = {"linestyle": "-", "linewidth": 1.6} if seen else {"linestyle": (0, (2, 3))}
            panel.plot(wide, line, color=color, **style)
            labels.append((line[1], labelled[name] if seen else f"at most: {labelled[name]}"))
    place = 0.0
    for height, words in sorted(labels):
        place = max(place * ROOM, height)
        panel.text(1.25 * wide[1], place, words, fontsize=8, va="center")
