"""Two published calibrations of one record: two triads, drawn in both choices of body axes."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree

from driftlab.book.machinery.arrays_table import to_columns
from driftlab.book.machinery.picture import (
    BLUE,
    GREY,
    VERMILION,
    in_style,
    plain_axes,
    project,
)
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import TRIANGLES, TwoCalibrations

MAGNIFIED = 8
"""By which factor errors are drawn."""


def columns(data: TwoCalibrations) -> dict[str, Any]:
    """Columns of the figure's CSV: what is drawn, and beside it all numbers of the experiment."""
    moves = np.arange(1, len(data.before) + 1)
    sides = {"before": data.before, "calibrated": data.after}
    return {
        "move": moves,
        **{f"{name}_deg": angles / degree for name, angles in sides.items()},
        "rms_over_moves": [0, len(moves) + 1],
        **{f"{name}_rms_deg": [_rms(angles)] * 2 for name, angles in sides.items()},
        **to_columns(data),
    }


def _rms(angles: FloatArray) -> float:
    """Root mean square in degrees."""
    return float(np.sqrt((angles**2).mean()) / degree)


@in_style
def draw(data: TwoCalibrations, sheet: Sheet) -> Figure:
    """A triad of accelerometers and one of gyros for each choice; then the residuals."""
    figure, panels = sheet.mosaic(
        "abc", (11.0, 4.6), (0.005, 0.13, 0.985, 0.9), spaces=(0.12, 0.2),
        width_ratios=[1, 1, 1.15], column="ab;cc", column_height=4.6, column_heights=[1, 1],
    )  # fmt: skip
    drawings = panels["a"], panels["b"]
    for drawing, name, gyro, accelerometer in zip(
        drawings, TRIANGLES, data.published_gyro, data.published_accelerometer, strict=True
    ):
        plain_axes(drawing)
        drawing.set(xlim=(-0.32, 1.08), ylim=(-0.72 if sheet.narrow else -0.45, 1.2))
        drawing.set_title(name, loc="left")
        _draw_triad(drawing, np.zeros((3, 3)), "body axes", color=GREY, linewidth=0.8)
        _draw_triad(drawing, accelerometer, "accelerometers", color=BLUE)
        _draw_triad(drawing, gyro, "gyros", color=VERMILION, linestyle="--")
        for axis, (x, y) in zip("xyz", project(1.2 * np.eye(3)), strict=True):
            drawing.text(x, y, axis, color=GREY, ha="center", va="center")
    turn = f"{np.linalg.norm(data.rotation) / degree:.2f}°"
    if sheet.on_paper:
        figure.legend(*drawings[0].get_legend_handles_labels(), loc="outside upper left", ncols=3)
        words = f"the same triads;\nbody axes turned\nby {turn}"
    else:
        drawings[0].legend(loc="lower left", fontsize=9)
        words = f"the same two triads:\nthe body axes are turned by {turn}"
    drawings[1].text(-0.3, -0.57 if sheet.narrow else -0.36, words, va="center")
    _draw_moves(panels["c"], data)
    return figure


def _draw_triad(drawing: Axes, error: FloatArray, words: str, **style: Any) -> None:
    for index, tip in enumerate(project(np.eye(3) + MAGNIFIED * error)):
        label = None if index else words
        drawing.plot([0, tip[0]], [0, tip[1]], marker="o", markevery=[1], markersize=4,
                   label=label, **style)  # fmt: skip


def _draw_moves(panel: Axes, data: TwoCalibrations) -> None:
    number = np.arange(1, len(data.before) + 1)
    panel.set(title="gravity carried over a move", yscale="log", xlabel="move")
    panel.set(ylabel="angle left, deg", ylim=(0.1, 12), xlim=(0, 54))
    panel.set_xticks(range(0, 40, 10))
    for angles, color, marker, words in (
        (data.before, GREY, "s", "before"), (data.after, VERMILION, "o", "calibrated")
    ):  # fmt: skip
        rms = _rms(angles)
        panel.plot(number, angles / degree, color=color, marker=marker, markersize=4,
                   linestyle="none", label=words)  # fmt: skip
        panel.plot([0, number[-1] + 1], [rms, rms], color=color, linewidth=1.2,
                   label=f"{words}, root mean square")  # fmt: skip
        panel.text(number[-1] + 2, rms, f"{words},\nrms {rms:.2g}°", va="center")
