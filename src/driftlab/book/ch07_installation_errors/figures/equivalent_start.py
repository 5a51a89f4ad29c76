"""A misaligned triad against an ideal one that starts wrong; Wu (16)-(36), not linearised."""

from typing import NamedTuple

import numpy as np

from driftlab.attitude.integration import integrate
from driftlab.book.machinery.picture import GREY, SERIES, Picture
from driftlab.calibration.error_model import attitude_error
from driftlab.checks import FloatArray
from driftlab.imu import PERFECT, TYPICAL, Unit, measure
from driftlab.motion.turntable import Record, Scheme, simulate
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    rotation_angle,
)
from driftlab.strapdown import Navigation, at_rest, navigate
from driftlab.triad import misalignment_vector, split
from driftlab.vectors import cross_matrix

LATITUDE = float(np.radians(37.5))
INTERVAL = 0.05
"""Seconds between two increments."""
SCHEME = Scheme("+90X +90Y +90Z " * 8, dwell=5.0)
"""Quarter turns that add up to whole turns about a diagonal, again and again."""
DIRECTION: FloatArray = np.array([2.0, -1.0, 2.0]) / 3
"""Axis of the misalignments in the right panel."""
SIZES: FloatArray = np.logspace(-5, -1, 17)
"""Their sizes, rad."""


class EquivalentStart(NamedTuple):
    """Histories over the scheme, and what is left of second order."""

    times: FloatArray  # (n,), s
    tilts: FloatArray  # (4, n), rad: scale, non-orthogonality, misalignment; the total derivative
    speeds: FloatArray  # (4, n), m/s: gyros turned, accelerometers, both, both with the start
    sizes: FloatArray  # (m,), rad
    left: FloatArray  # (3, m): attitude of a skew triad, of a turned one, velocity of two skew ones


def compute() -> EquivalentStart:
    """Run the units through the scheme."""
    record = simulate(SCHEME, LATITUDE, INTERVAL, whole=2)
    steps = len(record.angle_increments) // 2
    times: FloatArray = 2 * INTERVAL * np.arange(1.0, steps + 1)
    parts = split(TYPICAL.gyro_error)
    tilts = [np.linalg.norm(_tilt(record, part), axis=-1) for part in parts]
    vector = misalignment_vector(TYPICAL.gyro_error)
    there = rotate(_inertial(record), vector)
    begins = rotate(record.attitude[0], vector)
    tilts.append(np.linalg.norm(there - begins, axis=-1))
    turned = cross_matrix(vector)
    none = np.zeros((3, 3))
    right = record.attitude[0]
    with_axes = multiply(right, from_rotation_vector(-vector))
    speeds = [
        np.linalg.norm(_navigated(record, gyro, accelerometer, start).velocity, axis=-1)
        for gyro, accelerometer, start in (
            (turned, none, right),
            (none, turned, right),
            (turned, turned, right),
            (turned, turned, with_axes),
        )
    ]
    left = np.array([_left(record, size * DIRECTION) for size in SIZES]).T
    return EquivalentStart(times, np.array(tilts), np.array(speeds), SIZES, left)


def _inertial(record: Record) -> FloatArray:
    """True attitude (n, 4) against axes that do not turn with the Earth."""
    return integrate(record.angle_increments, "two-step-4", start=record.attitude[0])


def _tilt(record: Record, gyro_error: FloatArray) -> FloatArray:
    """Attitude error (n, 3) in inertial axes of a computer that starts right."""
    measured, _ = measure(record, PERFECT._replace(gyro_error=gyro_error))
    found = integrate(measured, "two-step-4", start=record.attitude[0])
    return attitude_error(found, _inertial(record))


def _navigated(
    record: Record, gyro_error: FloatArray, accelerometer_error: FloatArray, start: FloatArray
) -> Navigation:
    unit = Unit(np.zeros(3), gyro_error, np.zeros(3), accelerometer_error)
    return navigate(at_rest(LATITUDE, start), *measure(record, unit), INTERVAL)


