"""Position errors of a unit at rest from three sensor errors, one at a time, over two days."""

import numpy as np
from scipy.constants import degree, g, hour, micro

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import STATIC_ERROR_SOURCES, static_error_modes
from driftlab.checks import finite_number, positive_number

POINTS = 961
MIDDLE_LATITUDE = float(np.radians(45.0))
CAUSES = ("gyro bias East", "gyro bias North", "accelerometer bias East")
"""In the order of the panels."""


def position_error(
    gyro_bias: float = 0.01 * degree / hour,
    accelerometer_bias: float = 100 * micro * g,
    latitude: float = MIDDLE_LATITUDE,
    duration: float = 48 * hour,
) -> DataTable:
    """Position errors, East and North, that each of three constant biases makes at rest.

    The columns without Schuler's swing are a constant, a line and the terms of 24 hours. The last
    facts are the rate of the line of the North gyro, and the farthest place of the accelerometer.
    """
    times = np.linspace(0.0, positive_number(duration, "duration"), POINTS)
    modes = static_error_modes(latitude)
    along = modes.at(times)[:, :, 5:]  # five modes, times, East and North, causes
    size = {
        "gyro": finite_number(gyro_bias, "gyro_bias"),
        "accelerometer": finite_number(accelerometer_bias, "accelerometer_bias"),
    }
    places = [STATIC_ERROR_SOURCES.index(cause) for cause in CAUSES]
    sizes = [size[cause.split()[0]] for cause in CAUSES]
    each = along[..., places] * sizes
    whole, slow = (np.moveaxis(part.sum(axis=0), 0, -1) for part in (each, each[:3]))
    names = (("East", "North"), CAUSES)
    return DataTable(
        {
            "time": (times, "h", "since the start"),
            "position": (whole, "nmi", "position error", names),
            "slow": (slow, "nmi", "the same without the Schuler oscillation", names),
        },
        {
            "gyro_bias": (size["gyro"], "deg_per_h", "of the gyros"),
            "accelerometer_bias": (size["accelerometer"], "ug", "of the accelerometer"),
            "latitude": (latitude, "deg", "of the unit"),
            "schuler_period": (
                2 * np.pi / modes.rates.schuler,
                "min",
                "of the Schuler oscillation",
            ),
            "line": (
                86400 * float(np.linalg.norm(modes.growing[5:, places[1]])) * size["gyro"],
                "nmi",
                "a day, the line of the North gyro",
            ),
            "farthest": (
                float(np.linalg.norm(whole[:, 2], axis=0).max()),
                "nmi",
                "the farthest that the accelerometer bias leads",
            ),
        },
    )
