"""A ship with its compass on board, as one sees it: course, wake, plumb line, horizon and North."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.frames import to_euler_angles
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.motion.trajectory import Trajectory
from driftlab.quaternion import rotate

WAKE = 300.0
"""How long the wake of a ship is seen, s."""
WAKE_POINTS = 16
"""Places on the wake, the ship's own the first."""


def ship_with_compass(
    speed: float,
    course: float,
    turn: float,
    gyro_bias: FloatArray,
    *,
    speed_log: bool = False,
    latitude: float = SARATOV_LATITUDE,
    seen: tuple[float, float, int] = (0.0, np.inf, 1),
) -> DataTable:
    """Sail the voyage of `ship_manoeuvre` with a compass on board.

    Seen are moments from one time to another, s, and of so many steps only one.
    """
    way = ship_manoeuvre(latitude, speed, course, turn)
    run = simulate_gyrocompass(way, gyro_bias, speed_log=speed_log)
    begin, end = np.searchsorted(run.times, seen[:2])
    at = slice(begin, end, seen[2])
    heading = np.unwrap(to_euler_angles(way.attitude[1:]).heading)
    # A log lets the compass subtract the speed error.
    shown = (run.heading_error if speed_log else run.heading_error + run.speed_error)[at]
    own, tilt, lean = run.speed_error[at], run.tilt[at], _lean(way)[at]
    plumb_line = np.hypot(*np.arctan(lean).T)
    return DataTable(
        {
            "times": (run.times[at], "min", "since the start"),
            "true_heading": (heading[at], "deg", "positive from North to West"),
            "speed_error": (own, "deg", "what the ship's own way makes of North"),
            "shown_error": (shown, "deg", "of the heading that the compass shows"),
        },
        {
            "course": (course, "deg", "of the bow, from North to West"),
            "turn": (turn, "deg", "of the ship after it"),
            "wake": (_wake(way)[at], "m", "where the ship was, to North and East of where it is"),
            "lean": (lean, "", "level specific force, North and East, over its part upwards"),
            "tilt": (tilt, "arcmin", "of the compass's horizon about North and East"),
            "most_shown_error": (np.abs(shown).max(), "deg", "heading shown is off by up to"),
            "most_speed_error": (np.abs(own).max(), "deg", "the ship's own way alone makes up to"),
            "most_tilt": (np.hypot(*tilt.T).max(), "arcmin", "horizon"),
            "most_lean": (plumb_line.max(), "arcmin", "plumb line"),
        },
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
