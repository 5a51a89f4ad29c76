"""Exercises 15.2 and 15.3: what a compass may show, by chance and by a standard."""

from functools import cache

import numpy as np
from scipy.constants import degree, hour

from driftlab.book.machinery.exercise.answers import Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.type_test import LIMITS

from ..experiments import RESTARTS, TRIALS, range_over_standard_deviation

OUTLIER_TRIALS = 120_000
WITHIN = 5.56
HIGH_LATITUDE = float(np.radians(70.0))
TURNING_DRIFT = 0.05 * degree / hour


@cache
def _wide_ranges(width: float = 3.0) -> FloatArray:
    """Two ratios (2, n) of samples with outliers: range over deviation, by n - 1 and by n."""
    rng = np.random.default_rng(10)
    wide = np.where(rng.random((OUTLIER_TRIALS, RESTARTS)) < 0.1, width, 1.0)
    ratio = range_over_standard_deviation(wide * rng.standard_normal(wide.shape))
    return np.array([ratio, ratio * np.sqrt(RESTARTS / (RESTARTS - 1))])


def _how_often(width: float = 3.0, divided_by_n: bool = False) -> float:
    return float(np.mean(_wide_ranges(width)[int(divided_by_n)] >= WITHIN))


def _without_outliers() -> float:
    """The same for normal samples, as many and from the same seed as in the chapter."""
    samples = np.random.default_rng(1).standard_normal((TRIALS, RESTARTS))
    return float(np.mean(range_over_standard_deviation(samples) >= WITHIN))


def _drift_and_latitude(
    aside: float = 1.0, secant: bool = True, shown: float = 4.0, of: str = "turn"
) -> FloatArray:
    """Largest level drifts at the equator and at 70 degrees, deg/h, and latitude of 15.3, deg."""
    share = LIMITS["settle point"].size * EARTH_RATE / (degree / hour) * aside
    level = shown * TURNING_DRIFT / (EARTH_RATE * LIMITS[of].size)
    north = share if secant else share * np.cos(HIGH_LATITUDE)
    return np.array([share, north, np.degrees(np.arccos(min(level, 1.0)))])


EXERCISES: dict[str, Exercise] = {
    "15.2": Value(
        kind="compute",
        right=_how_often,
        accuracy=0.06,
        mistakes={
            "Three times as wide means three times the standard deviation, not the variance.": (
                lambda: _how_often(np.sqrt(3))
            ),
            "That is without any outliers.": _without_outliers,
            "With n - 1 below, as usual for a sample, the deviation is a little larger.": (
                lambda: _how_often(divided_by_n=True)
            ),
        },
        remark="If one restart in ten goes astray, the paper's numbers are usual even as a range.",
    ),
    "15.3": Value(
        kind="predict",
        right=_drift_and_latitude,
        absolute=(0.002, 0.002, 0.3),
        mistakes={
            "At 70 degrees the limit grows as well: it has the same secant as the error.": (
                lambda: _drift_and_latitude(secant=False)
            ),
            "In the turn the drift shows four times, not once.": (
                lambda: _drift_and_latitude(shown=1.0)
            ),
            "The swing goes as far beyond as the new error is away from the old one: four times, "
            "not twice.": lambda: _drift_and_latitude(shown=2.0),
            "That is the latitude for 2 degrees, the limit of a change of speed.": (
                lambda: _drift_and_latitude(of="change of speed")
            ),
            "The Earth turns by 15 degrees an hour; the limit is an angle, so put it in radians.": (
                lambda: _drift_and_latitude(aside=180 / np.pi)
            ),
        },
        remark="A secant in the limit forgives the latitude; without one, the pole is near.",
    ),
}
