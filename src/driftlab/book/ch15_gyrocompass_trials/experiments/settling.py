"""Accelerated alignment, then Schuler's tuning: how noise becomes a swing that nothing damps."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree, hour, minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.levelling import LevelFrame, propagate_level_frame
from driftlab.gyrocompass.levelling_loop import damped_gains, schuler_gains
from driftlab.increments import Increments
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import from_rotation_vector, to_rotation_vector

SETTLING_INTERVAL = 1.0
"""Step of both runs, s."""
SETTLING = 20 * minute
"""Time with a damped horizon, s."""
WORKING = 2 * hour
"""Time with Schuler's tuning after it, s."""
FREQUENCY = 0.02
"""Natural frequency of the damped horizon, rad/s."""
RANDOM_WALK = 0.002 * degree / float(np.sqrt(hour))
"""Of each gyro, rad/sqrt(s)."""
TILT: FloatArray = np.radians([0.5, 0.0, 0.4])
"""Of the horizon at the start, about North and about East, rad."""
SEED = 10


def settling_and_swing(
    runs: int = 40,
    tilt: ArrayLike = TILT,
    frequency: float = FREQUENCY,
    angle_random_walk: float = RANDOM_WALK,
    latitude: float = SARATOV_LATITUDE,
    seed: int = SEED,
) -> DataTable:
    """Let the horizon settle for twenty minutes and work for two hours.

    Its tilt at the start is a rotation vector (North, Up, East), rad.
    """
    runs = whole_number(runs, "runs", least=2)
    random_walk = positive_number(angle_random_walk, "angle_random_walk")
    rng = np.random.default_rng(whole_number(seed, "seed", least=0))
    pull, azimuth_rate = float(gravity(latitude)), EARTH_RATE * np.sin(latitude)
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], latitude)
    # Not level, and without an idea of where North is.
    start = LevelFrame(from_rotation_vector(tilt), np.zeros(2))
    damped, interval = damped_gains(frequency, pull), SETTLING_INTERVAL

    def increments(duration: float, *runs: int) -> Increments:
        size = (*runs, round(duration / interval), 3)
        noise = random_walk * np.sqrt(interval) * rng.standard_normal(size) if runs else 0.0
        angle = np.broadcast_to(interval * rate, size) + noise
        return Increments(interval, angle, np.broadcast_to(interval * force, size))

    quiet = propagate_level_frame(start, increments(SETTLING), damped, azimuth_rate)
    noisy = propagate_level_frame(start, increments(SETTLING, runs), damped, azimuth_rate)
    working = propagate_level_frame(
        noisy.last, increments(WORKING, runs), schuler_gains(), azimuth_rate, every=60
    )
    # The swing begins with the rate error of the moment; the tilt adds little to it.
    phase = np.sqrt(pull / EARTH_RADIUS) * working.times
    begun = damped_rate_standard_deviation(random_walk, frequency) * np.cos(phase)
    grown = schuler_deviation(random_walk, working.times, pull)
    level = EARTH_RATE * np.cos(latitude)
    tilt = np.linalg.norm(to_rotation_vector(quiet.attitude)[:, [0, 2]], axis=-1)
    heading, names = working.heading, [f"run {i}" for i in range(1, runs + 1)]
    return DataTable(
        {
            "settling_time": (quiet.times, "min", "since the start"),
            "settling_heading_error": (np.abs(quiet.heading), "deg", "while the horizon settles"),
            "settling_tilt": (tilt, "deg", "of the horizon meanwhile"),
            "time": (working.times, "min", "since the horizon was left to itself"),
            "formula": (np.hypot(begun, grown) / level, "deg", "standard deviation of the heading"),
            "simulated": (heading.std(axis=0), "deg", "standard deviation over the runs"),
            "heading_error": (heading, "deg", "of each run with noise", names),
        }
    )


def damped_rate_standard_deviation(
    angle_random_walk: float, frequency: float, damping: float = float(np.sqrt(0.5))
) -> float:
    """Standard deviation of a damped horizon's rate under white gyro noise, once settled, rad/s.

    The noise passes a second-order low-pass filter.
    """
    return float(angle_random_walk * np.sqrt(frequency / (4 * damping)))


def schuler_deviation(
    angle_random_walk: float, times: FloatArray, pull: float, radius: float = EARTH_RADIUS
) -> FloatArray:
    """Standard deviation of a Schuler-tuned horizon's rate under white gyro noise, rad/s.

    Nothing damps the oscillation, so it grows with the square root of the time.
    """
    schuler = np.sqrt(pull / radius)
    grown = times / 2 - np.sin(2 * schuler * times) / (4 * schuler)
    return np.asarray(angle_random_walk * schuler * np.sqrt(np.maximum(grown, 0.0)))
