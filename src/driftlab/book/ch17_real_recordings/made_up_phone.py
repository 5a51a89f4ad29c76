"""A log that nobody has measured: a phone turned by hand, for who has no log of his own yet.

Twelve turns on a table: about each axis two in one sense and two in the other, from a rest against
a stop to the next. In between the phone is put on another side.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from driftlab.checks import FloatArray
from driftlab.earth import earth_rate
from driftlab.motion.vehicle import smooth_step
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotate

LATITUDE = np.radians(51.5)
INTERVAL = 0.01
"""Between samples, s."""
REST, TURN, MOVE = 4.0, 9.0, 3.0
"""How long a rest lasts, a whole turn, and a move to another side, s."""
TRIAD_ERROR = np.array(
    [[0.0062, 0.0090, -0.0040], [-0.0070, -0.0115, 0.0060], [0.0110, 0.0030, 0.0041]]
)
BIAS = np.radians([0.31, -0.52, 0.18])
NOISE = np.radians(0.07)
"""White, of a sample, rad/s."""
STOP_ERROR = np.radians(0.15)
"""Standard deviation of where the stop is met, rad."""

TREMOR = np.radians(0.15)
"""How far a hand trembles while it turns the phone, rad, a few times a second."""

HEADER = ("Time (s)", *(f"Gyroscope {axis} (rad/s)" for axis in "xyz"))
"""As the app phyphox writes it."""

_UP_TO_Y, _Y_TO_X = (np.pi / 2, 0), (np.pi / 2, 2)
"""Moves, as an angle and a body axis: until the second axis points up, then until the first."""


def made_up_phone(seed: int = 6) -> tuple[FloatArray, FloatArray]:
    """Return times (n,) in s and what the gyros say (n, 3) in rad/s."""
    rng = np.random.default_rng(seed)
    plan: list[tuple[float, int, float]] = []
    for axis, move in ((2, None), (1, _UP_TO_Y), (0, _Y_TO_X)):
        if move:
            plan.append((*move, MOVE))
        at = rng.normal(0.0, STOP_ERROR, 5)
        senses = np.array([1, 1, -1, -1]) * 2 * np.pi
        lasts = TURN * rng.uniform(0.9, 1.2, 4)
        plan += [(angle, axis, t) for angle, t in zip(senses + np.diff(at), lasts, strict=True)]
    total = REST + sum(seconds + REST for *_, seconds in plan)
    times = INTERVAL * np.arange(round(total / INTERVAL), dtype=np.float64)
    rates, attitude = np.zeros((len(times), 3)), np.tile([0.0, 0.0, 0.0, 1.0], (len(times), 1))
    begin = REST
    for angle, axis, seconds in plan:
        about = np.eye(3)[axis]
        done = smooth_step(times, begin, seconds)
        trembles = np.sin(2 * np.pi * (rng.uniform(3, 6) * times + rng.uniform()))
        turned = angle * done + TREMOR * 4 * done * (1 - done) * trembles
        rates += np.gradient(turned, INTERVAL)[:, np.newaxis] * about
        attitude = multiply(attitude, from_rotation_vector(turned[:, np.newaxis] * about))
        begin += seconds + REST
    rates += rotate(conjugate(attitude), earth_rate(LATITUDE))
    noise = rng.normal(0.0, NOISE, rates.shape)
    said: FloatArray = rates @ (np.eye(3) + TRIAD_ERROR).T + BIAS + noise
    return times, said


def made_up_log(seed: int = 6, folder: Path | None = None) -> Path:
    """Write the log as a phone would, into a folder or a new temporary one; return its path."""
    path = Path(mkdtemp(prefix="driftlab-") if folder is None else folder, "made-up-phone.csv")
    times, rates = made_up_phone(seed)
    header = ",".join(f'"{name}"' for name in HEADER)
    table = np.column_stack([times, rates])
    np.savetxt(path, table, "%.9E", ",", header=header, comments="", encoding="utf-8")
    return path
