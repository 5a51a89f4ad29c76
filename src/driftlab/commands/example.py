"""``python -m driftlab example``: a made-up log with known errors.

A unit lies still for a minute, is turned by hand from rest to rest, and comes back to where it was.
Rates and forces are those of its moments, so no formula of the package stands between the truth and
the log.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from io import StringIO
from pathlib import Path

import numpy as np
from scipy.constants import degree, g, hour, milli

from driftlab.checks import FloatArray
from driftlab.core.quaternion import conjugate, from_rotation_vector, multiply, rotate
from driftlab.earth import EARTH_RATE, gravity
from driftlab.imu import ImuErrors
from driftlab.motion.vehicle import smooth_step
from driftlab.quaternion import to_rotation_vector
from driftlab.recordings.recording import Recording

from .findings import (
    AXES,
    DEG_PER_HOUR,
    DEGREES,
    FORCES,
    SCALES,
    SMALL_ANGLES,
    Findings,
    Table,
    Unit,
)
from .integrate import attitude_of_angles
from .record import forces, moments, rates

EXAMPLE = "python -m driftlab example log.csv"
RATE = 50.0
LATITUDE = np.radians(59.9)
ANGLES = tuple(np.radians([40.0, 3.0, -2.0]))  # heading (to the East), pitch, roll at first
REST, POSE, MOVE = 60.0, 4.0, 2.0  # the long rest, a short one, and a move between two, s
# Moves as rotation vectors in body axes, degrees; one more leads back to the beginning.
TURNS = (
    *((90, 0, 0), (0, 90, 0), (0, 0, 90), (45, 0, 0), (0, 45, 0), (60, 60, 0), (0, -80, 50)),
    *((0, 0, 135), (90, 0, 0), (0, -60, 30), (-50, 0, 70), (90, 0, 0), (0, 90, 0), (40, 40, 90)),
    *((-90, 0, 0), (0, 120, 0)),
)
# The accelerometers' matrix is a triangle, so these are the body axes of a calibration as well.
ERRORS = ImuErrors(
    np.array([0.04, -0.06, 0.03]) * degree / hour,
    np.array([[0.004, -0.0012, 0.0008], [0.0015, -0.003, 0.001], [-0.0006, 0.0009, 0.002]]),
    np.array([4.0, -3.0, 2.0]) * milli * g,
    np.array([[0.003, 0.0, 0.0], [0.0007, -0.002, 0.0], [-0.0005, 0.0009, 0.001]]),
)
# Standard deviation of a sample, white: gyros, rad/s, and accelerometers, m/s^2.
NOISE = (2.0 * degree / hour, 0.1 * milli * g)
# What must be said of the log to any command.
OPTIONS = "--columns gx,gy,gz,ax,ay,az --units deg/s,g --time t,s"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the file that this command writes."""
    parser.add_argument("log", type=Path, help="the file to write")
    parser.add_argument("--force", action="store_true", help="overwrite a file that is there")


def example(seed: int = 1) -> Recording:
    """The record, rates and forces in axes FRD."""
    turns = [np.radians(turn) for turn in TURNS]
    start = attitude_of_angles(ANGLES)
    attitude = start
    for turn in turns:
        attitude = multiply(attitude, from_rotation_vector(turn))
    turns.append(to_rotation_vector(multiply(conjugate(attitude), start)))
    times = np.arange(round(RATE * (REST + len(turns) * (MOVE + POSE)))) / RATE
    attitudes, rate = np.tile(start, (len(times), 1)), np.zeros((len(times), 3))
    for number, turn in enumerate(turns):
        begin = REST + number * (MOVE + POSE)
        share = smooth_step(times, begin, MOVE)[:, np.newaxis]
        attitudes = multiply(attitudes, from_rotation_vector(share * turn))
        rate += _speed((times - begin) / MOVE)[:, np.newaxis] / MOVE * turn
    back = conjugate(attitudes)
    earth = EARTH_RATE * np.array([np.cos(LATITUDE), 0.0, -np.sin(LATITUDE)])  # North, East, Down
    pull = float(gravity(LATITUDE))
    force = rotate(back, np.array([0.0, 0.0, -pull]))
    rng = np.random.default_rng(seed)
    measured = []
    for true, error, bias, noise in (
        (rate + rotate(back, earth), ERRORS.gyro_error_matrix, ERRORS.gyro_bias, NOISE[0]),
        (force, ERRORS.accelerometer_error_matrix, ERRORS.accelerometer_bias, NOISE[1]),
    ):
        clean = true @ (np.eye(3) + error).T + bias
        measured.append(clean + noise * rng.standard_normal(clean.shape))
    gyro, accelerometer = measured
    return Recording(
        gyro,
        accelerometer,
        1 / RATE,
        "rates",
        axes="FRD",
        latitude=float(LATITUDE),
        gravity=pull,
        name="example",
    )


def _speed(part: FloatArray) -> FloatArray:
    """Derivative of `smooth_step` over a unit of time."""
    x = np.clip(part, 0.0, 1.0)
    return 30 * x**2 * (1 - x) ** 2


def as_log(record: Recording) -> str:
    """The record as a CSV in deg/s and g, as loggers write it."""
    rows = np.column_stack([moments(record), np.degrees(rates(record)), forces(record) / g])
    text = StringIO()
    np.savetxt(text, rows, "%.8g", ",", header="t,gx,gy,gz,ax,ay,az", comments="")
    return text.getvalue()


def _triad(name: str, unit: Unit) -> Iterator[tuple[str, FloatArray, Unit]]:
    """Errors of a triad, in the order of a calibration's table."""
    error = getattr(ERRORS, f"{name}_error_matrix")
    yield f"{name} bias x, y, z", getattr(ERRORS, f"{name}_bias"), unit
    yield f"{name} scale x, y, z", np.diag(error), SCALES[0]
    for place, axis in enumerate(AXES):
        others = [i for i in range(3) if i != place]
        names = " and ".join(AXES[i] for i in others)
        yield f"{name}s {names} feel of {axis}", error[others, place], SMALL_ANGLES[0]


def findings(record: Recording) -> Findings:
    """What was put into the log."""
    names = ("heading at first, from North to East", "pitch", "roll", "latitude")
    angles = [(name, x, DEGREES) for name, x in zip(names, (*ANGLES, LATITUDE), strict=True)]
    rows = tuple(
        (name, ", ".join(f"{x:.4g}" for x in np.atleast_1d(value) / unit.size), unit.name)
        for name, value, unit in (
            *angles,
            *_triad("gyro", DEG_PER_HOUR),
            *_triad("accelerometer", FORCES[0]),
        )
    )
    return Findings(
        f"A made-up log, {len(record)} rows at {RATE:g} Hz",
        (Table("What was put into it", ("", "value", "unit"), rows),),
        (
            f"The unit lies still for {REST:g} s, is turned {len(TURNS)} times by hand with rests "
            "between, and comes back. Columns: time t, s; rates gx, gy, gz, deg/s; forces ax, ay, "
            "az, g; body axes forward, right, down. The help of each other command ends with an "
            "example for this log: python -m driftlab calibrate --help.",
        ),
    )
