"""A bent triad, the frames R and B, and the error over the turns; Larin (2.3)."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike
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
from driftlab.checks import FloatArray, finite_array, nonzero_vectors, whole_number
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.drift.systematic_drift import (
    drift_coefficient,
    drift_per_turn,
    principal_drifts,
)
from driftlab.quaternion import to_rotation_vector
from driftlab.triad import measured_rate

TURNS = 5
EXAGGERATION = 150
"""The triad is drawn with its misalignment this many times too large."""


class DriftHistory(NamedTuple):
    """Error over the turns, as the rotation vector from R to B."""

    turns: FloatArray  # (m,), in turns
    error: FloatArray  # (m, 3), rad: the full motion
    whole_turns: FloatArray  # (n,)
    snapshots: FloatArray  # (n, 3), rad: once a turn
    direction: FloatArray  # (3,)
    triad: FloatArray  # (3, 3), exaggerated sensitive axes
    worst_axis: FloatArray  # (3,)
    first_order_per_turn: float  # rad
    exact_per_turn: float  # rad
    worst_per_turn: float  # rad, about the worst axis


def compute(
    misalignment: ArrayLike, direction: ArrayLike, samples_per_turn: int = 60
) -> DriftHistory:
    """Turn a triad `TURNS` times about `direction` and watch the error.

    Parameters
    ----------
    misalignment : array_like, shape (3, 3)
    direction : array_like, shape (3,)
        Axis of the turns in body axes; only its direction counts.
    samples_per_turn : int
    """
    samples = whole_number(samples_per_turn, "samples_per_turn")
    n, _ = nonzero_vectors(direction, "direction")
    misalignment = finite_array(misalignment, "misalignment", 3, 3)
    measured = measured_rate(n, misalignment)
    # At unit rate, one turn takes 2 pi seconds.
    time = 2 * np.pi * np.arange(TURNS * samples + 1) / samples
    error = to_rotation_vector(error_quaternion(n, measured, time))
    coefficients, axes = principal_drifts(misalignment, exact=True)
    worst = np.abs(coefficients).argmax()
    return DriftHistory(
        time / (2 * np.pi),
        error,
        np.arange(TURNS + 1.0),
        error[::samples],
        n,
        np.eye(3) + EXAGGERATION * misalignment,
        axes[worst],
        float(2 * np.pi * drift_coefficient(n, misalignment)),
        float(drift_per_turn(n, misalignment)),
        float(2 * np.pi * coefficients[worst]),
    )


def columns(data: DriftHistory) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the rotation vector along the axis and across it."""
    along = data.error @ data.direction
    across = np.linalg.norm(data.error - along[:, np.newaxis] * data.direction, axis=-1)
    return {"turns": data.turns, "along_rad": along, "across_rad": across}


class DriftHistoryPicture(Picture[DriftHistory]):
    """Exaggerated triad, frames R and B at the end, and the error over `TURNS` turns.

    The limits hold everything that entries up to 2e-3 can do.
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
