"""What one bent triad leaves of motions that come back, each made several times."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

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

from ..experiments import MotionHistory

VIEW = (-15.0, 30.0)
"""Azimuth and elevation from which none of the ways is seen edge on, degrees."""
BESIDE = ((-0.18, 0.06), (0.0, 0.13), (-0.12, 0.0))
"""From each stick to its number, clear of the ways."""
THIN = 3
"""Of the places of a motion, so many are one drawn one."""
CENTRED: dict[str, Any] = {"ha": "center", "va": "center"}


def columns(data: dict[str, MotionHistory]) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: each motion, thinned, and the ends of its first order."""
    motions = next(iter(data.values())).motions
    ends = motions[[0, -1]]
    names = {name: name.replace(" ", "_") for name in data}
    return {
        "motions": motions[::THIN],
        **{f"{names[name]}_arcmin": _arcmin(each.angle)[::THIN] for name, each in data.items()},
        "first_order_motions": ends,
        **{
            f"{names[name]}_first_order_arcmin": _arcmin(each.first_order) * ends
            for name, each in data.items()
        },
    }


def _arcmin(angle: ArrayLike) -> FloatArray:
    return 60 * np.degrees(np.asarray(angle, float))


@in_style
def draw(data: dict[str, MotionHistory], sheet: Sheet) -> Figure:
    """Way of the third axis in each motion, and the error with its first order."""
    figure, panels = sheet.mosaic(
        "abe;cde", (10.0, 4.4), (0.005, 0.12, 0.985, 0.92), spaces=(0.12, 0.15),
        width_ratios=(1, 1, 3), column="ab;cd;ee", column_height=5.8, column_heights=(1, 1, 1.4),
        page_height=3.6,
    )  # fmt: skip
    errors = panels["e"]
    table = columns(data)
    motions, ends = table["motions"], table["first_order_motions"]
    errors.set(title="rotation from R to B", xlabel="motions", ylabel="angle, arc minutes")
    errors.set(xlim=ends)
    letters = "medium" if sheet.on_paper else 9
    dot = 2.5 if sheet.on_paper else 4
    outline = np.linspace(0, 2 * np.pi, 100)
    for place, style, (name, history) in zip("abcd", SERIES, data.items(), strict=False):
        track = history.track[history.motions <= 1][::3]
        drawing = panels[place]
        plain_axes(drawing, reach=1.15)
        drawing.set_title(name)
        drawing.plot(np.cos(outline), np.sin(outline), color=GREY, linewidth=0.8)
        for number, tip in enumerate(project(np.eye(3), *VIEW)):
            drawing.plot([0, tip[0]], [0, tip[1]], color=BLACK, linewidth=0.8)
            x, y = 0.55 * tip + BESIDE[number]
            drawing.text(x, y, f"{number + 1}", fontsize=letters, **CENTRED)
        drawing.plot(
            *project(track, *VIEW).T, color=style["color"], linewidth=1.3 if sheet.on_paper else 2
        )
        drawing.plot(*project(track[0], *VIEW), color=BLACK, marker="o", markersize=dot)
        drawing.text(0, 1.1, "start", fontsize=letters, **CENTRED)
        angle = table[f"{name.replace(' ', '_')}_arcmin"]
        errors.plot(motions, angle, **style, label=name)
        errors.plot(ends, _arcmin(history.first_order) * ends, color=GREY, linewidth=0.9)
        back = motions % 1 == 0
        errors.plot(
            motions[back],
            angle[back],
            color=BLACK,
            linestyle="none",
            marker="o",
            markersize=dot,
            clip_on=False,
        )
    errors.plot([], [], color=GREY, linewidth=0.9, label="first order")
    errors.set_ylim(bottom=0)
    errors.legend(loc="upper left")
    return figure
