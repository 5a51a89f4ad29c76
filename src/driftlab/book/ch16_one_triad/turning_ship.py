"""A ship that turns with a bent triad on board: what the turn leaves behind."""

from __future__ import annotations

import numpy as np

from driftlab.book.ch14_gyrocompass_under_way.experiments import ship_with_compass
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity


def turning_ship(
    gyro_error_matrix: FloatArray,
    *,
    speed: float = 0.0,
    turn: float = QUARTER_TURN,
    latitude: float = SARATOV_LATITUDE,
    seen: tuple[float, float, int] = (0.0, np.inf, 1),
) -> DataTable:
    """Turn a ship whose compass has a log and does not know the error matrix of its gyros.

    The matrix is in body axes forward, up, right. Seen is a part of the voyage, as in
    `ship_with_compass`.
    """
    way = ship_manoeuvre(latitude, speed, turn=turn)
    gyro_bias = way.increments.mean_rate @ gyro_error_matrix.T
    return ship_with_compass(
        speed, 0.0, turn, gyro_bias, speed_log=True, latitude=latitude, seen=seen
    )


def swing_factor(latitude: float = SARATOV_LATITUDE, east_speed: float = 0.0) -> float:
    """Return how many times larger the heading swings than the horizon about East.

    Schuler's frequency over the level rate from which North is read.
    """
    level = EARTH_RATE * np.cos(latitude) + east_speed / EARTH_RADIUS
    return float(np.sqrt(gravity(latitude) / EARTH_RADIUS) / level)
