"""The error quaternion in time, by closed form and by a numerical integrator; Larin (1.4)."""

from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import BLACK, GREY, GUIDE, SERIES, Picture, legend_above

from ..experiments import COMPONENTS

ANGLES = (2.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0)
"""How far the axis of the angle may reach, degrees."""


class ErrorMotionPicture(Picture):
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
        for name, style, marker in zip(COMPONENTS, SERIES, "osD^", strict=False):
            label = rf"$\lambda_{{{name}e}}$"
            self.curve(axes, "time", f"error, {name}", **style, label=label)
            dot: dict[str, Any] = {"linestyle": "none", "marker": marker, "fillstyle": "none"}
            dot |= {"color": style["color"], "markersize": 2.2 if self.sheet.on_paper else 3.0}
            dots = self.curve(axes, "integrated_time", f"integrated, {name}", **dot)
        dots.set_label("integrator")
        legend_above(axes, 5)
        self.turns = self.line(angle, color=GREY, linewidth=1.0, linestyle=(0, (2, 2)), label=GUIDE)
        self.curve(angle, "time", "angle", color=BLACK)
        dot = {"color": BLACK, "marker": "o", "linestyle": "none"}
        self.curve(angle, "whole_turns", "angle_after_turns", **dot, label="after each whole turn")
        legend_above(angle, 1)

    def update(self, table: DataTable) -> None:
        self.show(table)
        for axes in (self.components_axes, self.angle_axes):
            self.set_limits(axes, "x", 0.0, table.time[-1])
        self.set_reach(self.angle_axes, "y", table.shown("angle"), ANGLES)
        turns, ends = table.whole_turns, [*self.angle_axes.get_ylim(), np.nan]
        self.turns.set_data(np.repeat(turns, 3), np.tile(ends, len(turns)))
