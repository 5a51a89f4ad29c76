"""A ship with its compass on board, as one sees it: course, wake, plumb line, horizon and North."""

from typing import NamedTuple

import numpy as np

from driftlab.book.scenarios import SARATOV_LATITUDE, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.frames import to_euler_angles
from driftlab.gyrocompass.simulation import simulate_compass
from driftlab.motion.trajectory import Trajectory
from driftlab.quaternion import rotate

WAKE = 300.0
"""How long the wake of a ship is seen, s."""
WAKE_POINTS = 16
"""Places on the wake, the ship's own the first."""


class ShipWithCompass(NamedTuple):
    """A ship and its compass at n times."""

    times: FloatArray  # (n,), s
    heading: FloatArray  # (n,), true, rad, positive from North to West
    # (n, 16, 2), where the ship was in the last five minutes, to the North and East of where it is,
    # m
    wake: FloatArray
    # (n, 2), level part of the specific force over its part upwards, North and East: by how much
    # the plumb line's Up leans
    lean: FloatArray
    tilt: FloatArray  # (n, 2), of the compass's horizon about North and about East, rad
    speed_error: FloatArray  # (n,), what the ship's own way makes of North, rad
    # (n,), error of the heading that the compass shows, rad: with the speed error, unless a log
    # lets the compass subtract it
    shown_error: FloatArray

    def at(self, moments: slice) -> "ShipWithCompass":
        """Return the same at some of the times."""
        return ShipWithCompass(*(part[moments] for part in self))


def ship_with_compass(
    speed: float,
    course: float,
    turn: float,
    gyro_bias: FloatArray,
    *,
    log: bool = False,
    latitude: float = SARATOV_LATITUDE,
) -> ShipWithCompass:
    """Sail the voyage of `ship_manoeuvre` with a compass on board."""
    way = ship_manoeuvre(latitude, speed, course, turn)
    run = simulate_compass(way, gyro_bias, log=log)
    return ShipWithCompass(
        run.times,
        np.unwrap(to_euler_angles(way.attitude[1:]).heading),
        _wake(way),
        _lean(way),
        run.tilt,
        run.speed_error,
        run.heading_error if log else run.heading_error + run.speed_error,
    )


def _wake(way: Trajectory) -> FloatArray:
    interval, velocity = way.increments.interval, way.velocity
    place = np.cumsum(0.5 * interval * (velocity[1:] + velocity[:-1]), axis=0)
    back = np.linspace(0.0, WAKE / interval, WAKE_POINTS).round().astype(int)
    earlier = np.maximum(np.arange(len(place))[:, np.newaxis] - back, 0)
    return place[earlier] - place[:, np.newaxis]


def _lean(way: Trajectory) -> FloatArray:
    # In the middle of an interval, as the mean of what its two ends make of the body's components.
    push = way.increments.velocity
    north, up, east = 0.5 * (rotate(way.attitude[:-1], push) + rotate(way.attitude[1:], push)).T
    return np.stack([north / up, east / up], axis=-1)
