"""Schuler's pendulum: a level platform that is tilted and left alone, or set on its way."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE, ship_manoeuvre
from driftlab.earth import EARTH_RADIUS
from driftlab.gyrocompass.simulation import simulate_gyrocompass

EVERY = 6
"""Of so many steps of the simulation one is kept."""


def schuler_pendulum(
    tilt: float, *, speed: float = 0.0, tuning_factor: float = 1.0, damping: float = 0.0
) -> DataTable:
    """Tilt a platform about East, and let it swing while its ship lies still or goes to the North.

    A platform that stays level turns about East by the velocity over R. So its turn tells a
    velocity, wrong by R times what its tilt changes; and what it has tilted, a way. With damping a
    log tells the velocity, so that it does not disturb the horizon.
    """
    way = ship_manoeuvre(SARATOV_LATITUDE, speed, turn=0.0)
    run = simulate_gyrocompass(
        way, np.zeros(3), tuning_factor=tuning_factor, damping=damping, tilt=tilt, speed_log=True
    )
    east_tilt, seen = run.tilt[:, 1], slice(None, None, EVERY)
    tilts, heading_error = run.tilt[seen], run.heading_error[seen]
    velocity_error = -EARTH_RADIUS * np.gradient(east_tilt, way.increments.interval)[seen]
    place_error = -EARTH_RADIUS * (east_tilt - tilt)[seen]
    largest = np.abs(velocity_error).max()
    return DataTable(
        {
            "times": (run.times[seen], "min", "since the start"),
            "way": (EARTH_RADIUS * (way.latitude[1:] - way.latitude[0])[seen], "nmi", "to North"),
            "velocity_error": (velocity_error, "m_per_s", "of the North velocity that it tells"),
            "place_error": (place_error, "nmi", "of the way to the North that it tells"),
            "heading_error": (heading_error, "deg", "of a compass that reads its turn"),
        },
        {
            "tilt": (tilts, "arcmin", "about North and about East"),
            "start": (tilt, "arcmin", "tilt with which it is left alone"),
            "length": (EARTH_RADIUS / tuning_factor, "km", "of a pendulum that swings as it does"),
            "most_tilt": (np.hypot(*tilts.T).max(), "arcmin", "then out of level by up to"),
            "most_place_error": (np.abs(place_error).max(), "nmi", "way told, off by up to"),
            "most_velocity_error": (largest, "m_per_s", "velocity told, off by up to"),
            "most_heading_error": (np.abs(heading_error).max(), "deg", "heading, off by up to"),
        },
    )
