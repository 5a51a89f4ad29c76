"""Position over time, and the way on the map."""

import numpy as np
from matplotlib.ticker import MaxNLocator
from scipy.constants import nautical_mile

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import BLACK, GREY, GUIDE, SERIES, Picture, legend_above

REACHES = tuple(k * 10.0**power for power in range(-2, 5) for k in (1, 2, 5))
"""Of the axes, nautical miles."""
HOURS = (0.5, 1, 2, 4, 6, 8, 12, 14, 16, 24, 36, 48)
LINEAR = 400e3
"""Distance up to which linear equations may do, m: a sixteenth of the Earth's radius."""


class MissionPicture(Picture):
    """East and North over the hours, with and without Schuler's swing; and East against North."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", self.size, (0.08, 0.13, 0.985, 0.88), width_ratios=(1.5, 1.0), column_height=5.2,
            column_heights=(1, 1.4),
        )  # fmt: skip
        over_time, chart = panels["a"], panels["b"]
        self.over_time, self.chart = over_time, chart
        over_time.set(xlabel="time, hours", ylabel="position error, nmi")
        chart.set(title="the way on the map", xlabel="East, nmi", ylabel="North, nmi")
        chart.set_aspect("equal", adjustable="box")
        for axis in (chart.xaxis, chart.yaxis):
            axis.set_major_locator(MaxNLocator(4))
        over_time.axhline(0.0, color=BLACK, linewidth=0.8, label=GUIDE)
        for name, style in zip(("East", "North"), SERIES, strict=False):
            self.curve(over_time, "time", f"position, {name}", **style, label=name)
        slow = {"color": GREY, "linewidth": 1.4, "linestyle": ":"}
        self.curve(over_time, "time", "slow, East", **slow, label="without Schuler's swing")
        self.curve(over_time, "time", "slow, North", **slow, label="_")
        way = "position, East", "position, North"
        self.curve(chart, *way, color=SERIES[0]["color"], linewidth=1.3)
        begin, end = (5, 3.5) if self.sheet.on_paper else (8, 5)
        chart.plot(0.0, 0.0, color=BLACK, marker="s", markersize=begin, markerfacecolor="none",
                   linestyle="none", label="start")  # fmt: skip
        self.curve(chart, "end, East", "end, North", color=BLACK, marker="o", markersize=end,
                   linestyle="none", label="end")  # fmt: skip
        chart.legend(loc="upper right", fontsize="small" if self.sheet.on_paper else 8)
        self.too_far = self.words(
            over_time, transform=over_time.transAxes, ha="left", va="top",
            fontsize="medium" if self.sheet.on_paper else 9,
        )  # fmt: skip
        self.too_far.set_position((0.02, 0.97))
        legend_above(over_time, 3)

    def update(self, table: DataTable) -> None:
        self.show(table)
        far = np.linalg.norm(table.position, axis=0).max() > LINEAR
        between = "\n" if self.sheet.narrow else " "
        there = f"beyond {LINEAR / nautical_mile:.0f} nmi"
        beyond = f"{there}{between}the linear equations no longer hold"
        self.too_far.set_text(beyond if far else "")
        both = np.stack([table.shown("position"), table.shown("slow")])
        reach = np.abs(both).max()
        step = next((step for step in REACHES if reach <= step), REACHES[-1])
        hours = table.shown("time")[-1]
        last = next(step for step in HOURS if hours <= step)
        self.set_limits(self.over_time, "x", 0.0, last)
        self.set_reach(self.over_time, "y", both, (step,))
        for direction in "xy":
            self.set_limits(self.chart, direction, -step, step)
