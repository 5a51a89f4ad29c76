"""A pause of a hand that a rule took for a rest, and what it does to one of five units."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree

from driftlab.book.machinery.picture import BLACK, BLUE, GREY, VERMILION, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import ODD, QUIET, WAY_NAMES, FiveUnits

_MARKERS = "osD^v"
_INTERVAL = 0.01  # s, of the records


@in_style
def draw(data: FiveUnits, sheet: Sheet) -> Figure:
    """The rate about the pause; below it a row a way: distance from the table, and residual."""
    figure = Figure(figsize=(10.5, 7.2))
    grid = figure.add_gridspec(2, 2, height_ratios=[1, 1.35])
    figure.subplots_adjust(0.235, 0.085, 0.985, 0.95, wspace=0.09, hspace=0.42)
    _draw_pause(figure.add_subplot(grid[0, :]), data)
    difference, residual = (figure.add_subplot(grid[1, column]) for column in (0, 1))
    _draw_rows(difference, data.difference, "largest difference from the table's gyro matrix")
    _draw_rows(residual, data.residual / degree, "angle left after a move, rms, deg")
    difference.set_yticks(range(len(WAY_NAMES)), WAY_NAMES)
    residual.set_yticks([])
    row = 2
    difference.annotate(
        _UNITS[ODD], (data.difference[row, ODD], row), (8, 1), textcoords="offset points",
        fontsize=10,
    )  # fmt: skip
    difference.set(xscale="log", xlim=(1e-4, 1e-2))
    residual.set(xlim=(0, 0.34))
    residual.legend(loc="lower right")
    return figure


_UNITS = tuple(f"unit {number}" for number in range(1, 6))


def _draw_pause(panel: Axes, data: FiveUnits) -> None:
    time = (data.rate_begin + np.arange(len(data.rate))) * _INTERVAL
    panel.set(title="unit 2: a rest, or a hand that settles?", yscale="log", ylim=(5e-3, 8))
    panel.set(xlabel="time, s", ylabel="rate, rad/s", xlim=(time[0], time[-1]))
    panel.plot(time, data.rate, color=BLUE, linewidth=1.2)
    panel.axhline(QUIET, color=BLACK, linestyle="--", linewidth=1)
    panel.text(time[3], 1.9 * QUIET, f"quiet below {QUIET:g} rad/s", fontsize=9, va="bottom")
    begin, end = data.pause * _INTERVAL
    panel.axvspan(begin, end, color=VERMILION, alpha=0.7, linewidth=0)
    panel.annotate(
        f"a rest of {data.pause[1] - data.pause[0]:.0f} samples", ((begin + end) / 2, 0.012),
        (begin + 0.55, 0.009), fontsize=10, va="center",
        arrowprops={"arrowstyle": "->", "color": VERMILION},
    )  # fmt: skip


def _draw_rows(panel: Axes, values: FloatArray, words: str) -> None:
    panel.set(xlabel=words, ylim=(len(WAY_NAMES) - 0.5, -0.5))
    panel.grid(visible=False, axis="y")
    panel.tick_params(axis="y", length=0)
    for border in np.arange(len(WAY_NAMES) - 1) + 0.5:
        panel.axhline(border, color=GREY, linewidth=0.6)
    for unit, (column, marker) in enumerate(zip(values.T, _MARKERS, strict=True)):
        odd = unit == ODD
        panel.plot(
            column, np.arange(len(WAY_NAMES)) + 0.13 * (unit - 2), marker=marker, linestyle="none",
            color=VERMILION if odd else GREY, markersize=7 if odd else 5, label=_UNITS[unit],
        )  # fmt: skip
