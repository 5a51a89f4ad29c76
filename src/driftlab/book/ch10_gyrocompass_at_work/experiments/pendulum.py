"""Schuler's pendulum: a level platform that is tilted and left alone, or set on its way."""

from typing import NamedTuple

import numpy as np

from driftlab.book.scenarios import SARATOV_LATITUDE, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RADIUS
from driftlab.gyrocompass.simulation import simulate_compass

EVERY = 6
"""Of so many steps of the simulation one is kept."""


class Pendulum(NamedTuple):
    """A platform in the plane of the meridian, at n times."""

    times: FloatArray  # (n,), s
    length: float  # of the pendulum that swings as the platform does, m
    start: float  # tilt with which it was left alone, rad
    tilt: FloatArray  # (n, 2), about North and about East, rad
    way: FloatArray  # (n,), true way to the North, m
    # (n,), of the velocity to the North that the platform's own turn tells, m/s
    velocity_error: FloatArray
    place_error: FloatArray  # (n,), of the way to the North, likewise, m
    heading_error: FloatArray  # (n,), of a compass that finds North by the platform's turn, rad


def schuler_pendulum(
    tilt: float, *, speed: float = 0.0, tuning_factor: float = 1.0, damping: float = 0.0
) -> Pendulum:
    """Tilt a platform about East, and let it swing while its ship lies still or goes to the North.

    A platform that stays level turns about East by the velocity over R. So its turn tells a
    velocity, wrong by R times what its tilt changes; and what it has tilted, a way. With damping a
    log tells the velocity, so that it does not disturb the horizon.
    """
    way = ship_manoeuvre(SARATOV_LATITUDE, speed, turn=0.0)
    run = simulate_compass(
        way, np.zeros(3), tuning_factor=tuning_factor, damping=damping, tilt=tilt, log=True
    )
    east_tilt = run.tilt[:, 1]
    shown = slice(None, None, EVERY)
    return Pendulum(
        run.times[shown],
        EARTH_RADIUS / tuning_factor,
        tilt,
        run.tilt[shown],
        EARTH_RADIUS * (way.latitude[1:] - way.latitude[0])[shown],
        -EARTH_RADIUS * np.gradient(east_tilt, way.increments.interval)[shown],
        -EARTH_RADIUS * (east_tilt - tilt)[shown],
        run.heading_error[shown],
    )
