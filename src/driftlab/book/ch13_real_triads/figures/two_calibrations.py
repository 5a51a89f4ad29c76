"""Two published calibrations of one record: two triads, drawn in both choices of body axes."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.constants import degree

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


@in_style
def draw(data: TwoCalibrations, sheet: Sheet) -> Figure:
    """A triad of accelerometers and one of gyros for each choice; then the residuals."""
    figure = Figure(figsize=(11.0, 4.6))
    *sheets, moves = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1, 1, 1.15]})
    figure.subplots_adjust(0.005, 0.13, 0.985, 0.9, wspace=0.12)
    for drawing, name, gyro, accelerometer in zip(
        sheets, TRIANGLES, data.published_gyro, data.published_accelerometer, strict=True
    ):
        plain_axes(drawing)
        drawing.set(xlim=(-0.32, 1.08), ylim=(-0.45, 1.2))
        drawing.set_title(name, loc="left")
        _draw_triad(drawing, np.zeros((3, 3)), "body axes", color=GREY, linewidth=1.0)
        _draw_triad(drawing, accelerometer, "accelerometers", color=BLUE)
        _draw_triad(drawing, gyro, "gyros", color=VERMILION, linestyle="--")
        for axis, tip in zip("xyz", project(1.2 * np.eye(3)), strict=True):
            drawing.text(*tip, axis, color=GREY, ha="center", va="center")
    turn = np.linalg.norm(data.rotation) / degree
    sheets[0].legend(loc="lower left", fontsize=9)
    sheets[1].text(
        -0.3, -0.36, f"the same two triads:\nthe body axes are turned by {turn:.2f}°",
        fontsize=10, va="center",
    )  # fmt: skip
    _draw_moves(moves, data)
    return figure


def _draw_triad(drawing: Axes, error: FloatArray, words: str, **style: Any) -> None:
    for index, tip in enumerate(project(np.eye(3) + MAGNIFIED * error)):
        label = None if index else words
        drawing.plot([0, tip[0]], [0, tip[1]], marker="o", markevery=[1], markersize=4,
                   label=label, **{"linewidth": 2.0, **style})  # fmt: skip


def _draw_moves(panel: Axes, data: TwoCalibrations) -> None:
    panel.set(title="gravity carried over a move", yscale="log", xlabel="move")
    panel.set(ylabel="angle left, deg", ylim=(0.1, 12), xlim=(0, 54))
    panel.set_xticks(range(0, 40, 10))
    number = np.arange(1, len(data.before) + 1)
    for angles, color, marker, words in (
        (data.before, GREY, "s", "before"), (data.after, VERMILION, "o", "calibrated")
    ):  # fmt: skip
        rms = np.sqrt((angles**2).mean()) / degree
        panel.plot(number, angles / degree, color=color, marker=marker, markersize=4,
                   linestyle="none")  # fmt: skip
        panel.plot([0, number[-1] + 1], [rms, rms], color=color, linewidth=1.2)
        panel.text(number[-1] + 2, rms, f"{words},\nrms {rms:.2g}°", va="center")
