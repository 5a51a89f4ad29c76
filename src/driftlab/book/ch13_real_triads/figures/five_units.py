"""A pause of a hand that a rule took for a rest, and what it does to one of five units."""

from textwrap import fill
from typing import Any

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree

from driftlab.book.machinery.arrays_table import to_columns
from driftlab.book.machinery.picture import BLACK, BLUE, GREY, VERMILION, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import ODD, QUIET, WAY_NAMES, FiveUnits

_MARKERS = "osD^v"
_INTERVAL = 0.01  # s, of the records
_UNITS = tuple(f"unit {number}" for number in range(1, 6))


def columns(data: FiveUnits) -> dict[str, Any]:
    """Columns of the figure's CSV: what is drawn, and beside it all numbers of the experiment."""
    sides = {"largest_difference": data.difference, "angle_left_deg": data.residual / degree}
    return {
        "time_s": _times(data),
        "rate_rad_per_s": data.rate,
        "quiet_below_rad_per_s": [QUIET],
        "rest_begins_s": data.pause[:1] * _INTERVAL,
        "rest_ends_s": data.pause[1:] * _INTERVAL,
        "way": WAY_NAMES,
        **{
            f"{unit.replace(' ', '_')}_{name}": column
            for name, values in sides.items()
            for unit, column in zip(_UNITS, values.T, strict=True)
        },
        **to_columns(data),
    }


def _times(data: FiveUnits) -> FloatArray:
    """Of the rates about the pause, s."""
    return (data.rate_begin + np.arange(len(data.rate))) * _INTERVAL


@in_style
def draw(data: FiveUnits, sheet: Sheet) -> Figure:
    """The rate about the pause; below it a row a way: distance from the table, and residual."""
    figure, panels = sheet.mosaic(
        "aa;bc", (10.5, 7.2), (0.235, 0.085, 0.985, 0.95), spaces=(0.09, 0.42),
        height_ratios=[1, 1.35], column_height=7.4, column_heights=[1, 1.35, 1.35],
    )  # fmt: skip
    _draw_pause(panels["a"], data, sheet)
    difference, residual = panels["b"], panels["c"]
    _draw_rows(difference, data.difference, "largest difference from the table's gyro matrix")
    _draw_rows(residual, data.residual / degree, "angle left after a move, rms, deg")
    names = [fill(name, 17) for name in WAY_NAMES] if sheet.on_paper else WAY_NAMES
    difference.set_yticks(range(len(WAY_NAMES)), names)
    residual.set_yticks(range(len(WAY_NAMES)), names if sheet.narrow else [""] * len(WAY_NAMES))
    row = 2
    difference.annotate(
        _UNITS[ODD], (data.difference[row, ODD], row), (8, 1), textcoords="offset points",
    )  # fmt: skip
    difference.set(xscale="log", xlim=(1e-4, 1e-2))
    residual.set(xlim=(0, 0.34))
    if sheet.on_paper:
        legend_below_all(figure, sheet, residual, len(_UNITS), len(_UNITS), columnspacing=0.8,
                         handletextpad=0.1)  # fmt: skip
    else:
        residual.legend(loc="lower right")
    return figure


def _draw_pause(panel: Axes, data: FiveUnits, sheet: Sheet) -> None:
    time = _times(data)
    panel.set(title="unit 2: a rest, or a hand that settles?", yscale="log", ylim=(5e-3, 8))
    panel.set(xlabel="time, s", ylabel="rate, rad/s", xlim=(time[0], time[-1]))
    panel.plot(time, data.rate, color=BLUE, linewidth=1.2, label="size of the rate")
    panel.axhline(QUIET, color=BLACK, linestyle="--", linewidth=1)
    if sheet.narrow:
        panel.text(time[-1], 0.8, f"quiet: < {QUIET:g} rad/s", ha="right")
    else:
        panel.text(time[3], 1.9 * QUIET, f"quiet below {QUIET:g} rad/s")
    begin, end = data.pause * _INTERVAL
    panel.axvspan(begin, end, color=VERMILION, alpha=0.7, linewidth=0)
    panel.annotate(
        f"a rest of {data.pause[1] - data.pause[0]:.0f} samples", ((begin + end) / 2, 0.012),
        (begin + (0.3 if sheet.narrow else 0.55), 0.009), va="center",
        arrowprops={"arrowstyle": "->", "color": VERMILION},
    )  # fmt: skip


def _draw_rows(panel: Axes, values: FloatArray, words: str) -> None:
    panel.set(xlabel=words, ylim=(len(WAY_NAMES) - 0.5, -0.5))
    panel.grid(visible=False, axis="y")
    panel.tick_params(axis="y", length=0)
    for border in np.arange(len(WAY_NAMES) - 1) + 0.5:
        panel.axhline(border, color=GREY, linewidth=0.6)
    size = rcParams["lines.markersize"]
    for unit, (column, marker) in enumerate(zip(values.T, _MARKERS, strict=True)):
        odd = unit == ODD
        panel.plot(
            column, np.arange(len(WAY_NAMES)) + 0.13 * (unit - 2), marker=marker, linestyle="none",
            color=VERMILION if odd else GREY, markersize=size * (1.2 if odd else 0.85),
            label=_UNITS[unit],
        )  # fmt: skip
