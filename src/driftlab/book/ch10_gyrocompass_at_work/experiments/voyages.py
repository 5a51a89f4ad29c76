"""A ship's gyrocompass for two hours: its errors, their formula, and what the tuning does."""

from typing import Any, NamedTuple

import numpy as np
from scipy.constants import arcminute, degree, g, hour, milli

from driftlab.book.scenarios import ship_manoeuvre
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
    """Errors of several horizons on one voyage.

    Attributes
    ----------
    runs : dict of HeadingErrors
        By tuning and damping.
    """

    runs: dict[str, HeadingErrors]


class OperatingFormula(NamedTuple):
    """One voyage, and how far (operating heading) is off with all of its terms and without each.

    Attributes
    ----------
    run : HeadingErrors
    gaps : ndarray, shape (5, n)
        Simulated minus formula, rad: with all terms, then with each left out.
    """

    run: HeadingErrors
    gaps: FloatArray


def errors_under_way() -> HeadingErrors:
    """Return the errors of a compass with small drifts on the ship's voyage."""
    return simulate_compass(ship_manoeuvre(), GYRO_BIAS)


def ballistic_errors() -> Horizons:
    """Return the errors of five tunings with perfect sensors on the ship's voyage."""
    tunings: dict[str, dict[str, Any]] = {
        "Schuler: k2 = 1/R": {},
        "Schuler, with a log": {"log": True},
        "too stiff: k2 = 2/R": {"tuning_factor": 2.0},
        "too soft: k2 = 0.5/R": {"tuning_factor": 0.5},
        f"damped: k2 = 1/R, ratio {DAMPING:g}": {"damping": DAMPING},
    }
    way = ship_manoeuvre()
    return Horizons(
        {name: simulate_compass(way, np.zeros(3), **tuning) for name, tuning in tunings.items()}
    )


def damping_at_sea() -> Horizons:
    """Return the errors of four horizons with small drifts: undamped, and damped with a log or not.

    The log measures the velocity through the water, so that a current is missing in what it tells.
    """
    way = ship_manoeuvre()
    logs: dict[str, dict[str, Any]] = {
        "undamped, with a log": {"log": True},
        "damped, no log": {"damping": DAMPING},
        "damped by a true log": {"damping": DAMPING, "log": True},
        "damped by a log with errors": {
            "damping": DAMPING, "log": True, "log_error": LOG_SCALE * way.velocity - CURRENT
        },
    }  # fmt: skip
    return Horizons({name: simulate_compass(way, GYRO_BIAS, **log) for name, log in logs.items()})


def operating_formula() -> OperatingFormula:
    """Compare the compass of a fast craft with (operating heading), term by term."""
    run = simulate_compass(ship_manoeuvre(**CRAFT), **CRAFT_COMPASS)
    gap = run.compass_error - run.formula.compass_angle
    return OperatingFormula(run, np.stack([gap, *(gap + term for term in run.formula)]))
