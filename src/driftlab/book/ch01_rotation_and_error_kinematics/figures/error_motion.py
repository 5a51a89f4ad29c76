"""The error quaternion in time, by closed form and by a numerical integrator; Larin (1.4)."""

from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from driftlab.book.machinery.picture import BLACK, GREY, GUIDE, SERIES, Picture, legend_above
from driftlab.checks import FloatArray

from ..experiments import ErrorMotion

COMPONENTS = (r"$\lambda_{1e}$", r"$\lambda_{2e}$", r"$\lambda_{3e}$", r"$\lambda_{0e}$")

ANGLES = (2.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0)
"""How far the axis of the angle may reach, degrees."""


def columns(data: ErrorMotion) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    names = ("error_1", "error_2", "error_3", "error_0")
    integrated = (f"integrated_{name}" for name in names)
    angle = np.degrees(data.angle)
    return {
        "time_s": data.time,
        **dict(zip(names, data.exact.T, strict=True)),
        "integrated_time_s": data.integrated_time,
        **dict(zip(integrated, data.integrated.T, strict=True)),
        "angle_deg": angle,
        "whole_turn_s": data.whole_turns,
        "whole_turn_angle_deg": np.interp(data.whole_turns, data.time, angle),
    }


class ErrorMotionPicture(Picture[ErrorMotion]):
    """Four components, lines for the closed form and dots for the integrator; and the angle."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", self.size, (0.065, 0.14, 0.985, 0.91), spaces=(0.18, 0.2), column_height=5.0
        )
        axes, angle = panels["a"], panels["b"]
        axes.set(title="components", xlabel="time, s", ylim=(-1.1, 1.1))
        angle.set(title="angle of the error, °", xlabel="time, s")
        self.components_axes = axes
        angle.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 1.5, 2, 3, 5, 10]))
        self.angle_axes = angle
        self.lines, self.dots = [], []
        for name, style, marker in zip(COMPONENTS, SERIES, "osD^", strict=False):
            self.lines.append(self.line(axes, **style, label=name))
            dot: dict[str, Any] = {"linestyle": "none", "marker": marker, "fillstyle": "none"}
            dot["markersize"] = 2.2 if self.sheet.on_paper else 3.0
            self.dots.append(self.line(axes, color=style["color"], **dot))
        self.dots[-1].set_label("integrator")
        legend_above(axes, 5)
        self.turns = self.line(angle, color=GREY, linewidth=1.0, linestyle=(0, (2, 2)), label=GUIDE)
        self.angle = self.line(angle, color=BLACK)
        self.once_a_turn = self.line(
            angle, color=BLACK, marker="o", linestyle="none", label="after each whole turn"
        )
        legend_above(angle, 1)

    def update(self, data: ErrorMotion) -> None:
        for i, (line, dot) in enumerate(zip(self.lines, self.dots, strict=True)):
            line.set_data(data.time, data.exact[:, i])
            dot.set_data(data.integrated_time, data.integrated[:, i])
        for axes in (self.components_axes, self.angle_axes):
            self.set_limits(axes, "x", 0.0, data.time[-1])
        angle, turns = np.degrees(data.angle), data.whole_turns
        self.set_reach(self.angle_axes, "y", angle, ANGLES)
        self.angle.set_data(data.time, angle)
        low, high = self.angle_axes.get_ylim()
        self.turns.set_data(
            np.repeat(turns, 3),
            np.tile([low, high, np.nan], len(turns)),
        )
        self.once_a_turn.set_data(turns, np.interp(turns, data.time, angle))
