"""One sensor error in a calibration by the 27-state filter: its error, and what the filter says.

`calibration_errors` shows all of them.
"""

from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import BLACK, SERIES, Picture, legend_above
from driftlab.calibration import TurntableTrial
from driftlab.motion.turntable import segments
from driftlab.quaternion import conjugate, rotate

BOTTOMS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
"""Where the axis of the sizes may begin."""


@cache
def pauses() -> list[tuple[float, float, str, str]]:
    """Return what the table does in the calibrations of the chapter.

    Of each pause its begin and end in minutes, the body axis that points up, with its sign, and the
    scheme's word for the rotation after it, empty after the last.
    """
    scheme = TurntableTrial().scheme
    row = segments(scheme, 1e-3)  # pauses and turns by turns
    ends = np.cumsum([segment.duration for segment in row]) / 60
    found = []
    for k, word in enumerate([*scheme.rotations.split(), ""]):
        up = rotate(conjugate(row[2 * k].attitude), [0.0, 0.0, 1.0])
        axis = int(np.abs(up).argmax())
        name = ("+" if up[axis] > 0 else "−") + "xyz"[axis]
        found.append((ends[2 * k] - scheme.dwell / 60, ends[2 * k], name, word))
    return found


def table_says(minute: float) -> str:
    """Return in words what the table does at a minute."""
    begun = [pause for pause in pauses() if pause[0] <= minute]
    _, end, up, rotation = begun[-1] if begun else pauses()[0]
    return f"rests, {up} up" if minute <= end else f"turns {rotation}"


class CalibrationRunPicture(Picture):
    """Size of the error beside three deviations, the error in deviations, and the table."""

    size = (10.5, 4.4)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab;cc", self.size, (0.06, 0.11, 0.985, 0.93), spaces=(0.14, 0.46),
            height_ratios=(1, 0.28 if self.sheet.on_paper else 0.17), column_height=5.4,
            column_heights=(1, 1, 0.36), page_height=3.9,
        )  # fmt: skip
        size, ratio, table = panels["a"], panels["b"], panels["c"]
        self.size_axes, self.ratio_axes, self.table_axes = size, ratio, table
        size.set(title="in deviations known before", yscale="log")
        words = "stated deviations" if self.sheet.on_paper else "deviations that the filter states"
        ratio.set(title=f"error, in {words}: inside ±3?", ylim=(-4.2, 4.2))
        for panel in (size, ratio):
            panel.set_xlim(0, 41)
            panel.set_xlabel("time, min", loc="right", labelpad=0)
        for bound in (-3, 3):
            ratio.axhline(bound, color=BLACK, linestyle="--", linewidth=1.2)
        table.set(xlim=(0, 41), ylim=(0, 1), xlabel="the table: which axis is up, and how it turns")
        table.set_yticks([])
        table.grid(visible=False)
        table.tick_params(labelbottom=False, bottom=False)
        self._say_what_the_table_does(table)
        self.curve(size, "time", "error_over_before", **SERIES[0], label="error")
        stated = "three deviations stated"
        self.curve(size, "time", "bound_over_before", **SERIES[1], label=stated)
        self.curve(ratio, "time", "error_over_deviation", **SERIES[0])
        self.marks = [
            self.line(panel, color=BLACK, linewidth=1.2, linestyle=(0, (2, 2)))
            for panel in (size, ratio, table)
        ]
        legend_above(size, 2)

    def _say_what_the_table_does(self, table: Axes) -> None:
        axis, turn = ("small", "small") if self.sheet.on_paper else (8, 6.5)
        upright = 90 if self.sheet.narrow else 0
        middle: dict[str, Any] = {"ha": "center", "va": "center"}
        for i, (begin, end, up, rotation) in enumerate(pauses()):
            face = ("#e4eef5", "#f6efe0")[i % 2]
            table.axvspan(begin, end, facecolor=face, edgecolor="none")
            table.text((begin + end) / 2, 0.7, up, fontsize=axis, **middle)
            table.text(end, 0.25, rotation, fontsize=turn, rotation=upright, **middle)

    def update(self, table: DataTable) -> None:
        self.show(table)
        least = 0.1 * table.bound_over_before.min()
        low = next((step for step in BOTTOMS if step <= least), BOTTOMS[-1])
        self.set_limits(self.size_axes, "y", low, 10.0)
        farthest = float(np.abs(table.error_over_deviation).max())
        reach = next((step for step in (3.3, 4.2, 6.0) if farthest <= step), 10.0)
        self.set_limits(self.ratio_axes, "y", -reach, reach)
        here = table.shown("moment")
        for mark, axes in zip(
            self.marks, (self.size_axes, self.ratio_axes, self.table_axes), strict=True
        ):
            mark.set_data([here, here], axes.get_ylim())
