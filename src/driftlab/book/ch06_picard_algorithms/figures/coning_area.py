"""Coning as an area: the sum of the increments comes back, but on its way it goes round something.

On a cone the integral of the rate runs round a circle. What the rotations add up to about the
cone's axis is the area inside. A computer that knows only the sums of the increments sees a polygon
in its place, and misses the slivers between the two.
"""

from typing import NamedTuple

import numpy as np
from matplotlib.patches import Polygon
from scipy.spatial.transform import Rotation

from driftlab.book.machinery.picture import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    SERIES,
    VERMILION,
    Picture,
    plain_axes,
    project,
)
from driftlab.checks import FloatArray, whole_number
from driftlab.motion.profiles import Coning

HALF_ANGLE = float(np.radians(25.0))
"""The cone is drawn this wide, so that it can be seen."""


class ConingArea(NamedTuple):
    """Areas are in units of the square of the circle's radius."""

    samples: int  # in one round
    cone: FloatArray  # (m, 3): the way of the third body axis
    circle: FloatArray  # (m, 2): integral of the rate across the cone's axis, rad
    corners: FloatArray  # (samples + 1, 2): the same, summed from increments
    circle_area: float
    polygon_area: float
    paired_area: float  # with two thirds of g1 × g2 added for each pair of samples


def compute(samples: int = 8) -> ConingArea:
    """One round on the cone, seen by a gyro triad that is read `samples` times, an even number."""
    if whole_number(samples, "samples", least=4) % 2:
        raise ValueError(f"samples: expected an even number, got {samples}.")
    motion = Coning(HALF_ANGLE, 1.0)
    fine = 24 * samples
    increments = motion.increments(1 / samples, samples)[:, :2]
    radius = np.sin(HALF_ANGLE)
    corners = _path(increments)
    # The chords of pairs make a polygon of half as many corners.
    pairs = increments[0::2] + increments[1::2]
    segments = (2 / 3) * _cross(increments[0::2], increments[1::2]).sum()
    third = Rotation.from_quat(motion.attitude(np.arange(fine + 1) / fine)).apply([0, 0, 1])
    return ConingArea(
        samples,
        third,
        _path(motion.increments(1 / fine, fine)[:, :2]),
        corners,
        float(np.pi),
        _area(corners) / radius**2,
        float(_area(_path(pairs)) + segments) / radius**2,
    )


def _path(increments: FloatArray) -> FloatArray:
    return np.concatenate([np.zeros((1, 2)), np.cumsum(increments, axis=0)])


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _area(closed: FloatArray) -> float:
    return 0.5 * float(_cross(closed[:-1], closed[1:]).sum())


def columns(data: ConingArea) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the corners of the polygon."""
    return {"x_rad": data.corners[:, 0], "y_rad": data.corners[:, 1]}


class ConingAreaPicture(Picture[ConingArea]):
    """The cone, the circle with the polygon, and one pair of samples."""

    size = (10.5, 4.0)

    def build(self) -> None:
        cone, round_, pair = self.figure.subplots(1, 3, gridspec_kw={"width_ratios": [0.8, 1, 1]})
        self.figure.subplots_adjust(0.01, 0.05, 0.985, 0.9, wspace=0.15)
        for panel, title in (
            (cone, "the third axis runs round"),
            (round_, "sum of the increments in a round"),
            (pair, "one pair of samples"),
        ):
            panel.set_title(title)
            panel.set_aspect("equal")
            panel.axis("off")
        plain_axes(cone, 1.2)
        cone.set_ylim(-0.35, 1.45)
        up = project(np.array([0.0, 0.0, 1.25]))
        cone.plot([0, up[0]], [0, up[1]], color=BLACK, linewidth=0.9, linestyle="-.")
        self.way = self.line(cone, **SERIES[0])
        self.sticks = [self.line(cone, color=GREY, linewidth=0.9) for _ in range(8)]
        self.slivers = Polygon(np.zeros((3, 2)), closed=True, color=ORANGE, alpha=0.6, linewidth=0)
        self.inside = Polygon(np.zeros((3, 2)), closed=True, color="white", linewidth=0)
        self.segment = Polygon(np.zeros((3, 2)), closed=True, color=ORANGE, alpha=0.6, linewidth=0)
        self.triangle = Polygon(
            np.zeros((3, 2)), closed=True, facecolor="none", edgecolor=BLUE, hatch="///"
        )
        for panel, patch in (
            (round_, self.slivers), (round_, self.inside), (pair, self.segment),
            (pair, self.triangle),
        ):  # fmt: skip
            panel.add_patch(patch)
            self.moving.append(patch)
        self.circle = self.line(round_, **SERIES[0], label="true")
        self.polygon = self.line(
            round_, color=VERMILION, marker="o", markersize=4, label="from samples"
        )
        self.arc = self.line(pair, **SERIES[0])
        self.chord = self.line(pair, color=VERMILION, marker="o", markersize=5)
        self.sides = self.line(pair, color=BLACK, marker="o", markersize=5, linewidth=1.2)
        round_.legend(loc="center")
        self.labels = [
            pair.annotate(text, (0, 0), ha="center", va="center", fontsize=12)
            for text in ("$g_1$", "$g_2$", r"$\gamma$")
        ]
        self.moving += self.labels
        reach = 1.1 * np.sin(HALF_ANGLE)
        round_.set(xlim=(-reach - np.sin(HALF_ANGLE), reach - np.sin(HALF_ANGLE)))
        round_.set(ylim=(-reach, reach))

    def update(self, data: ConingArea) -> None:
        self.way.set_data(*project(data.cone).T)
        for stick, tip in zip(
            self.sticks, project(data.cone[:: len(data.cone) // 8]), strict=False
        ):
            stick.set_data([0, tip[0]], [0, tip[1]])
        self.circle.set_data(*data.circle.T)
        self.polygon.set_data(*data.corners.T)
        self.slivers.set_xy(data.circle)
        self.inside.set_xy(data.corners)
        first, middle, last = data.corners[:3]
        arc = data.circle[: 2 * (len(data.circle) - 1) // data.samples + 1]
        self.segment.set_xy(arc)
        self.triangle.set_xy(data.corners[:3])
        self.arc.set_data(*arc.T)
        self.chord.set_data(*np.stack([first, last]).T)
        self.sides.set_data(*data.corners[:3].T)
        panel = self.arc.axes
        assert panel is not None
        low, high = arc.min(axis=0), arc.max(axis=0)
        margin = 0.25 * (high - low).max()
        panel.set_xlim(low[0] - margin, high[0] + margin)
        panel.set_ylim(low[1] - margin, high[1] + margin)
        centre = (first + middle + last) / 3
        for label, a, b in zip(
            self.labels, (first, middle, first), (middle, last, last), strict=True
        ):
            # Beside the middle of its side, on the far side of the triangle, clear of the arc.
            normal = np.array([b[1] - a[1], a[0] - b[0]]) / np.linalg.norm(b - a)
            outwards = normal * np.sign(normal @ (a - centre))
            label.set_position(tuple((a + b) / 2 + 0.75 * margin * outwards))
