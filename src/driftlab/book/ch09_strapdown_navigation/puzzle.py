"""The puzzle of chapter 09: two sensors, ten hours, and how far each leads."""

import numpy as np
from scipy.constants import degree, g, hour, micro, nautical_mile

from driftlab.calibration import STATIC_ERROR_SOURCES, static_errors

from ..machinery.exercise.puzzle import Number, Puzzle

TEN_HOURS = np.linspace(0.0, 10 * hour, 3601)
PUZZLE_LATITUDE = float(np.radians(45.0))


def farthest(cause: str, size: float) -> float:
    """Largest distance from the true place within ten hours at rest, nautical miles."""
    sources = np.zeros(len(STATIC_ERROR_SOURCES))
    sources[STATIC_ERROR_SOURCES.index(cause)] = size
    position = static_errors(TEN_HOURS, PUZZLE_LATITUDE, sources).position
    return float(np.linalg.norm(position, axis=1).max()) / nautical_mile


PUZZLE = Puzzle(
    chapter="09",
    edition=1,
    questions=(
        Number(
            asks="Ten hours with the accelerometer of 100 µg: how far off at most?",
            unit="nautical miles",
            low=0.1,
            high=1000,
            truth=lambda: farthest("accelerometer bias East", 100 * micro * g),
        ),
        Number(
            asks="And with the gyro of 0.01 °/h?",
            unit="nautical miles",
            low=0.1,
            high=10000,
            truth=lambda: farthest("gyro bias North", 0.01 * degree / hour),
        ),
    ),
    says=(
        "An acceleration of 100 µg, integrated twice, is 343 nautical miles after ten hours. "
        "Something brings the unit back. What is it, and why does it not bring back the gyro?"
    ),
)