def _left(record: Record, vector: FloatArray) -> tuple[float, float, float]:
    """How far apart the two units of the chapter are at the end, in three comparisons."""
    start = record.attitude[0]
    turn = from_rotation_vector(vector)
    # An ideal unit that starts turned, seen in axes turned back.
    begins = multiply(start, turn)
    ideal = integrate(record.angle_increments, "two-step-4", start=begins)[-1]
    expected = multiply(ideal, conjugate(turn))
    gaps = []
    for matrix in (cross_matrix(vector), rotate(turn, np.eye(3)).T - np.eye(3)):
        measured, _ = measure(record, PERFECT._replace(gyro_error=matrix))
        found = integrate(measured, "two-step-4", start=start)[-1]
        gaps.append(float(rotation_angle(multiply(conjugate(expected), found))))
    skew = cross_matrix(vector)
    moved = _navigated(record, skew, skew, multiply(start, conjugate(turn)))
    return gaps[0], gaps[1], float(np.linalg.norm(moved.velocity[-1]))


def columns(data: EquivalentStart) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the right panel."""
    names = ("skew_triad_rad", "turned_triad_rad", "two_skew_triads_m_s")
    # Rounding is not the same everywhere: what a turned triad leaves is nothing else, and a
    # velocity inherits it from positions of millions of metres.
    rounded = (left.round(digits) for left, digits in zip(data.left, (10, 10, 5), strict=True))
    return {"size_rad": data.sizes, **dict(zip(names, rounded, strict=True))}


class EquivalentStartPicture(Picture[EquivalentStart]):
    """Attitude error and velocity error over time, and what the first order leaves out."""

    size = (10.5, 4.0)

    def build(self) -> None:
        tilt, speed, left = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.06, 0.3, 0.985, 0.91, wspace=0.27)
        tilt.set(title="attitude error", xlabel="time, minutes", ylabel="arc seconds")
        speed.set(title="velocity error", xlabel="time, minutes", ylabel="m/s")
        left.set(title="left by first order", xscale="log", yscale="log", ylim=(1e-17, 1e2))
        left.set(xlabel="misalignment, rad", ylabel="rad, or m/s")
        left.plot(SIZES, 1e-3 * SIZES**2, color=GREY, linewidth=0.8)
        left.text(SIZES[-1], 3e-8, "slope 2", color=GREY, ha="right")
        tilt_labels = ("scale", "non-orthogonality", "misalignment", "$C\\kappa - C(0)\\kappa$")
        self.tilts = [
            self.line(tilt, **style, label=label)
            for label, style in zip(tilt_labels, SERIES, strict=False)
        ]
        self.tilts[3].set(linewidth=3.5, alpha=0.5)
        speed_labels = ("gyros turned", "accelerometers", "both", "both and the start")
        self.speeds = [
            self.line(speed, **style, label=label)
            for label, style in zip(speed_labels, SERIES, strict=False)
        ]
        left_labels = ("attitude, skew", "attitude, turned", "velocity, skew")
        self.left = [
            self.line(left, **style, marker=marker, markersize=4, label=label)
            for label, style, marker in zip(left_labels, SERIES, "os^", strict=False)
        ]
        for panel in (tilt, speed, left):
            panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2)
        self.panels = tilt, speed, left

    def update(self, data: EquivalentStart) -> None:
        minutes = data.times / 60
        for line, values in zip(self.tilts, 3600 * np.degrees(data.tilts), strict=True):
            line.set_data(minutes, values)
        for line, values in zip(self.speeds, data.speeds, strict=True):
            line.set_data(minutes, values)
        for line, values in zip(self.left, data.left, strict=True):
            line.set_data(data.sizes, np.maximum(values, 1e-17))
        for panel in self.panels[:2]:
            panel.relim()
            panel.autoscale_view()
