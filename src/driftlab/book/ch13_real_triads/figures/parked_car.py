"""Plotnikov Fig. 2 with a real triad: what disturbs the car, and the headings of each restart."""

from typing import Any

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree, hour, minute

from driftlab.book.machinery.arrays_table import to_columns
from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE

from ..experiments.parked_car import HEADER, METHODS, UNREST, ParkedCar, spread

_MARKERS = "Dso"
_STYLES = (SERIES[1], SERIES[2], SERIES[0])
_APART = 0.03
"""Part of a length by which marks of the three methods stand side by side."""


def columns(data: ParkedCar) -> dict[str, Any]:
    """Columns of the figure's CSV: what is drawn, and beside it all numbers of the experiment."""
    drawn: dict[str, Any] = {
        "unrest_time_min": _middles(UNREST, len(data.unrest)),
        "unrest_deg_per_h": data.unrest / (degree / hour),
        "level_earth_rate_deg_per_h": [_level_earth_rate(data)],
        "file_header_heading_deg": [np.degrees(HEADER)],
    }
    for name, seconds, headings, deviations in _stated(data):
        ends = np.degrees(headings[2] + 2 * deviations * np.array([[0.0], [-1.0], [1.0]]))
        drawn[f"{name}_time_min"] = _middles(seconds, headings.shape[1])
        drawn[f"{name}_means_deg"] = np.degrees(headings[0])
        for title, values in zip(("", "_less_two_deviations", "_and_two_deviations"), ends,
                                 strict=True):  # fmt: skip
            drawn[f"{name}_all_velocities{title}_deg"] = values
    for row, method in enumerate(METHODS):
        word = method.replace(" ", "_")
        drawn[f"{word}_drawn_at_length_s"] = _places(data, row)
        titles = ("deviation", "deviation_low", "deviation_high")
        for title, values in zip(titles, _deviations(data, row), strict=True):
            drawn[f"{word}_{title}_deg"] = values
    return {**drawn, **to_columns(data)}


def _stated(data: ParkedCar) -> tuple[tuple[str, float, FloatArray, FloatArray], ...]:
    """Name, length in s, headings (3, n) and stated deviations (n,) of restarts and longest."""
    return (
        ("restart", float(data.lengths[0]), data.restarts, data.restart_deviations),
        ("stretch", float(data.lengths[2]), data.stretches, data.stretch_deviations),
    )


def _deviations(data: ParkedCar, row: int) -> FloatArray:
    """Standard deviation of a method's headings, and its interval: (3, length), degrees."""
    found = [spread(part[row]) for part in (data.restarts, data.longer, data.stretches)]
    return np.degrees([(s.deviation, s.low, s.high) for s in found]).T


def _places(data: ParkedCar, row: int) -> FloatArray:
    """Where the marks of a method stand on the axis of lengths, s."""
    return data.lengths * (1 + _APART * (row - 1))


@in_style
def draw(data: ParkedCar, sheet: Sheet) -> Figure:
    """On the left the unrest and all headings; then those near the truth; and their deviations."""
    figure, panels = sheet.mosaic(
        "acd;bcd", (10.5, 5.2), (0.065, 0.1, 0.985, 0.93), spaces=(0.3, 0.32),
        width_ratios=[1.15, 1.15, 1], height_ratios=[1, 1.5], column="a;b;c;d",
        column_height=8.4, column_heights=[1, 1.3, 1.6, 1.6], page_height=4.4,
    )  # fmt: skip
    _draw_unrest(panels["a"], data)
    _draw_headings(panels["b"], data)
    _draw_near_truth(panels["c"], data)
    _draw_deviations(panels["d"], data)
    return figure


def _middles(seconds: float, count: int) -> FloatArray:
    """Middles of stretches side by side, minutes."""
    return seconds / minute * (np.arange(count) + 0.5)


