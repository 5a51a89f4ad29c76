"""The choice of body axes in a plane; Wu Fig. 2, (43), (44)."""

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from driftlab.book.machinery.picture import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    VERMILION,
    Picture,
    plain_axes,
)
from driftlab.checks import FloatArray
from driftlab.triad import body_frame_rotation


class PlaneAxes(NamedTuple):
    """Angles counted from the given axes x and y, positive from x to y, rad."""

    gyros: FloatArray  # (2,): of the x and of the y gyro
    accelerometers: FloatArray  # (2,)
    usual: float  # of the usual body axes, x along the x gyro
    averaged: float  # of the averaged body axes


def compute(
    gyros: tuple[float, float] = (0.30, 0.10), accelerometers: tuple[float, float] = (0.20, -0.12)
) -> PlaneAxes:
    """Body axes for two gyros and two accelerometers that lean by these angles in rad."""
    x, y = gyros
    triad = np.array([[np.cos(x), np.sin(x), 0], [-np.sin(y), np.cos(y), 0], [0, 0, 1]])
    usual, averaged = (
        np.arctan2(turn[0, 1], turn[0, 0])
        for frame in ("upper triangle", "averaged")
        for turn in [body_frame_rotation(triad - np.eye(3), None, frame)]
    )
    return PlaneAxes(np.array(gyros), np.array(accelerometers), float(usual), float(averaged))


def columns(data: PlaneAxes) -> dict[str, list[float] | list[str]]:
    """Columns of the figure's CSV."""
    return {
        "direction": [
            "x gyro", "y gyro", "x accelerometer", "y accelerometer", "usual axes", "averaged axes"
        ],
        "angle_rad": [*data.gyros, *data.accelerometers, data.usual, data.averaged],
    }  # fmt: skip


class PlaneAxesPicture(Picture[PlaneAxes]):
    """Instruments and given axes; then the same gyros with both choices of body axes."""

    size = (10.5, 2.9)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.01, 0.02, 1.0, 0.9, wspace=0.02)
        titles = ("four instruments, given axes", "usual: x along the x gyro", "averaged")
        for panel, title in zip(self.panels, titles, strict=True):
            plain_axes(panel, reach=1.3)
            panel.set(xlim=(-0.62, 1.98), ylim=(-0.35, 1.45), title=title)

    def update(self, data: PlaneAxes) -> None:
        given, usual, averaged = self.panels
        for panel, angle in ((given, 0.0), (usual, data.usual), (averaged, data.averaged)):
            beside = (0.09, 0.09 if panel is given else -0.09)
            _pair(panel, np.full(2, angle), ("$x$", "$y$"), 1.3, color=BLACK)
            _pair(panel, data.gyros, ("x gyro", "y gyro"), 1.0, beside, color=BLUE, linestyle="--")
        _pair(
            given,
            data.accelerometers,
            ("x acc.", "y acc."),
            0.8,
            (-0.02, -0.02),
            color=VERMILION,
            linestyle=":",
        )
        for panel, angle in ((usual, data.usual), (averaged, data.averaged)):
            _pair(panel, np.zeros(2), ("", ""), 0.75, color=GREY)
            arc = np.linspace(0, angle, 30)
            panel.plot(0.62 * np.cos(arc), 0.62 * np.sin(arc), color=GREEN)
            panel.text(0.68, 0.04, f"{angle:.2f} rad")


def _pair(
    panel: Axes,
    angles: FloatArray,
    labels: tuple[str, str],
    length: float,
    asides: tuple[float, float] = (0.0, 0.0),
    **style: Any,
) -> None:
    """Draw an x and a y direction, turned by two angles; labels beyond the tips, or beside them."""
    rights = (0.0, np.pi / 2)
    for angle, right, label, aside in zip(angles, rights, labels, asides, strict=True):
        along = np.array([np.cos(angle + right), np.sin(angle + right)])
        tip = length * along
        panel.plot([0, tip[0]], [0, tip[1]], **style)
        x, y = tip + (aside * np.array([-along[1], along[0]]) if aside else 0.05 * along)
        place = "right" if aside > 0 else ("center" if right and not aside else "left")
        panel.text(x, y, label, ha=place, va="center")
