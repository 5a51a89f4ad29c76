"""A bent triad, the frames R and B, and the error over the turns; Larin (2.3)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.spatial.transform import Rotation

from driftlab.book.machinery.picture import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    SERIES,
    VERMILION,
    Picture,
    plain_axes,
    project,
)
from driftlab.checks import FloatArray

from ..experiments import EXAGGERATION, TURNS, DriftHistory


def columns(data: DriftHistory) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the rotation vector along the axis and across it."""
    along = data.error @ data.direction
    across = np.linalg.norm(data.error - along[:, np.newaxis] * data.direction, axis=-1)
    return {"turns": data.turns, "along_rad": along, "across_rad": across}


class DriftHistoryPicture(Picture[DriftHistory]):
    """Exaggerated triad, frames R and B at the end, and the error over `TURNS` turns.

    The limits hold everything that entries up to `LARGEST_ENTRY` can do.
    """

    size = (10.5, 4.0)

    def build(self) -> None:
        grid = self.figure.add_gridspec(2, 3, width_ratios=[0.8, 0.8, 1.5], height_ratios=[2, 1])
        self.figure.subplots_adjust(0.01, 0.13, 0.985, 0.92, wspace=0.16, hspace=0.14)
        triad, frames = (self.figure.add_subplot(grid[:, i]) for i in (0, 1))
        history = self.figure.add_subplot(grid[0, 2])
        across = self.figure.add_subplot(grid[1, 2], sharex=history)
        for panel in (triad, frames):
            plain_axes(panel)
        triad.set_title(f"gyro axes, bent ×{EXAGGERATION}")
        frames.set_title(f"R and B after {TURNS} turns")
        history.set(title="rotation from R to B", ylabel="along axis, degrees")
        history.set(xlim=(0, TURNS), ylim=(-12, 12))
        history.tick_params(labelbottom=False)
        across.set(xlabel="turns", ylabel="across, arcmin", ylim=(0, 45))
        for panel in (triad, frames):
            for label, tip in zip(("$i_1$", "$i_2$", "$i_3$"), project(np.eye(3)), strict=True):
                panel.plot([0, tip[0]], [0, tip[1]], color=BLACK, linewidth=1.2)
                panel.text(1.12 * tip[0], 1.12 * tip[1], label, ha="center", va="center")
        bent = {"color": VERMILION, "linestyle": "--", "marker": "o", "markersize": 4}
        self.triad = self._three(triad, bent)
        self.frame_b = self._three(frames, bent)
        spin = {"color": BLUE, "linestyle": "-.", "linewidth": 1.2}
        self.axis = [self.line(panel, **spin) for panel in (triad, frames)]
        self.worst = self.line(triad, color=GREEN, linestyle=":", linewidth=1.2)
        self.axis[0].set_label("axis of the turns")
        self.worst.set_label("worst axis")
        self.triad[0].set_label("gyro axes")
        triad.legend(loc="lower left", ncols=2, bbox_to_anchor=(0.02, -0.16))
        self.frame_b[0].set_label("B, as computed")
        frames.legend(loc="lower center", bbox_to_anchor=(0.5, -0.16))
        self.along = self.line(history, **SERIES[0], label="full motion")
        self.first = self.line(
            history, color=GREY, linestyle="--", label=r"first order, $2\pi\rho$ a turn"
        )
        self.snapshots = self.line(
            history,
            color=BLACK,
            linestyle="none",
            marker="o",
            clip_on=False,
            label="seen once a turn",
        )
        self.across = self.line(across, **SERIES[0])
        self.across_snapshots = self.line(
            across, color=BLACK, linestyle="none", marker="o", clip_on=False
        )
        history.legend(loc="lower left", ncols=2)

    def _three(self, panel: Axes, style: dict[str, object]) -> list[Line2D]:
        return [self.line(panel, **style) for _ in range(3)]

    def update(self, data: DriftHistory) -> None:
        apparent = Rotation.from_rotvec(data.snapshots[-1]).apply(np.eye(3))
        for lines, axes in ((self.triad, data.triad), (self.frame_b, apparent)):
            for line, tip in zip(lines, project(axes), strict=True):
                line.set_data([0, tip[0]], [0, tip[1]])
        spin = project(np.stack([-1.15 * data.direction, 1.15 * data.direction]))
        for line in self.axis:
            line.set_data(*spin.T)
        self.worst.set_data(*project(np.stack([-data.worst_axis, data.worst_axis])).T)
        table = columns(data)
        self.along.set_data(data.turns, np.degrees(table["along_rad"]))
        across = 60 * np.degrees(table["across_rad"])
        self.across.set_data(data.turns, across)
        self.across_snapshots.set_data(data.whole_turns, across[:: (len(across) - 1) // TURNS])
        self.snapshots.set_data(data.whole_turns, np.degrees(data.snapshots @ data.direction))
        ends = np.array([0.0, data.whole_turns[-1]])
        self.first.set_data(ends, np.degrees(data.first_order_per_turn * ends))
