"""A ship's gyrocompass for two hours: its errors, their formula, and what the tuning does."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcminute, degree, g, hour, milli

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, SPEED, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import HeadingErrors, simulate_gyrocompass

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
"""Its compass, with everything wrong at once: arguments of `simulate_gyrocompass`."""

DAMPING = 0.5
"""Damping ratio of a horizon that is damped at sea."""
EVERY_THIRD, EVERY_SIXTH = slice(2, None, 3), slice(5, None, 6)
"""Steps of a voyage that figures show."""
TERMS = ("rate about East", "rate about North", "minus the yaw's error", "tilt by tan pitch")


def errors_under_way(
    gyro_bias_body: ArrayLike = GYRO_BIAS,
    latitude: float = SARATOV_LATITUDE,
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = QUARTER_TURN,
    tuning_factor: float = 1.0,
    damping: float = 0.0,
    speed_log: bool = False,
) -> DataTable:
    """Return the errors of a compass on the ship's voyage."""
    way = ship_manoeuvre(latitude, speed, course, turn)
    return error_table(
        simulate_gyrocompass(
            way, gyro_bias_body, tuning_factor=tuning_factor, damping=damping, speed_log=speed_log
        )
    )


def error_table(run: HeadingErrors) -> DataTable:
    """Return the errors of a simulated compass as a table."""
    return DataTable(
        {
            "time": (run.times, "min", "since the start"),
            "heading_error": (run.heading_error, "deg", "without the speed error"),
            "formula": (run.formula.heading, "deg", "the same by the formula"),
            "speed_error": (run.speed_error, "deg", "what the ship's own way makes of North"),
            "tilt_north": (run.tilt[:, 0], "arcmin", "of the horizon about North"),
            "tilt_east": (run.tilt[:, 1], "arcmin", "of the horizon about East"),
            "yaw_error": (run.yaw_error, "deg", "part of the heading error"),
            "compass_angle_error": (run.compass_error, "deg", "part of the heading error"),
        }
    )


def ballistic_errors(
    latitude: float = SARATOV_LATITUDE,
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = QUARTER_TURN,
    stiff: float = 2.0,
    soft: float = 0.5,
    damping: float = DAMPING,
) -> DataTable:
    """Return the errors of five tunings with perfect sensors on the ship's voyage.

    `stiff` and `soft` are values of k2 R; 1 is Schuler's tuning.
    """
    tunings: dict[str, dict[str, Any]] = {
        "Schuler: k2 = 1/R": {},
        "Schuler, with a log": {"speed_log": True},
        f"too stiff: k2 = {stiff:g}/R": {"tuning_factor": stiff},
        f"too soft: k2 = {soft:g}/R": {"tuning_factor": soft},
        f"damped: k2 = 1/R, ratio {damping:g}": {"damping": damping},
    }
    way = ship_manoeuvre(latitude, speed, course, turn)
    return several_horizons(
        {name: simulate_gyrocompass(way, np.zeros(3), **tuning) for name, tuning in tunings.items()}
    )


def several_horizons(runs: dict[str, HeadingErrors], **facts: tuple[Any, ...]) -> DataTable:
    """Return the errors of several horizons on one voyage, by tuning and damping."""
    columns: dict[str, tuple[Any, ...]] = {
        "time": (next(iter(runs.values())).times[EVERY_THIRD], "min", "since the start")
    }
    for name, run in runs.items():
        tilt, heading = run.tilt[EVERY_THIRD, 1], run.heading_error[EVERY_THIRD]
        columns[f"tilt_east, {name}"] = (tilt, "arcmin", "of the horizon")
        columns[f"heading_error, {name}"] = (heading, "deg", "without the speed error")
    return DataTable(columns, {"runs": (runs, "", "errors at every step"), **facts})


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
) -> DataTable:
    """Compare the compass of a fast craft with (operating heading), term by term."""
    way = ship_manoeuvre(latitude, speed, course, turn, CRAFT["interval"], pitch)
    run = simulate_gyrocompass(
        way, gyro_bias_body, accelerometer_bias_body, tuning_factor=tuning_factor, tilt=tilt
    )
    gap = run.compass_error - run.formula.compass_angle
    gaps = np.stack([gap, *(gap + term for term in run.formula)])
    seen = EVERY_SIXTH
    return DataTable(
        {
            "time": (run.times[seen], "min", "since the start"),
            "simulated": (run.compass_error[seen], "deg", "error of the compass angle"),
            "formula": (run.formula.compass_angle[seen], "deg", "the same by the formula"),
            "term": (np.stack(run.formula)[:, seen], "deg", "of the formula", TERMS),
            "missing": (np.abs(gaps[0, seen]), "deg", "size of simulated minus formula"),
            "missing_without": (np.abs(gaps[1:, seen]), "deg", "likewise, without a term", TERMS),
        },
        {
            "run": (run, "", "errors at every step"),
            "gaps": (gaps, "deg", "simulated minus formula: with all terms, without each"),
        },
    )
