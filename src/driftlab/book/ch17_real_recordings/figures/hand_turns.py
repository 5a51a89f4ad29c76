"""Three turns by hand: where the axis seems to go meanwhile, and what the estimates are worth."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import (
    BLACK,
    GREY,
    GUIDE,
    SERIES,
    legend_above,
    legend_below_all,
)

from ..experiments import ESTIMATES, ROWS, SOURCES

_AXES = "xyz"
_MARKERS = "osD"
_WORDS = (((9, -3), "left"), ((-4, 12), "left"), ((0, 8), "right"))
"""Where the words of a turn stand from the end of its sum, in points, and their alignment."""


@from_table
def draw(drawing: Drawing) -> None:
    """Paths of the axis on the left; on the right a row a source, a mark a turn."""
    panels = drawing.mosaic(
        "ab", (10.5, 4.9), (0.065, 0.12, 0.985, 0.92), spaces=(0.36, 0.2), width_ratios=[1.15, 1],
        column_height=6.2, column_heights=[1.1, 1],
    )  # fmt: skip
    _draw_paths(panels["a"], drawing)
    _draw_worth(panels["b"], drawing)
    if drawing.sheet.on_paper:
        legend_below_all(drawing.figure, drawing.sheet, panels["b"], ncols=3, column=3)
    else:
        legend_above(panels["b"], ncols=3, fontsize=8)


def _draw_paths(panel: Axes, drawing: Drawing) -> None:
    panel.set(title="tilt of the turning axis", xlabel="about the next axis, deg")
    panel.set(ylabel="about the one after it, deg", xlim=(-3.3, 3.3))
    panel.set_ylim(-4.0, 2.3 if drawing.sheet.narrow else 1.7)
    panel.set_aspect("equal")
    for name, (offset, side), style, marker in zip(_AXES, _WORDS, SERIES, _MARKERS, strict=False):
        end: dict[str, Any] = {"color": style["color"], "marker": marker, "markevery": [-1]}
        end["where"] = {"turn": name}
        added = drawing.curve(
            panel, "added_next_axis", "added_axis_after", **end, linestyle=":",
            markerfacecolor="white", label=f"turn about {name}, added up",
        )  # fmt: skip
        words = f"turn about {name}, as a rotation"
        drawing.curve(panel, "tilt_next_axis", "tilt_axis_after", **end, label=words)
        panel.annotate(
            f"turn about {name},\nadded up", added.get_xydata()[-1], offset,
            textcoords="offset points", fontsize="medium", ha=side,
        )  # fmt: skip
    panel.annotate(
        "as rotations:\nback to the start", (0.55, -0.45), (0.8, -1.6), fontsize="medium",
        arrowprops={"arrowstyle": "->", "color": GREY},
    )  # fmt: skip
    panel.plot(0, 0, color=BLACK, marker="+", markersize=11, label=GUIDE)


def _draw_worth(panel: Axes, drawing: Drawing) -> None:
    sizes, count = drawing.table.part_of_a_turn, len(ROWS)
    places = np.arange(count, dtype=np.float64)
    reach = min(2e-6, 0.5 * sizes.min()), max(1e-2, 2 * sizes.max())
    panel.set(title="errors by source", xscale="log", xlim=reach)
    panel.set(xlabel="part of a turn", ylim=(count - 0.5, -0.5))
    panel.set_yticks(range(count), ROWS)
    panel.tick_params(axis="y", length=0)
    panel.grid(visible=False, axis="y")
    for border in places[1:] - 0.5:
        width = 1.2 if border > len(SOURCES) - 1 else 0.6
        panel.axhline(border, color=GREY, linewidth=width, label=GUIDE)
    for index, (name, style, marker) in enumerate(zip(_AXES, SERIES, _MARKERS, strict=False)):
        drawing.curve(
            panel, f"part_of_a_turn, turn about {name}", places + 0.2 * (index - 1),
            color=style["color"], marker=marker, linestyle="none", label=f"about {name}",
        )  # fmt: skip
    panel.axvline(1 / 360, color=BLACK, linewidth=0.8, label=GUIDE)
    panel.text(
        1 / 335, 2, "one degree of heading", fontsize="medium", rotation=-90, va="center",
        bbox={"color": "white", "pad": 1},
    )  # fmt: skip


@from_table
def draw_estimates(drawing: Drawing) -> None:
    """A panel a turn, a row an estimate; the bar of the first is its standard deviation."""
    panels = drawing.mosaic(
        "abc", (10.5, 2.6), (0.165, 0.2, 0.985, 0.88), spaces=(0.12, 0.5), column_height=6.0,
        page_height=2.6,
    )  # fmt: skip
    rows = range(len(ESTIMATES))
    for name, (letter, panel) in zip(_AXES, panels.items(), strict=True):
        end = f"turn about {name}"
        drawing.error_bars(
            panel, f"scale_error, {end}", rows, f"low, {end}", f"high, {end}", across=True,
            color=SERIES[0]["color"], marker="o", linestyle="none",
        )  # fmt: skip
        panel.set(title=end, xlabel="scale-factor error, thousandths", ylim=(3.5, -0.5))
        labelled = letter == "a" or drawing.sheet.narrow
        panel.set_yticks(rows, ESTIMATES if labelled else [""] * len(rows))
        panel.tick_params(axis="y", length=0)
