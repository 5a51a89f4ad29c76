"""Places, typical units and voyages of the book: each number stands here once."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.constants import hour, minute

from driftlab.checks import FloatArray, finite_number, positive_number
from driftlab.earth import EARTH_RADIUS, gravity
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.vehicle import smooth_step, vehicle_trajectory

LARIN_TRIAD: FloatArray = 1e-3 * np.array([[0.0, 0, 0], [0, 0, 0], [2, -2, 0]])
"""mu T of Larin's experiment: i_z leans by 2e-3 to i_1 and by -2e-3 to i_2."""
SYMMETRIC: FloatArray = np.array([[0.0, 1, 1], [1, 0, 1], [1, 1, 0]])
SKEW: FloatArray = np.array([[0.0, -1, 1], [1, 0, -1], [-1, 1, 0]])
for _array in (LARIN_TRIAD, SYMMETRIC, SKEW):
    _array.setflags(write=False)

SHAPES = {
    "symmetric": SYMMETRIC.astype(int).tolist(),
    "skew": SKEW.astype(int).tolist(),
    "third axis bent, as in Larin's experiment": [[0, 0, 0], [0, 0, 0], [1, -1, 0]],
    "x leans to axis 2 only": [[0, 1, 0], [0, 0, 0], [0, 0, 0]],
    "scale factor of all three": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
}

OBLIQUE_AXIS = (1.0, 1.0, 0.3)
"""Axis of rotation in the published figures: neither a body axis nor a diagonal."""

# Chapters 13 to 16
SARATOV_LATITUDE = float(np.radians(51.5))
"""Of the authors' town, rad; their paper on the gyrocompass names no place."""
SCHULER_PERIOD = 2 * np.pi * float(np.sqrt(EARTH_RADIUS / gravity(SARATOV_LATITUDE)))
"""In Saratov, s."""
DURATION = 2 * hour
"""Of the voyage, s."""
SPEED_UP = (10 * minute, 2 * minute)
"""Beginning and length of gathering way, s."""
TURN = (50 * minute, 4 * minute)
"""Beginning and length of the turn, s."""
SPEED = 10.0
"""Of the ship under way, m/s."""
QUARTER_TURN = np.pi / 2
"""To the West, rad."""


def ship_manoeuvre(
    latitude: float = SARATOV_LATITUDE,
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = QUARTER_TURN,
    interval: float = 4.0,
    pitch: float = 0.0,
) -> Trajectory:
    """Return the voyage of a ship that lies still, gathers way along its course, and turns.

    The last two voyages are kept, so that a reader who moves the sliders of an instrument does not
    wait for the ship; their arrays are read-only.

    Parameters
    ----------
    latitude : float
        At the start, rad.
    speed : float
        m/s.
    course, turn : float
        Heading before the turn, and by how much it turns, rad, positive from North to West.
    interval : float
        s. The increments hold the motion whatever the interval, and what a compass shows swings
        within minutes and hours, so that a long one will do.
    pitch : float
        rad, all the time.
    """
    numbers = {
        "latitude": latitude, "speed": speed, "course": course, "turn": turn, "interval": interval,
        "pitch": pitch,
    }  # fmt: skip
    return _kept_voyage(**{name: finite_number(value, name) for name, value in numbers.items()})


@lru_cache(maxsize=2)
def _kept_voyage(
    latitude: float, speed: float, course: float, turn: float, interval: float, pitch: float
) -> Trajectory:
    times = interval * np.arange(round(DURATION / positive_number(interval, "interval")) + 1)
    heading = course + turn * smooth_step(times, *TURN)
    way = speed * smooth_step(times, *SPEED_UP)
    # A positive heading is West of North.
    velocity = np.stack([way * np.cos(heading), -way * np.sin(heading)], axis=-1)
    kept = vehicle_trajectory(latitude, velocity, heading, pitch, interval=interval)
    for part in (*kept.increments[1:], kept.attitude, kept.latitude, kept.velocity):
        part.setflags(write=False)
    return kept


# Chapters 07 to 11
TABLE_LATITUDE = float(np.radians(37.5))
"""Of the turntable on which units are calibrated, rad."""
