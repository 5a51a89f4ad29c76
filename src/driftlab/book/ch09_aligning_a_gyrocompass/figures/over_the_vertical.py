"""A body turned right over: what its heading loses in the vertical, and what its attitude keeps."""

from typing import NamedTuple

import numpy as np

from driftlab.book.machinery.picture import SERIES, Picture
from driftlab.checks import FloatArray
from driftlab.frames import angles_from_attitude, attitude_from_angles
from driftlab.gyrocompass.alignment import align
from driftlab.motion.vehicle import sensed_at_rest
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle
from driftlab.vectors import wrap_angle

from .alignment_budget import DRIFT, LATITUDE, OFFSET

HEADING = float(np.radians(40.0))
RUNS = 400
SEED = 9
ANGLES: FloatArray = np.radians(np.arange(0.5, 180.0, 1.0))
"""How far the body has been turned about its right axis; the vertical is between two of them."""


class OverTheVertical(NamedTuple):
    """Over the angle of the turn about the right axis."""

    angles: FloatArray  # (n,), rad
    heading: FloatArray  # (n,), rad: of the true attitude
    roll: FloatArray  # (n,), rad
    heading_error: FloatArray  # (n,), rad: root mean square over random sensor errors
    roll_error: FloatArray  # (n,), rad
    attitude_error: FloatArray  # (n,), rad
    together_error: FloatArray  # (n,), rad: of heading + roll while the bow is nearer to Up


def compute() -> OverTheVertical:
    """Align the same bodies in all attitudes of a half turn, bow over the vertical."""
    rng = np.random.default_rng(SEED)
    size = (RUNS, 1, 3)
    drift = float(np.abs(DRIFT).max()) * rng.standard_normal(size)
    offset = float(np.abs(OFFSET).max()) * rng.standard_normal(size)
    over = ANGLES[:, np.newaxis] * np.array([0.0, 0.0, 1.0])
    attitude = multiply(attitude_from_angles(HEADING, 0.0, 0.0), from_rotation_vector(over))
    true = angles_from_attitude(attitude)
    rate, force = sensed_at_rest(attitude, LATITUDE)
    found = align(rate + drift, force + offset)

    def spread(gap: FloatArray) -> FloatArray:
        return np.asarray(np.sqrt(np.mean(wrap_angle(gap) ** 2, axis=0)))

    away = rotation_angle(multiply(found.attitude, conjugate(attitude)))
    return OverTheVertical(
        ANGLES,
        true.heading,
        true.roll,
        spread(found.heading - true.heading),
        spread(found.roll - true.roll),
        np.sqrt(np.mean(away**2, axis=0)),
        spread(found.heading + found.roll - true.heading - true.roll),
    )


def columns(data: OverTheVertical) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees."""
    names = ("angle", "heading", "roll", "heading_error", "roll_error", "attitude_error")
    table = {
        f"{name}_deg": np.degrees(row).round(7) for name, row in zip(names, data, strict=False)
    }
    return {**table, "heading_and_roll_error_deg": np.degrees(data.together_error).round(7)}


class OverTheVerticalPicture(Picture[OverTheVertical]):
    """The angles on the left, their errors on the right."""

    size = (10.5, 3.6)

    def build(self) -> None:
        left, right = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.07, 0.14, 0.985, 0.91, wspace=0.2)
        for panel in (left, right):
            panel.set(xlabel="turned about the right axis, degrees", xlim=(0, 180))
            panel.set_xticks([0, 30, 60, 90, 120, 150, 180])
        left.set(title="one smooth turn, told in angles", ylabel="degrees", ylim=(-190, 190))
        left.set_yticks([-180, -90, 0, 90, 180])
        right.set(title="errors after alignment, root mean square", ylabel="degrees")
        right.set(yscale="log", ylim=(0.05, 30))
        self.heading = self.line(left, **SERIES[0], label="heading")
        self.roll = self.line(left, **SERIES[1], label="roll")
        self.pitch = self.line(left, **SERIES[2], label="pitch")
        self.errors = [
            self.line(right, **style, label=label)
            for style, label in zip(
                (SERIES[0], SERIES[1], SERIES[3], SERIES[4]),
                ("heading", "roll", "heading + roll", "attitude"),
                strict=True,
            )
        ]
        left.legend(loc="lower left")
        right.legend(loc="upper left")

    def update(self, data: OverTheVertical) -> None:
        angles = np.degrees(data.angles)
        pitch = np.minimum(angles, 180 - angles)
        # Half a turn is both 180 and -180 degrees; the jump at the vertical is what matters.
        self.heading.set_data(angles, np.degrees(data.heading))
        self.roll.set_data(angles, np.abs(np.degrees(data.roll)))
        self.pitch.set_data(angles, pitch)
        rows = (data.heading_error, data.roll_error, data.together_error, data.attitude_error)
        for line, row in zip(self.errors, rows, strict=True):
            line.set_data(angles, np.degrees(row))
