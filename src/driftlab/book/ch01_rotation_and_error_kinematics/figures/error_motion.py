"""The error quaternion in time, by closed form and by a numerical integrator; Larin (1.4)."""

import numpy as np
from matplotlib.ticker import MaxNLocator

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture, legend_above
from driftlab.checks import FloatArray
from driftlab.quaternion import rotation_angle

from ..experiments import DURATION, ErrorMotion

COMPONENTS = (r"$\lambda_{1e}$", r"$\lambda_{2e}$", r"$\lambda_{3e}$", r"$\lambda_{0e}$")

ANGLES = (2.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0)
"""How far the axis of the angle may reach, degrees."""


def columns(data: ErrorMotion) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    names = ("error_1", "error_2", "error_3", "error_0")
    return {"time_s": data.time, **dict(zip(names, data.exact.T, strict=True))}


class ErrorMotionPicture(Picture[ErrorMotion]):
    """Four components, lines for the closed form and dots for the integrator; and the angle."""

    size = (10.5, 3.9)

    def build(self) -> None:
        axes, angle = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.065, 0.14, 0.985, 0.91, wspace=0.18)
        axes.set(title="components", xlabel="time, s", xlim=(0, DURATION), ylim=(-1.1, 1.1))
        angle.set(title="angle of the error, °", xlabel="time, s", xlim=(0, DURATION))
        angle.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 1.5, 2, 3, 5, 10]))
        self.angle_axes = angle
        self.lines, self.dots = [], []
        for name, style, marker in zip(COMPONENTS, SERIES, "osD^", strict=False):
            self.lines.append(self.line(axes, **style, label=name))
            dot = {"linestyle": "none", "marker": marker, "markersize": 3.0, "fillstyle": "none"}
            self.dots.append(self.line(axes, color=style["color"], **dot))
        self.dots[-1].set_label("integrator")
        legend_above(axes, 5)
        self.turns = self.line(angle, color=GREY, linewidth=1.0, linestyle=(0, (2, 2)))
        self.angle = self.line(angle, color=BLACK)
        self.once_a_turn = self.line(
            angle, color=BLACK, marker="o", linestyle="none", label="after each whole turn"
        )
        legend_above(angle, 1)

    def update(self, data: ErrorMotion) -> None:
        for i, (line, dot) in enumerate(zip(self.lines, self.dots, strict=True)):
            line.set_data(data.time, data.exact[:, i])
            dot.set_data(data.integrated_time, data.integrated[:, i])
        angle = np.degrees(rotation_angle(data.exact))
        self.set_reach(self.angle_axes, "y", angle, ANGLES)
        self.angle.set_data(data.time, angle)
        turns = np.arange(data.turn, DURATION, data.turn) if data.turn < DURATION else np.zeros(0)
        low, high = self.angle_axes.get_ylim()
        self.turns.set_data(
            np.repeat(turns, 3),
            np.tile([low, high, np.nan], len(turns)),
        )
        self.once_a_turn.set_data(turns, np.interp(turns, data.time, angle))
