"""The ways on which a compass is tested: at the quay, gathering way, in a quick turn, at sea.

How the ship rolls and how hard it speeds up are taken from a draft of ISO 22090-1 of the year 2000,
6.6 and 5.3.3; the turn is that of IMO A.821(19), 4.2.3, to the letter.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.constants import degree, g, minute

from driftlab.earth import EARTH_RADIUS
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.vehicle import vehicle_trajectory

REST, SWING = 1 * minute, 2 * np.pi * float(np.sqrt(EARTH_RADIUS / g))
"""Before each manoeuvre, and Schuler's period, s."""
BRAKING = 2.0
"""How hard a craft changes its speed, m/s^2."""
_TURNING = 20 * degree  # rad/s
_ROLLING = (20 * degree, 6.0), (10 * degree, 10.0), (5 * degree, 15.0)  # roll, pitch, yaw; s
_SWAYING = 1.0, 10.0  # m/s^2 and s


@lru_cache(maxsize=8)
def quay(latitude: float, duration: float, step: float) -> Trajectory:
    """A ship at rest."""
    still = np.zeros((round(duration / step) + 1, 2))
    return vehicle_trajectory(latitude, still, 0.0, interval=step)


@lru_cache(maxsize=8)
def speeding_up(latitude: float, speed: float, step: float) -> Trajectory:
    """From rest to full speed to the North, then two swings on an even way."""
    times = step * np.arange(round((REST + speed / BRAKING + 2 * SWING) / step) + 1)
    way = np.clip((times - REST) * BRAKING, 0.0, speed)
    velocity = np.stack([way, np.zeros_like(way)], axis=-1)
    return vehicle_trajectory(latitude, velocity, 0.0, interval=step)


@lru_cache(maxsize=8)
def turning(latitude: float, speed: float, step: float) -> Trajectory:
    """Up to full speed to the North, and through West to the South; then half a swing.

    At 70 knots the turn pulls with 12.6 m/s^2. The resolution as read sets no cap there; the draft
    of ISO 22090-1 sets one of 2 m/s^2 for 20 knots, with limits of its own.
    """
    begin = 2 * REST + speed / BRAKING
    times = step * np.arange(round((begin + SWING / 2 + REST) / step) + 1)
    heading = np.clip((times - begin) * _TURNING, 0.0, np.pi)
    way = np.clip((times - REST) * BRAKING, 0.0, speed)
    velocity = np.stack([way * np.cos(heading), -way * np.sin(heading)], axis=-1)
    return vehicle_trajectory(latitude, velocity, heading, interval=step)


@lru_cache(maxsize=8)
def rolling(latitude: float, step: float, duration: float) -> Trajectory:
    """A ship that rolls, pitches and yaws, and sways to the North-East and back."""
    times = step * np.arange(round(duration / step) + 1)
    roll, pitch, yaw = (size * np.sin(2 * np.pi * times / period) for size, period in _ROLLING)
    force, period = _SWAYING
    sway = force * period / (2 * np.pi) * np.sin(2 * np.pi * times / period)
    velocity = sway[:, np.newaxis] * np.sqrt([0.5, 0.5])
    return vehicle_trajectory(latitude, velocity, yaw, pitch, roll, interval=step)
