"""A ship's gyrocompass for two hours: its errors, and the paper's formula for them."""

import numpy as np
from matplotlib.axes import Axes
from scipy.constants import minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import BLACK, GUIDE, SERIES, Picture, legend_above
from driftlab.book.scenarios import DURATION, SPEED_UP, TURN

DEGREES = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 25.0, 75.0, 200.0)
MINUTES = (0.5, 1.0, 2.0, 5.0, 15.0, 75.0, 1000.0)
"""How far the axes may reach."""


def shade_manoeuvres(panel: Axes) -> None:
    """Shade the times, in minutes, at which the ship gathers way and turns."""
    for begin, length in (SPEED_UP, TURN):
        panel.axvspan(
            begin / minute, (begin + length) / minute, color="#ececec", zorder=0, label=GUIDE
        )


class OperationPicture(Picture):
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
        broad = {"color": SERIES[0]["color"], "linewidth": wide, "alpha": 0.6}
        fine = {"color": BLACK, "linewidth": thin}
        for panel, name, style, label in (
            (heading, "heading_error", broad, "simulated"),
            (heading, "formula", fine, "formula"),
            (halves, "speed_error", SERIES[3], "speed"),
            (tilt, "tilt_north", SERIES[0], "about North"),
            (tilt, "tilt_east", SERIES[1], "about East"),
            (halves, "yaw_error", SERIES[2], r"yaw $\psi$"),
            (halves, "compass_angle_error", SERIES[4], r"compass $\Psi_K$"),
        ):
            self.curve(panel, "time", name, **style, label=label)
        for panel in self.panels:
            if self.sheet.on_paper:
                panel.legend(loc="best", fontsize="small", handlelength=1.6)
            else:
                legend_above(
                    panel, 3, handlelength=1.4, columnspacing=0.7, handletextpad=0.3, fontsize=8
                )

    def update(self, table: DataTable) -> None:
        self.show(table)
        for panel, steps in zip(self.panels, (DEGREES, MINUTES, DEGREES), strict=True):
            drawn = [np.asarray(line.get_ydata()) for line in panel.get_lines()]
            self.set_reach(panel, "y", drawn, steps)
