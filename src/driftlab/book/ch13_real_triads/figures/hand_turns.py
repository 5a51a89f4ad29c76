"""Three turns by hand: where the axis seems to go meanwhile, and what the estimates are worth."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree

from driftlab.book.machinery.arrays_table import to_columns
from driftlab.book.machinery.picture import (
    BLACK,
    GREY,
    GUIDE,
    SERIES,
    in_style,
    legend_above,
    legend_below_all,
)
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import SOURCES, HandTurns

_AXES = "xyz"
_MARKERS = "osD"
_WORDS = (((9, -3), "left"), ((-4, 12), "left"), ((0, 8), "right"))
"""Where the words of a turn stand from the end of its sum, in points, and their alignment."""
_ROWS = (*SOURCES, "in quadrature", "Larin, another cut", "Larin − Ferraris")
"""Of the panel on the right."""


def columns(data: HandTurns) -> dict[str, Any]:
    """Columns of the figure's CSV: what is drawn, and beside it all numbers of the experiment."""
    count = data.path.shape[1]
    tilts = {"tilt": data.path / degree, "added": data.added / degree}
    sizes = {f"turn_about_{axis}": size for axis, size in zip(_AXES, _sizes(data).T, strict=True)}
    return {
        "turn": [axis for axis in _AXES for _ in range(count)],
        **{f"{name}_next_axis_deg": both[..., 0].ravel() for name, both in tilts.items()},
        **{f"{name}_axis_after_deg": both[..., 1].ravel() for name, both in tilts.items()},
        "error_by_source": _ROWS,
        **{f"{name}_part_of_a_turn": size for name, size in sizes.items()},
        **to_columns(data),
    }


def _sizes(data: HandTurns) -> FloatArray:
    """By how much each source may move an estimate, (row, turn), parts of a turn."""
    differences = (data.estimate - data.by_sections, data.by_sections - data.ferraris)
    return np.array([*data.sources.T, data.deviation, *np.abs(differences)])


@in_style
def draw(data: HandTurns, sheet: Sheet) -> Figure:
    """Paths of the axis on the left; on the right a row a source, a mark a turn."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.9), (0.065, 0.12, 0.985, 0.92), spaces=(0.36, 0.2), width_ratios=[1.15, 1],
        column_height=6.2, column_heights=[1.1, 1],
    )  # fmt: skip
    _draw_paths(panels["a"], data, sheet)
    _draw_worth(panels["b"], data)
    if sheet.on_paper:
        legend_below_all(figure, sheet, panels["b"], ncols=3, column=3)
    else:
        legend_above(panels["b"], ncols=3, fontsize=8)
    return figure


def _draw_paths(panel: Axes, data: HandTurns, sheet: Sheet) -> None:
    panel.set(title="tilt of the turning axis", xlabel="about the next axis, deg")
    panel.set(ylabel="about the one after it, deg", xlim=(-3.3, 3.3))
    panel.set_ylim(-4.0, 2.3 if sheet.narrow else 1.7)
    panel.set_aspect("equal")
    for name, (offset, side), style, marker, path, added in zip(
        _AXES, _WORDS, SERIES, _MARKERS, data.path / degree, data.added / degree, strict=False
    ):
        end = {"color": style["color"], "marker": marker, "markevery": [-1]}
        panel.plot(
            *added.T, **end, linestyle=":", markerfacecolor="white",
            label=f"turn about {name}, added up",
        )  # fmt: skip
        panel.plot(*path.T, **end, label=f"turn about {name}, as a rotation")
        panel.annotate(
            f"turn about {name},\nadded up", added[-1], offset, textcoords="offset points",
            fontsize="medium", ha=side,
        )  # fmt: skip
    panel.annotate(
        "as rotations:\nback to the start", (0.55, -0.45), (0.8, -1.6), fontsize="medium",
        arrowprops={"arrowstyle": "->", "color": GREY},
    )  # fmt: skip
    panel.plot(0, 0, color=BLACK, marker="+", markersize=11, label=GUIDE)


def _draw_worth(panel: Axes, data: HandTurns) -> None:
    sizes = _sizes(data)
    reach = min(2e-6, 0.5 * sizes.min()), max(1e-2, 2 * sizes.max())
    panel.set(title="errors by source", xscale="log", xlim=reach)
    panel.set(xlabel="part of a turn", ylim=(len(_ROWS) - 0.5, -0.5))
    panel.set_yticks(range(len(_ROWS)), _ROWS)
    panel.tick_params(axis="y", length=0)
    panel.grid(visible=False, axis="y")
    for border in np.arange(len(_ROWS) - 1) + 0.5:
        panel.axhline(border, color=GREY, linewidth=1.2 if border > len(SOURCES) - 1 else 0.6)
    for index, (style, marker) in enumerate(zip(SERIES[:3], _MARKERS, strict=True)):
        panel.plot(
            sizes[:, index], np.arange(len(_ROWS)) + 0.2 * (index - 1),
            color=style["color"], marker=marker, linestyle="none", label=f"about {_AXES[index]}",
        )  # fmt: skip
    panel.axvline(1 / 360, color=BLACK, linewidth=0.8, label=GUIDE)
    panel.text(
        1 / 335, 2, "one degree of heading", fontsize="medium", rotation=-90, va="center",
        bbox={"color": "white", "pad": 1},
    )  # fmt: skip
