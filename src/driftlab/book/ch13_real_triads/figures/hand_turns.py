"""Three turns by hand: where the axis seems to go meanwhile, and what the estimates are worth."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style, legend_above
from driftlab.book.machinery.sheet import Sheet

from ..experiments import SOURCES, HandTurns

_AXES = "xyz"
_MARKERS = "osD"
_WORDS = (((9, -3), "left"), ((-4, 12), "left"), ((0, 8), "right"))
"""Where the words of a turn stand from the end of its sum, in points, and their alignment."""


@in_style
def draw(data: HandTurns, sheet: Sheet) -> Figure:
    """Paths of the axis on the left; on the right a row a source, a mark a turn."""
    figure = Figure(figsize=(10.5, 4.9))
    paths, worth = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.15, 1]})
    figure.subplots_adjust(0.065, 0.12, 0.985, 0.92, wspace=0.36)
    _draw_paths(paths, data)
    _draw_worth(worth, data)
    return figure


def _draw_paths(panel: Axes, data: HandTurns) -> None:
    panel.set(title="tilt of the turning axis", xlabel="about the next axis, deg")
    panel.set(ylabel="about the one after it, deg", xlim=(-3.3, 3.3), ylim=(-4.0, 1.7))
    panel.set_aspect("equal")
    for name, (offset, side), style, marker, path, added in zip(
        _AXES, _WORDS, SERIES, _MARKERS, data.path / degree, data.added / degree, strict=False
    ):
        color = style["color"]
        panel.plot(*added.T, color=color, linestyle=":", linewidth=1.3)
        panel.plot(*added[-1], color=color, marker=marker, markersize=6, markerfacecolor="white")
        panel.plot(*path.T, color=color, linewidth=1.8)
        panel.plot(*path[-1], color=color, marker=marker, markersize=6)
        panel.annotate(
            f"turn about {name},\nadded up", added[-1], offset, textcoords="offset points",
            fontsize=9, ha=side,
        )  # fmt: skip
    panel.annotate(
        "as rotations:\nback to the start", (0.55, -0.45), (1.1, -1.6), fontsize=9,
        arrowprops={"arrowstyle": "->", "color": GREY},
    )  # fmt: skip
    panel.plot(0, 0, color=BLACK, marker="+", markersize=11)


def _draw_worth(panel: Axes, data: HandTurns) -> None:
    rows = [*SOURCES, "in quadrature", "Larin, another cut", "Larin − Ferraris"]
    differences = (data.estimate - data.by_sections, data.by_sections - data.ferraris)
    sizes = [*data.sources.T, data.deviation, *map(np.abs, differences)]
    panel.set(title="errors by source", xscale="log", xlim=(2e-6, 1e-2))
    panel.set(xlabel="part of a turn", ylim=(len(rows) - 0.5, -0.5))
    panel.set_yticks(range(len(rows)), rows)
    panel.tick_params(axis="y", length=0)
    panel.grid(visible=False, axis="y")
    for border in np.arange(len(rows) - 1) + 0.5:
        panel.axhline(border, color=GREY, linewidth=1.2 if border > len(SOURCES) - 1 else 0.6)
    for index, (style, marker) in enumerate(zip(SERIES[:3], _MARKERS, strict=True)):
        panel.plot(
            [size[index] for size in sizes], np.arange(len(rows)) + 0.2 * (index - 1),
            color=style["color"], marker=marker, markersize=5, linestyle="none",
            label=f"about {_AXES[index]}",
        )  # fmt: skip
    panel.axvline(1 / 360, color=BLACK, linewidth=0.8)
    panel.text(
        1 / 335, 2, "one degree of heading", fontsize=9, rotation=-90, va="center",
        bbox={"color": "white", "pad": 1},
    )  # fmt: skip
    legend_above(panel, ncols=3, fontsize=8)
