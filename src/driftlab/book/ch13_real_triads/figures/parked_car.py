"""Plotnikov Fig. 2 with a real triad: what disturbs the car, and the headings of each restart."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree, hour, minute

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE

from ..experiments.parked_car import (
    HEADER,
    LONGER,
    METHODS,
    RESTART,
    STRETCH,
    UNREST,
    ParkedCar,
    spread,
)

_MARKERS = "Dso"
_STYLES = (SERIES[1], SERIES[2], SERIES[0])


@in_style
def draw(data: ParkedCar, sheet: Sheet) -> Figure:
    """On the left the unrest and all headings; then those near the truth; and their deviations."""
    figure = Figure(figsize=(10.5, 5.2))
    grid = figure.add_gridspec(2, 3, height_ratios=[1, 1.5], width_ratios=[1.15, 1.15, 1])
    figure.subplots_adjust(0.065, 0.1, 0.985, 0.93, wspace=0.3, hspace=0.32)
    unrest, headings = (figure.add_subplot(grid[row, 0]) for row in (0, 1))
    _draw_unrest(unrest, data)
    _draw_headings(headings, data)
    _draw_near_truth(figure.add_subplot(grid[:, 1]), data)
    _draw_deviations(figure.add_subplot(grid[:, 2]), data)
    return figure


def _middles(seconds: float, count: int) -> FloatArray:
    """Middles of stretches side by side, minutes."""
    return seconds / minute * (np.arange(count) + 0.5)


def _draw_unrest(panel: Axes, data: ParkedCar) -> None:
    unit = degree / hour
    panel.set(title="unrest of the car, °/h", yscale="log", xlim=(0, 31), ylim=(0.4, 9000))
    panel.step(_middles(UNREST, len(data.unrest)), data.unrest / unit, where="mid",
               color=GREY, linewidth=1.0)  # fmt: skip
    level = float(EARTH_RATE * np.cos(data.latitude) / unit)
    panel.axhline(level, color=BLACK, linewidth=1.2,
                  label=f"level part of the Earth's rate: {level:.1f}")  # fmt: skip
    panel.legend(loc="upper right", fontsize=8)
    panel.tick_params(labelbottom=False)


def _draw_headings(panel: Axes, data: ParkedCar) -> None:
    times = _middles(RESTART, data.restarts.shape[1])
    panel.set(title=f"heading from each {RESTART:g} s, °", xlabel="time, minutes")
    panel.set(xlim=(0, 31), ylim=(-140, -20))
    for row in (0, 2):
        panel.plot(times, np.degrees(data.restarts[row]), color=_STYLES[row]["color"],
                   marker=_MARKERS[row], markersize=4, linestyle="none",
                   label=METHODS[row])  # fmt: skip
    panel.legend(loc="lower right", fontsize=8)


def _draw_near_truth(panel: Axes, data: ParkedCar) -> None:
    """All velocities, with twice the deviation that they state."""
    panel.set(title="all velocities, ± 2 stated deviations, °", xlabel="time, minutes")
    panel.set(xlim=(0, 31), ylim=(-91.1, -90.1))
    rows = (
        (RESTART, data.restarts[2], data.restart_deviations, _STYLES[2]["color"], "o"),
        (STRETCH, data.stretches[2], data.stretch_deviations, BLACK, "^"),
    )
    panel.axhline(np.degrees(HEADER), color=GREY, linewidth=1.2, label="file's header")
    for seconds, heading, deviation, color, marker in rows:
        panel.errorbar(
            _middles(seconds, len(heading)), np.degrees(heading), yerr=2 * np.degrees(deviation),
            color=color, marker=marker, markersize=5 if marker == "o" else 7, linestyle="none",
            elinewidth=0.8 if marker == "o" else 1.6, label=f"{seconds:g} s",
        )  # fmt: skip
    panel.legend(loc="lower right", fontsize=8)


def _draw_deviations(panel: Axes, data: ParkedCar) -> None:
    lengths = np.array([RESTART, LONGER, STRETCH])
    panel.set(title="standard deviation, °", xlabel="length, s")
    panel.set(xscale="log", yscale="log", xlim=(55, 400), ylim=(0.005, 60))
    panel.set_xticks(lengths, [f"{length:g}" for length in lengths])
    panel.minorticks_off()
    for row, name in enumerate(METHODS):
        found = [spread(part[row]) for part in (data.restarts, data.longer, data.stretches)]
        middle, low, high = np.degrees([(s.deviation, s.low, s.high) for s in found]).T
        panel.errorbar(
            lengths * (1 + 0.03 * (row - 1)), middle, yerr=[middle - low, high - middle],
            **_STYLES[row], marker=_MARKERS[row], markersize=5, elinewidth=1.0, capsize=2,
            label=name,
        )  # fmt: skip
    panel.legend(loc="center right", bbox_to_anchor=(1.0, 0.46), fontsize=8)
