"""Plotnikov Fig. 2 with a real triad: what disturbs the car, and the headings of each restart."""

from typing import Any

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES

from ..experiments import METHODS

_MARKERS = "Dso"
_STYLES = (SERIES[1], SERIES[2], SERIES[0])


@from_table
def draw(drawing: Drawing) -> None:
    """On the left the unrest and all headings; then those near the truth; and their deviations."""
    panels = drawing.mosaic(
        "acd;bcd", (10.5, 5.2), (0.065, 0.1, 0.985, 0.93), spaces=(0.3, 0.32),
        width_ratios=[1.15, 1.15, 1], height_ratios=[1, 1.5], column="a;b;c;d",
        column_height=8.4, column_heights=[1, 1.3, 1.6, 1.6], page_height=4.4,
    )  # fmt: skip
    _draw_unrest(panels["a"], drawing)
    _draw_headings(panels["b"], drawing)
    _draw_near_truth(panels["c"], drawing)
    _draw_deviations(panels["d"], drawing)


def _draw_unrest(panel: Axes, drawing: Drawing) -> None:
    panel.set(title="unrest of the car, °/h", yscale="log", xlim=(0, 31), ylim=(0.4, 9000))
    step: dict[str, Any] = {"drawstyle": "steps-mid", "color": GREY, "linewidth": 1.0}
    drawing.curve(panel, "unrest_time", "unrest", **step)
    (level,) = drawing.table.shown("level_earth_rate")
    label = f"level part of the Earth's rate: {level:.1f}"
    drawing.level(panel, y="level_earth_rate", color=BLACK, linewidth=1.2, label=label)
    panel.legend(loc="upper right", fontsize="small")
    panel.tick_params(labelbottom=False)


def _draw_headings(panel: Axes, drawing: Drawing) -> None:
    shown = np.degrees(drawing.table.restarts[[0, 2]])
    panel.set(title=f"heading from each {drawing.table.lengths[0]:g} s, °", xlabel="time, minutes")
    panel.set(xlim=(0, 31), ylim=(min(-140, shown.min() - 20), max(-20, shown.max() + 20)))
    for row, name in ((0, "means"), (2, "all_velocities")):
        drawing.curve(
            panel, "restart_time", f"restart_{name}", color=_STYLES[row]["color"],
            marker=_MARKERS[row], markersize=4, linestyle="none", label=METHODS[row],
        )  # fmt: skip
    panel.legend(loc="lower right", fontsize="small")


def _draw_near_truth(panel: Axes, drawing: Drawing) -> None:
    """All velocities, with twice the deviation that they state."""
    table = drawing.table
    shown = np.degrees([*table.restart_all_velocities, *table.stretch_all_velocities])
    panel.set(title="all velocities, ± 2 stated deviations, °", xlabel="time, minutes")
    panel.set(xlim=(0, 31), ylim=(min(-91.1, shown.min() - 0.1), max(-90.1, shown.max() + 0.1)))
    drawing.level(panel, y="file_header_heading", color=GREY, linewidth=1.2, label="file's header")
    size = rcParams["lines.markersize"]
    for name, seconds, color, marker in (
        ("restart", table.lengths[0], _STYLES[2]["color"], "o"),
        ("stretch", table.lengths[2], BLACK, "^"),
    ):
        end = f"{name}_all_velocities"
        drawing.error_bars(
            panel, f"{name}_time", end, f"{end}_less_two_deviations", f"{end}_and_two_deviations",
            color=color, marker=marker, markersize=size * (0.8 if marker == "o" else 1.15),
            linestyle="none", elinewidth=0.8 if marker == "o" else 1.6, label=f"{seconds:g} s",
        )  # fmt: skip
    panel.legend(loc="lower right", fontsize="small")


def _draw_deviations(panel: Axes, drawing: Drawing) -> None:
    table, words = drawing.table, [method.replace(" ", "_") for method in METHODS]
    ends = ("deviation", "deviation_low", "deviation_high")
    found = np.array([[table.shown(f"{word}_{end}") for end in ends] for word in words])
    reach = min(0.005, 0.5 * found.min()), max(60, 2 * found.max())
    panel.set(title="standard deviation, °", xlabel="length, s", ylim=reach)
    shortest, _, longest = table.lengths
    panel.set(xscale="log", yscale="log", xlim=(0.79 * shortest, 4 / 3 * longest))
    panel.set_xticks(table.lengths, [f"{length:g}" for length in table.lengths])
    panel.minorticks_off()
    size = 0.8 * rcParams["lines.markersize"]
    for word, method, style, marker in zip(words, METHODS, _STYLES, _MARKERS, strict=True):
        drawing.error_bars(
            panel, f"{word}_drawn_at_length", *(f"{word}_{end}" for end in ends), **style,
            marker=marker, markersize=size, elinewidth=1.0, capsize=2, label=method,
        )  # fmt: skip
    panel.legend(loc="center right", bbox_to_anchor=(1.0, 0.46), fontsize="small")
