"""What each sensor error does to the heading of an aligned compass: by term, and exactly."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree, g, hour, milli

from driftlab.book.machinery.picture import BLACK, SERIES, Picture
from driftlab.checks import FloatArray, finite_array, finite_number
from driftlab.frames import attitude_from_angles
from driftlab.gyrocompass.alignment import (
    align,
    alignment_attitude_error,
    alignment_errors,
)
from driftlab.motion.vehicle import sensed_at_rest
from driftlab.quaternion import conjugate, multiply, rotate, rotation_angle
from driftlab.vectors import wrap_angle

LATITUDE = float(np.radians(51.5))
"""Saratov, the authors' town; their paper names no place."""
DRIFT: FloatArray = np.array([0.02, 0.03, 0.03]) * degree / hour
OFFSET: FloatArray = np.array([1.5, 1.0, -1.5]) * milli * g
HEADING, PITCH, ROLL = (float(angle) for angle in np.radians([40.0, 30.0, 10.0]))
TERMS = (
    "east gyro",
    "east acc., tan pitch",
    "north acc., tan pitch",
    "east acc., tan latitude",
    "sum, first order",
    "exact",
)
STEPS = (0.5, 2.0, 10.0, 50.0, 180.0)
"""How far the axes may reach, degrees."""


class AlignmentBudget(NamedTuple):
    """The heading error of one compass, and of the same compass turned to all headings."""

    bars: FloatArray  # (6,), rad: the terms, their sum, and the exact error
    pitch: tuple[float, float]  # rad: first order and exact
    roll: tuple[float, float]
    latitude: tuple[float, float]
    attitude: tuple[float, float]  # rad: angle of the rotation from true to computed
    heading: float  # rad
    headings: FloatArray  # (n,), rad
    exact: FloatArray  # (n,), rad
    first_order: FloatArray  # (n,), rad


def compute(
    latitude: float = LATITUDE,
    heading: float = HEADING,
    pitch: float = PITCH,
    roll: float = ROLL,
    drift: ArrayLike = DRIFT,
    offset: ArrayLike = OFFSET,
) -> AlignmentBudget:
    """Budget of a compass with errors `drift`, `offset` (3,) in body axes forward, up, right."""
    drifts, offsets = finite_array(drift, "drift", 3), finite_array(offset, "offset", 3)
    place = finite_number(latitude, "latitude")
    headings = np.radians(np.arange(-180.0, 180.1, 5.0))
    every = np.append(headings, finite_number(heading, "heading"))
    vertical = abs(finite_number(pitch, "pitch")) > np.radians(89.9)
    attitude = attitude_from_angles(every, pitch, roll)
    rate, force = sensed_at_rest(attitude, place)
    true, found = align(rate, force), align(rate + drifts, force + offsets)
    local = rotate(attitude, drifts), rotate(attitude, offsets)
    # In a vertical body heading and roll have no errors of their own; the attitude has.
    formula = alignment_errors(every, 0.0 if vertical else pitch, place, *local)
    gaps = [wrap_angle(a - b) for a, b in zip(found, true, strict=True)]
    if vertical:
        nothing = np.full_like(every, np.nan)
        formula = formula._replace(
            heading=nothing, roll=nothing, heading_terms=np.full((len(every), 4), np.nan)
        )
        gaps[0] = gaps[2] = nothing
    turned = alignment_attitude_error(place, local[0][-1], local[1][-1])
    return AlignmentBudget(
        np.append(formula.heading_terms[-1], [formula.heading[-1], gaps[0][-1]]),
        (float(formula.pitch[-1]), float(gaps[1][-1])),
        (float(formula.roll[-1]), float(gaps[2][-1])),
        (float(formula.latitude[-1]), float(gaps[3][-1])),
        (
            float(np.linalg.norm(turned)),
            float(rotation_angle(multiply(found.attitude[-1], conjugate(attitude[-1])))),
        ),
        float(heading),
        headings,
        gaps[0][:-1],
        formula.heading[:-1],
    )


def columns(data: AlignmentBudget) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the right panel."""
    return {
        "heading_deg": np.degrees(data.headings).round(6),
        "first_order_deg": np.degrees(data.first_order).round(9),
        "exact_deg": np.degrees(data.exact).round(9),
    }


class AlignmentBudgetPicture(Picture[AlignmentBudget]):
    """Bars by term on the left, the error over all headings on the right."""

    size = (10.5, 3.7)

    def build(self) -> None:
        left, right = self.figure.subplots(1, 2, width_ratios=(1, 1.15))
        self.figure.subplots_adjust(0.155, 0.19, 0.97, 0.91, wspace=0.2)
        self.left, self.right = left, right
        rows = -np.arange(len(TERMS))
        left.set_yticks(rows, TERMS)
        left.set(title="heading error by term", xlabel="degrees")
        left.set_ylim(-len(TERMS) + 0.4, 0.6)
        left.axvline(0, color=BLACK, linewidth=0.8)
        left.axhline(-3.5, color=BLACK, linewidth=0.8, linestyle=":")
        styles = [*(SERIES[0],) * 4, SERIES[1], SERIES[4]]
        self.bars = left.barh(rows, np.zeros(len(TERMS)), 0.6)
        for bar, style in zip(self.bars, styles, strict=True):
            bar.set_color(style["color"])
            self.moving.append(bar)
        right.set(title="the same errors at other headings", xlabel="heading, degrees")
        right.set(ylabel="heading error, degrees", xlim=(-180, 180))
        right.set_xticks(
            [-180, -90, 0, 90, 180], ["South", "−90\nEast", "North", "90\nWest", "South"]
        )
        self.first_order = self.line(right, **SERIES[1], label="first order")
        self.exact = self.line(right, color=BLACK, linewidth=0.9, label="exact")
        self.here = self.line(
            right, color=BLACK, marker="o", linestyle="none", label="this heading"
        )
        right.legend(loc="upper right", ncols=3)

    def update(self, data: AlignmentBudget) -> None:
        for bar, value in zip(self.bars, np.degrees(data.bars), strict=True):
            bar.set_width(np.nan_to_num(value))
        shown = np.degrees([*data.bars, *data.exact, *data.first_order])
        self.set_reach(self.left, "x", shown, STEPS)
        self.set_reach(self.right, "y", shown, STEPS)
        degrees = np.degrees(data.headings)
        self.first_order.set_data(degrees, np.degrees(data.first_order))
        self.exact.set_data(degrees, np.degrees(data.exact))
        self.here.set_data([np.degrees(data.heading)], [np.degrees(data.bars[-1])])
