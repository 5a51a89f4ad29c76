"""A ship's gyrocompass for two hours: its errors, their formula, and what the tuning does."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcminute, degree, g, hour, milli

from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, SPEED, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import HeadingErrors, simulate_compass

GYRO_BIAS: FloatArray = np.array([0.01, 0.03, 0.01]) * degree / hour
"""Of three gyros, rad/s."""
TUNING_FACTORS = (0.25, 0.5, 0.8, 0.95, 1.0, 1.05, 1.25, 2.0, 4.0)
"""Values of k2 R to choose from; 1 is Schuler's tuning."""
CRAFT: dict[str, float] = {
    "speed": 30.0,
    "course": float(np.radians(20.0)),
    "turn": float(np.radians(70.0)),
    "interval": 1.0,
    "pitch": float(np.radians(50.0)),
}
"""A fast craft with its bow up: arguments of `ship_manoeuvre`."""
CRAFT_COMPASS: dict[str, Any] = {
    "gyro_bias_body": np.array([0.03, 0.05, 0.04]) * degree / hour,
    "accelerometer_bias_body": np.array([0.1, 0.0, -0.1]) * milli * g,
    "tuning_factor": 1.05,
    "tilt": arcminute,
}
"""Its compass, with everything wrong at once: arguments of `simulate_compass`."""

DAMPING = 0.5
"""Damping ratio of a horizon that is damped at sea."""
LOG_SCALE, CURRENT = 0.01, (0.5, 0.0)
"""A log with errors: what it tells too much, and the current to North and East, m/s, unseen."""


class Horizons(NamedTuple):
    """Errors of several horizons on one voyage."""

    runs: dict[str, HeadingErrors]  # by tuning and damping
    log_scale: float = 0.0  # what a log tells too much, over the velocity
    current: tuple[float, float] = (0.0, 0.0)  # to North and East, m/s, which no log sees


class OperatingFormula(NamedTuple):
    """One voyage, and how far (operating heading) is off with all of its terms and without each."""

    run: HeadingErrors
    # (5, n), simulated minus formula, rad: with all terms, then with each left out
    gaps: FloatArray


def errors_under_way(
    gyro_bias_body: ArrayLike = GYRO_BIAS,
    latitude: float = SARATOV_LATITUDE,
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = QUARTER_TURN,
    tuning_factor: float = 1.0,
    damping: float = 0.0,
    log: bool = False,
) -> HeadingErrors:
    """Return the errors of a compass on the ship's voyage."""
    way = ship_manoeuvre(latitude, speed, course, turn)
    return simulate_compass(
        way, gyro_bias_body, tuning_factor=tuning_factor, damping=damping, log=log
    )


def ballistic_errors(
    latitude: float = SARATOV_LATITUDE,
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = QUARTER_TURN,
    stiff: float = 2.0,
    soft: float = 0.5,
    damping: float = DAMPING,
) -> Horizons:
    """Return the errors of five tunings with perfect sensors on the ship's voyage.

    `stiff` and `soft` are values of k2 R; 1 is Schuler's tuning.
    """
    tunings: dict[str, dict[str, Any]] = {
        "Schuler: k2 = 1/R": {},
        "Schuler, with a log": {"log": True},
        f"too stiff: k2 = {stiff:g}/R": {"tuning_factor": stiff},
        f"too soft: k2 = {soft:g}/R": {"tuning_factor": soft},
        f"damped: k2 = 1/R, ratio {damping:g}": {"damping": damping},
    }
    way = ship_manoeuvre(latitude, speed, course, turn)
    return Horizons(
        {name: simulate_compass(way, np.zeros(3), **tuning) for name, tuning in tunings.items()}
    )


def damping_at_sea(
    gyro_bias_body: ArrayLike = GYRO_BIAS,
    latitude: float = SARATOV_LATITUDE,
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = QUARTER_TURN,
    damping: float = DAMPING,
    log_scale: float = LOG_SCALE,
    current: tuple[float, float] = CURRENT,
) -> Horizons:
    """Return the errors of four horizons: undamped, and damped with a log or not.

    The log measures the velocity through the water, so that a current is missing in what it tells.
    """
    way = ship_manoeuvre(latitude, speed, course, turn)
    log_error = log_scale * way.velocity - np.asarray(current)
    logs: dict[str, dict[str, Any]] = {
        "undamped, with a log": {"log": True},
        "damped, no log": {"damping": damping},
        "damped by a true log": {"damping": damping, "log": True},
        "damped by a log with errors": {"damping": damping, "log": True, "log_error": log_error},
    }
    runs = {name: simulate_compass(way, gyro_bias_body, **log) for name, log in logs.items()}
    return Horizons(runs, log_scale, current)


def operating_formula(
    gyro_bias_body: ArrayLike = CRAFT_COMPASS["gyro_bias_body"],
    accelerometer_bias_body: ArrayLike = CRAFT_COMPASS["accelerometer_bias_body"],
    tilt: float = CRAFT_COMPASS["tilt"],
    tuning_factor: float = CRAFT_COMPASS["tuning_factor"],
    latitude: float = SARATOV_LATITUDE,
    speed: float = CRAFT["speed"],
    course: float = CRAFT["course"],
    turn: float = CRAFT["turn"],
    pitch: float = CRAFT["pitch"],
) -> OperatingFormula:
    """Compare the compass of a fast craft with (operating heading), term by term."""
    way = ship_manoeuvre(latitude, speed, course, turn, CRAFT["interval"], pitch)
    run = simulate_compass(
        way, gyro_bias_body, accelerometer_bias_body, tuning_factor=tuning_factor, tilt=tilt
    )
    gap = run.compass_error - run.formula.compass_angle
    return OperatingFormula(run, np.stack([gap, *(gap + term for term in run.formula)]))
