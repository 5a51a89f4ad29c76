"""A bent triad, the frames R and B, and the error over the turns; Larin (2.3)."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.spatial.transform import Rotation

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    SERIES,
    VERMILION,
    Picture,
    legend_below_all,
    plain_axes,
    project,
)

AXES = ("axis of the turns", "worst axis")
REACHES_ALONG = (0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0, 12.0, 20.0, 50.0, 100.0, 180.0)
REACHES_ACROSS = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1.1e4)
"""How far the axes may reach, degrees and minutes of arc."""


MOST_TURNED = np.radians(40.0)
"""How far frame B may be drawn off R."""
FACTORS = (200, 100, 50, 20, 10, 5, 2, 1)
"""How many times larger than it is the error of B may be drawn."""


class DriftHistoryPicture(Picture):
    """Exaggerated triad, frames R and B at the end, and the error over the turns."""

    size = (10.5, 4.0)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "abc;abd", self.size, (0.005, 0.12, 0.985, 0.93), spaces=(0.13, 0.3),
            width_ratios=(0.85, 0.85, 1.4), height_ratios=(2, 1), column="ab;cc;dd",
            column_height=5.6, column_heights=(1, 1.2, 0.6), page_height=3.3,
        )  # fmt: skip
        triad, frames, history, across = (panels[letter] for letter in "abcd")
        across.sharex(history)
        self.titles = [panel.set_title("") for panel in (triad, frames)]
        self.history, self.across_axes = history, across
        for panel in (triad, frames):
            plain_axes(panel)
            panel.set(xlim=(-0.95, 1.1), ylim=(-0.9, 1.2))
        history.set(title="along the axis: the slope is the drift", ylabel="error, °")
        history.tick_params(labelbottom=False)
        across.set(title="across the axis: back after each turn", ylabel="error, ′")
        across.set_xlabel("turns", loc="left")
        for panel in (triad, frames):
            for label, tip in zip(("$i_1$", "$i_2$", "$i_3$"), project(np.eye(3)), strict=True):
                panel.plot([0, tip[0]], [0, tip[1]], color=BLACK, linewidth=1.2)
                panel.text(1.12 * tip[0], 1.12 * tip[1], label, ha="center", va="center")
        bent: dict[str, Any] = {"color": VERMILION, "linestyle": "--", "marker": "o"}
        bent["markersize"] = 2.5 if self.sheet.on_paper else 4
        self.triad = self._three(triad, bent)
        self.frame_b = self._three(frames, bent)
        spin = {"color": BLUE, "linestyle": "-.", "linewidth": 1.2}
        self.axis = [self.line(panel, **spin) for panel in (triad, frames)]
        self.worst = self.line(triad, color=GREEN, linestyle=":", linewidth=1.8)
        self.factor = self.words(frames, color=BLACK, fontsize="small")
        self.factor.set_position((-0.9, -1.02))  # below every line
        dots = {"color": BLACK, "linestyle": "none", "marker": "o", "clip_on": False}
        once: dict[str, Any] = {"every": "samples_per_turn", **dots}
        over_turns = [
            self.curve(history, "turns", "along", **SERIES[0], label="full motion"),
            self.curve(
                history, "whole_turns", "first_order", color=GREY, linestyle="--",
                label="first order",
            ),
            self.curve(history, "turns", "along", **once, label="once a turn"),
        ]  # fmt: skip
        self.curve(across, "turns", "across", **SERIES[0])
        self.curve(across, "turns", "across", **once)
        in_space = [self.axis[0], self.worst]
        if self.sheet.on_paper:
            words = [*(line.get_label() for line in over_turns), *AXES]
            handles = [*over_turns, *in_space]
            legend_below_all(self.figure, self.sheet, handles, 5, labels=words, columnspacing=1.1)
        else:
            style: dict[str, Any] = {"ncols": 3, "frameon": False, "columnspacing": 1.1}
            self.figure.legend(
                handles=over_turns, loc="lower right", bbox_to_anchor=(0.99, -0.015), **style
            )
            self.figure.legend(
                in_space, AXES, loc="lower left", bbox_to_anchor=(0.0, -0.015), **style
            )

    def _three(self, panel: Axes, style: dict[str, object]) -> list[Line2D]:
        return [self.line(panel, **style) for _ in range(3)]

    def update(self, table: DataTable) -> None:
        self.show(table)
        last = table.whole_turns[-1]
        lean, turns = f"lean ×{table.exaggeration:g}", f"after {last:g} turns"
        between = "\n" if self.sheet.on_paper else " "
        words = (f"the gyros' axes,{between}{lean}", f"R, and B as computed,{between}{turns}")
        for title, said in zip(self.titles, words, strict=True):
            if title.get_text() != said:
                title.set_text(said)
                self.rescaled = True
        self.set_limits(self.history, "x", 0.0, last)
        self.set_reach(self.history, "y", table.shown("along"), REACHES_ALONG)
        self.set_reach(self.across_axes, "y", table.shown("across"), REACHES_ACROSS)
        angle = np.linalg.norm(table.error[-1])
        factor = next((factor for factor in FACTORS if factor * angle <= MOST_TURNED), 1)
        self.factor.set_text(f"error of B drawn ×{factor}")
        apparent = Rotation.from_rotvec(factor * table.error[-1]).apply(np.eye(3))
        for lines, axes in ((self.triad, table.triad), (self.frame_b, apparent)):
            for line, tip in zip(lines, project(axes), strict=True):
                line.set_data([0, tip[0]], [0, tip[1]])
        spin = project(np.stack([-table.direction, table.direction]))
        for line in self.axis:
            line.set_data(*spin.T)
        self.worst.set_data(*project(np.stack([-table.worst_axis, table.worst_axis])).T)
