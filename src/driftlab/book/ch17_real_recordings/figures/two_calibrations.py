"""Two published calibrations of one record: two triads, drawn in both choices of body axes."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLUE, GREY, VERMILION, plain_axes, project
from driftlab.checks import FloatArray

from ..experiments import TRIANGLES

MAGNIFIED = 8
"""By which factor errors are drawn."""


@from_table
def draw(drawing: Drawing) -> None:
    """A triad of accelerometers and one of gyros for each choice; then the residuals."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "abc", (11.0, 4.6), (0.005, 0.13, 0.985, 0.9), spaces=(0.12, 0.2),
        width_ratios=[1, 1, 1.15], column="ab;cc", column_height=4.6, column_heights=[1, 1],
    )  # fmt: skip
    triads = panels["a"], panels["b"]
    for panel, name, gyro, accelerometer in zip(
        triads, TRIANGLES, table.published_gyro, table.published_accelerometer, strict=True
    ):
        plain_axes(panel)
        panel.set(xlim=(-0.32, 1.08), ylim=(-0.72 if sheet.narrow else -0.45, 1.2))
        panel.set_title(name, loc="left")
        _draw_triad(panel, np.zeros((3, 3)), "body axes", color=GREY, linewidth=0.8)
        _draw_triad(panel, accelerometer, "accelerometers", color=BLUE)
        _draw_triad(panel, gyro, "gyros", color=VERMILION, linestyle="--")
        for axis, (x, y) in zip("xyz", project(1.2 * np.eye(3)), strict=True):
            panel.text(x, y, axis, color=GREY, ha="center", va="center")
    turn = f"{np.degrees(np.linalg.norm(table.rotation)):.2f}°"
    if sheet.on_paper:
        drawing.figure.legend(
            *triads[0].get_legend_handles_labels(), loc="outside upper left", ncols=3
        )
        words = f"the same triads;\nbody axes turned\nby {turn}"
    else:
        triads[0].legend(loc="lower left", fontsize=9)
        words = f"the same two triads:\nthe body axes are turned by {turn}"
    triads[1].text(-0.3, -0.57 if sheet.narrow else -0.36, words, va="center")
    _draw_moves(panels["c"], drawing)


def _draw_triad(panel: Axes, error: FloatArray, words: str, **style: Any) -> None:
    for index, tip in enumerate(project(np.eye(3) + MAGNIFIED * error)):
        label = None if index else words
        panel.plot([0, tip[0]], [0, tip[1]], marker="o", markevery=[1], markersize=4,
                   label=label, **style)  # fmt: skip


def _draw_moves(panel: Axes, drawing: Drawing) -> None:
    panel.set(title="gravity carried over a move", yscale="log", xlabel="move")
    panel.set(ylabel="angle left, deg", ylim=(0.1, 12), xlim=(0, 54))
    panel.set_xticks(range(0, 40, 10))
    for name, color, marker in (("before", GREY, "s"), ("calibrated", VERMILION, "o")):
        drawing.curve(panel, "move", name, color=color, marker=marker, markersize=4,
                      linestyle="none", label=name)  # fmt: skip
        drawing.curve(panel, "rms_over_moves", f"{name}_rms", color=color, linewidth=1.2,
                      label=f"{name}, root mean square")  # fmt: skip
        rms, place = drawing.table.shown(f"{name}_rms")[0], drawing.table.move[-1] + 2
        panel.text(place, rms, f"{name},\nrms {rms:.2g}°", va="center")
