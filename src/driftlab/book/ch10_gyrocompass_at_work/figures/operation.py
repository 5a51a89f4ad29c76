"""A ship's gyrocompass for two hours: its errors, and the paper's formula for them."""

import numpy as np
from matplotlib.axes import Axes
from scipy.constants import arcminute, minute

from driftlab.book.machinery.picture import BLACK, GUIDE, SERIES, Picture, legend_above
from driftlab.book.scenarios import DURATION, SPEED_UP, TURN
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import HeadingErrors

DEGREES = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 25.0, 75.0, 200.0)
MINUTES = (0.5, 1.0, 2.0, 5.0, 15.0, 75.0, 1000.0)
"""How far the axes may reach."""


def columns(data: HeadingErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    return {
        "time_min": data.times / minute,
        "heading_error_deg": np.degrees(data.heading_error),
        "formula_deg": np.degrees(data.formula.heading),
        "speed_error_deg": np.degrees(data.speed_error),
        "tilt_north_arcmin": data.tilt[:, 0] / arcminute,
        "tilt_east_arcmin": data.tilt[:, 1] / arcminute,
        "yaw_error_deg": np.degrees(data.yaw_error),
        "compass_angle_error_deg": np.degrees(data.compass_error),
    }


def shade_manoeuvres(panel: Axes) -> None:
    """Shade the times, in minutes, at which the ship gathers way and turns."""
    for begin, length in (SPEED_UP, TURN):
        panel.axvspan(
            begin / minute, (begin + length) / minute, color="#ececec", zorder=0, label=GUIDE
        )


class OperationPicture(Picture[HeadingErrors]):
    """Heading error, tilts of the horizon, and the two halves of the heading error."""

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "abc", (10.5, 3.9), (0.06, 0.14, 0.985, 0.91), column_height=5.6, page_height=2.8
        )
        heading, tilt, halves = self.panels = tuple(panels.values())
        wide, thin = (2.0, 0.7) if self.sheet.on_paper else (3.0, 1.0)
        for panel in self.panels:
            panel.set(xlabel="time, min", xlim=(0, DURATION / minute))
            panel.set_xticks(range(0, 121, 20))
            shade_manoeuvres(panel)
        heading.set(title="heading error, °")
        tilt.set(title="tilt, ′")
        halves.set(title="parts, °")
        self.error = self.line(heading, color=SERIES[0]["color"], linewidth=wide, alpha=0.6,
                               label="simulated")  # fmt: skip
        self.formula = self.line(heading, color=BLACK, linewidth=thin, label="formula")
        self.speed_error = self.line(halves, **SERIES[3], label="speed")
        self.north = self.line(tilt, **SERIES[0], label="about North")
        self.east = self.line(tilt, **SERIES[1], label="about East")
        self.yaw = self.line(halves, **SERIES[2], label=r"yaw $\psi$")
        self.compass = self.line(halves, **SERIES[4], label=r"compass $\Psi_K$")
        for panel in self.panels:
            if self.sheet.on_paper:
                panel.legend(loc="best", fontsize="small", handlelength=1.6)
            else:
                legend_above(
                    panel, 3, handlelength=1.4, columnspacing=0.7, handletextpad=0.3, fontsize=8
                )

    def update(self, data: HeadingErrors) -> None:
        minutes = data.times / minute
        heading, tilt, halves = self.panels
        self.set_reach(
            heading,
            "y",
            [np.degrees(data.heading_error), np.degrees(data.formula.heading)],
            DEGREES,
        )
        self.set_reach(tilt, "y", data.tilt / arcminute, MINUTES)
        parts = [data.yaw_error, data.compass_error, data.speed_error]
        self.set_reach(halves, "y", np.degrees(parts), DEGREES)
        self.error.set_data(minutes, np.degrees(data.heading_error))
        self.formula.set_data(minutes, np.degrees(data.formula.heading))
        self.speed_error.set_data(minutes, np.degrees(data.speed_error))
        self.north.set_data(minutes, data.tilt[:, 0] / arcminute)
        self.east.set_data(minutes, data.tilt[:, 1] / arcminute)
        self.yaw.set_data(minutes, np.degrees(data.yaw_error))
        self.compass.set_data(minutes, np.degrees(data.compass_error))
