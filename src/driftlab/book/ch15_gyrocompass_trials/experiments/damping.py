"""A voyage with a damped horizon: without a log, with a true one, with one that errs."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.ch14_gyrocompass_under_way.experiments import (
    DAMPING,
    GYRO_BIAS,
    several_horizons,
)
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, SPEED, ship_manoeuvre
from driftlab.gyrocompass.simulation import simulate_gyrocompass

LOG_SCALE, CURRENT = 0.01, (0.5, 0.0)
"""A log with errors: what it tells too much, and the current to North and East, m/s, unseen."""


def damping_at_sea(
    gyro_bias_body: ArrayLike = GYRO_BIAS,
    latitude: float = SARATOV_LATITUDE,
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = QUARTER_TURN,
    damping: float = DAMPING,
    speed_log_scale_factor: float = LOG_SCALE,
    current: tuple[float, float] = CURRENT,
) -> DataTable:
    """Return the errors of four horizons: undamped, and damped with a log or not.

    The log measures the velocity through the water, so that a current is missing in what it tells.
    """
    way = ship_manoeuvre(latitude, speed, course, turn)
    speed_log_error = speed_log_scale_factor * way.velocity - np.asarray(current)
    logs: dict[str, dict[str, Any]] = {
        "undamped, with a log": {"speed_log": True},
        "damped, no log": {"damping": damping},
        "damped by a true log": {"damping": damping, "speed_log": True},
        "damped by a log with errors": {
            "damping": damping,
            "speed_log": True,
            "speed_log_error": speed_log_error,
        },
    }
    runs = {
        name: simulate_gyrocompass(way, gyro_bias_body, **settings)
        for name, settings in logs.items()
    }
    return several_horizons(
        runs,
        speed_log_scale_factor=(speed_log_scale_factor, "percent", "what the log tells too much"),
        current=(current, "m_per_s", "to North and East, which no log sees"),
    )
