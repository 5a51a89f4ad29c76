"""Places, typical units and voyages of the book: each number stands here once."""

from __future__ import annotations

import numpy as np
from scipy.constants import hour, minute

from driftlab.checks import FloatArray, finite_number, positive_number
from driftlab.motion.vehicle import Voyage, smooth_step, voyage

LARIN_TRIAD: FloatArray = 1e-3 * np.array([[0.0, 0, 0], [0, 0, 0], [2, -2, 0]])
"""mu T of Larin's experiment: i_z leans by 2e-3 to i_1 and by -2e-3 to i_2."""
SYMMETRIC: FloatArray = np.array([[0.0, 1, 1], [1, 0, 1], [1, 1, 0]])
SKEW: FloatArray = np.array([[0.0, -1, 1], [1, 0, -1], [-1, 1, 0]])
for _array in (LARIN_TRIAD, SYMMETRIC, SKEW):
    _array.setflags(write=False)

DURATION = 2 * hour
"""Of the voyage, s."""
UNDER_WAY = (10 * minute, 2 * minute)
"""Beginning and length of gathering way, s."""
TURN = (50 * minute, 4 * minute)
"""Beginning and length of the turn, s."""


def ship(
    latitude: float, speed: float, course: float, turn: float, interval: float, pitch: float = 0.0
) -> Voyage:
    """Return the voyage of a ship that lies still, gathers way along its course, and turns.

    Parameters
    ----------
    latitude : float
        At the start, rad.
    speed : float
        m/s.
    course, turn : float
        Heading before the turn, and by how much it turns, rad, positive from North to West.
    interval : float
        s.
    pitch : float
        rad, all the time.
    """
    times = interval * np.arange(round(DURATION / positive_number(interval, "interval")) + 1)
    heading = course + turn * smooth_step(times, *TURN)
    way = finite_number(speed, "speed") * smooth_step(times, *UNDER_WAY)
    # A positive heading is West of North.
    velocity = np.stack([way * np.cos(heading), -way * np.sin(heading)], axis=-1)
    return voyage(latitude, velocity, heading, pitch, interval=interval)


SHAPES = {
    "symmetric": SYMMETRIC.astype(int).tolist(),
    "skew": SKEW.astype(int).tolist(),
    "third axis bent, as in Larin's table": [[0, 0, 0], [0, 0, 0], [1, -1, 0]],
    "x leans to axis 2 only": [[0, 1, 0], [0, 0, 0], [0, 0, 0]],
    "scale factor of all three": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
}

# Chapters 00 to 05
OBLIQUE_AXIS = (1.0, 1.0, 0.3)
"""Axis of rotation in the published figures: neither a body axis nor a diagonal."""
