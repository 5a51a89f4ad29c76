"""What one bent triad leaves of motions that come back, each made several times."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import (
    BLACK,
    GREY,
    SERIES,
    in_style,
    plain_axes,
    project,
)
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import REPEATS, MotionHistory

VIEW = (-15.0, 30.0)
"""Azimuth and elevation from which none of the ways is seen edge on, degrees."""
BESIDE = ((-0.18, 0.06), (0.0, 0.13), (-0.12, 0.0))
"""From each stick to its number, clear of the ways."""
CENTRED: dict[str, Any] = {"ha": "center", "va": "center"}


def columns(data: dict[str, MotionHistory]) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: every sixth place of each motion."""
    motions = next(iter(data.values())).motions[::6]
    angles = {f"{name.replace(' ', '_')}_rad": history.angle[::6] for name, history in data.items()}
    return {"motions": motions, **angles}


@in_style
def draw(data: dict[str, MotionHistory], sheet: Sheet) -> Figure:
    """Way of the third axis in each motion, and the error with its first order."""
    figure = Figure(figsize=(10.0, 4.4))
    grid = figure.add_gridspec(2, 3, width_ratios=[1, 1, 3])
    figure.subplots_adjust(0.005, 0.12, 0.985, 0.92, wspace=0.12, hspace=0.15)
    errors = figure.add_subplot(grid[:, 2])
    errors.set(title="rotation from R to B", xlabel="motions", ylabel="angle, arc minutes")
    errors.set(xlim=(0, REPEATS))
    ends = np.array([0, REPEATS])
    outline = np.linspace(0, 2 * np.pi, 100)
    for place, style, (name, history) in zip(np.ndindex(2, 2), SERIES, data.items(), strict=False):
        track = history.track[history.motions <= 1][::3]
        drawing = figure.add_subplot(grid[place])
        plain_axes(drawing, reach=1.15)
        drawing.set_title(name)
        drawing.plot(np.cos(outline), np.sin(outline), color=GREY, linewidth=0.8)
        for number, tip in enumerate(project(np.eye(3), *VIEW)):
            drawing.plot([0, tip[0]], [0, tip[1]], color=BLACK, linewidth=0.8)
            x, y = 0.55 * tip + BESIDE[number]
            drawing.text(x, y, f"{number + 1}", fontsize=9, **CENTRED)
        drawing.plot(*project(track, *VIEW).T, color=style["color"], linewidth=2)
        drawing.plot(*project(track[0], *VIEW), color=BLACK, marker="o", markersize=4)
        drawing.text(0, 1.1, "start", fontsize=9, **CENTRED)
        errors.plot(history.motions, 60 * np.degrees(history.angle), **style, label=name)
        errors.plot(ends, 60 * np.degrees(history.first_order) * ends, color=GREY, linewidth=0.9)
        back = np.flatnonzero(history.motions % 1 == 0)
        errors.plot(
            history.motions[back],
            60 * np.degrees(history.angle[back]),
            color=BLACK,
            linestyle="none",
            marker="o",
            markersize=4,
            clip_on=False,
        )
    errors.plot([], [], color=GREY, linewidth=0.9, label="first order")
    errors.set_ylim(bottom=0)
    errors.legend(loc="upper left")
    return figure