def _level_earth_rate(data: ParkedCar) -> float:
    """Level part of the Earth's rate, deg/h."""
    return float(EARTH_RATE * np.cos(data.latitude) / (degree / hour))


def _draw_unrest(panel: Axes, data: ParkedCar) -> None:
    unit = degree / hour
    panel.set(title="unrest of the car, °/h", yscale="log", xlim=(0, 31), ylim=(0.4, 9000))
    panel.step(_middles(UNREST, len(data.unrest)), data.unrest / unit, where="mid",
               color=GREY, linewidth=1.0)  # fmt: skip
    level = _level_earth_rate(data)
    panel.axhline(level, color=BLACK, linewidth=1.2,
                  label=f"level part of the Earth's rate: {level:.1f}")  # fmt: skip
    panel.legend(loc="upper right", fontsize="small")
    panel.tick_params(labelbottom=False)


def _draw_headings(panel: Axes, data: ParkedCar) -> None:
    times = _middles(data.lengths[0], data.restarts.shape[1])
    shown = np.degrees(data.restarts[[0, 2]])
    panel.set(title=f"heading from each {data.lengths[0]:g} s, °", xlabel="time, minutes")
    panel.set(xlim=(0, 31), ylim=(min(-140, shown.min() - 20), max(-20, shown.max() + 20)))
    for row in (0, 2):
        panel.plot(times, np.degrees(data.restarts[row]), color=_STYLES[row]["color"],
                   marker=_MARKERS[row], markersize=4, linestyle="none",
                   label=METHODS[row])  # fmt: skip
    panel.legend(loc="lower right", fontsize="small")


def _draw_near_truth(panel: Axes, data: ParkedCar) -> None:
    """All velocities, with twice the deviation that they state."""
    rows = list(zip(_stated(data), ((_STYLES[2]["color"], "o"), (BLACK, "^")), strict=True))
    shown = np.degrees(np.concatenate([headings[2] for (_, _, headings, _), _ in rows]))
    panel.set(title="all velocities, ± 2 stated deviations, °", xlabel="time, minutes")
    panel.set(xlim=(0, 31), ylim=(min(-91.1, shown.min() - 0.1), max(-90.1, shown.max() + 0.1)))
    panel.axhline(np.degrees(HEADER), color=GREY, linewidth=1.2, label="file's header")
    size = rcParams["lines.markersize"]
    for (_, seconds, headings, deviation), (color, marker) in rows:
        panel.errorbar(
            _middles(seconds, headings.shape[1]), np.degrees(headings[2]),
            yerr=2 * np.degrees(deviation), color=color, marker=marker,
            markersize=size * (0.8 if marker == "o" else 1.15), linestyle="none",
            elinewidth=0.8 if marker == "o" else 1.6, label=f"{seconds:g} s",
        )  # fmt: skip
    panel.legend(loc="lower right", fontsize="small")


def _draw_deviations(panel: Axes, data: ParkedCar) -> None:
    shortest, longest = data.lengths[[0, -1]]
    found = [_deviations(data, row) for row in range(len(METHODS))]
    reach = min(0.005, 0.5 * np.min(found)), max(60, 2 * np.max(found))
    panel.set(title="standard deviation, °", xlabel="length, s", ylim=reach)
    panel.set(xscale="log", yscale="log", xlim=(0.79 * shortest, 4 / 3 * longest))
    panel.set_xticks(data.lengths, [f"{length:g}" for length in data.lengths])
    panel.minorticks_off()
    size = 0.8 * rcParams["lines.markersize"]
    for row, (name, (middle, low, high)) in enumerate(zip(METHODS, found, strict=True)):
        panel.errorbar(
            _places(data, row), middle, yerr=[middle - low, high - middle],
            **_STYLES[row], marker=_MARKERS[row], markersize=size, elinewidth=1.0, capsize=2,
            label=name,
        )  # fmt: skip
    panel.legend(loc="center right", bbox_to_anchor=(1.0, 0.46), fontsize="small")
