"""The smallest fine alignment: a Kalman filter for the channel that makes the heading."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE

PULL = 9.81
"""Gravity, m/s^2."""
STEP = 1.0
"""Between two measurements, s."""
PRIOR = (1.0, 0.01, 0.1)
"""Standard deviations of velocity, tilt and heading at the start: m/s, rad, rad."""


class Trial(NamedTuple):
    """Headings of many filters."""

    found: float  # standard deviation of their errors, rad
    stated: float  # what the filter states, rad


def fine_alignment_trial(
    facing: ArrayLike,
    sway: float,
    drift: float,
    walk: float,
    latitude: float,
    runs: int = 1000,
    seed: int = 98,
) -> Trial:
    """Let filters find North from zero velocity, one measurement per second.

    Which way the box faces is 1, or -1 after half a turn, at each second (n,). The sway is the
    noise of the velocity, m/s, the drift the standard deviation of each East gyro's bias, rad/s,
    the walk its angle random walk, rad/sqrt(s).
    """
    sign, rng = np.asarray(facing, float), np.random.default_rng(seed)
    own = drift * rng.standard_normal(runs)
    noise = walk / np.sqrt(STEP) * rng.standard_normal((len(sign), runs))
    felt = sign[:, np.newaxis] * own + noise
    tilt = STEP * np.cumsum(felt, axis=0)
    seen = PULL * STEP * np.cumsum(tilt - STEP * felt / 2, axis=0)
    seen += sway * rng.standard_normal(seen.shape)
    level = float(EARTH_RATE * np.cos(latitude))
    error, stated = _filtered(seen, sign, sway, max(drift, 1e-15) / level, walk, level)
    return Trial(float(error.std()), stated)


def _filtered(
    velocity: FloatArray, sign: FloatArray, sway: float, turned: float, walk: float, level: float
) -> tuple[FloatArray, float]:
    """Heading errors (runs,) of filters that see level velocities (n, runs); their deviation."""
    x = np.zeros((4, velocity.shape[1]))  # velocity, tilt, heading, drift over the level rate
    P = np.diag([*PRIOR, turned]) ** 2
    pushed = np.array([PULL * STEP / 2, 1.0, 0.0, 0.0])
    kick = walk**2 * STEP * np.outer(pushed, pushed)
    fall, creep = PULL * level * STEP**2 / 2, level * STEP
    for seen, s in zip(velocity, sign, strict=True):
        F = np.array(
            [[1, PULL * STEP, fall, s * fall], [0, 1, creep, s * creep], [0, 0, 1, 0], [0, 0, 0, 1]]
        )
        x, P = F @ x, F @ P @ F.T + kick
        gain = P[:, 0] / (P[0, 0] + sway**2)
        x, P = x + np.outer(gain, seen - x[0]), P - np.outer(gain, P[0])
    return x[2], float(np.sqrt(P[2, 2]))
