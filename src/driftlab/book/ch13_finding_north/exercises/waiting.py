"""Exercises 13.6 and 13.7: how long to wait for North."""

from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.constants import degree, hour

from driftlab.book.machinery.exercise.answers import Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.earth import EARTH_RATE

from ..experiments import WHITE, gyro_noise

NOISE, WALK = gyro_noise(WHITE[0], gauss_markov=0.0), 0.01 * degree / hour / np.sqrt(hour)
"""Of 13.6: the white noise, and the walk of the drift in rad/s per root of a second."""

GOAL = 0.1 * degree
"""Of 13.7: the deviation of the heading that is wanted."""


@cache
def _best_window() -> float:
    """Time in s over which the mean of white noise and of a walk from zero is best."""
    counts = np.arange(1, 20_001)
    white = NOISE.standard_deviation_of_mean(1) ** 2 / counts
    # Steps are independent; step i is in all means but those of the samples before it.
    walk = WALK**2 * NOISE.interval * (counts - 1) * (2 * counts - 1) / (6 * counts)
    return NOISE.interval * float(counts[np.argmin(white + walk)])


def _window(white: float, walk_part: float) -> float:
    """Best time in s from a density of white noise and the part of the walk in its variance."""
    return white / (WALK * np.sqrt(walk_part))


def _waiting(
    turn: float,
    turn_deviation: float,
    random_walk: float,
    drift_change: float,
    latitude: float,
    *,
    share: Callable[[float], float] = np.sin,
    click: float = 0.5,
    change: float = 0.5,
) -> float:
    """Time of both positions, s, whose noise fills what turn and change leave of the deviation.

    The last two say how much of the turn's deviation and of the drift's change counts; `share`
    takes half the turn to the part of the Earth's rate that the difference shows.
    """
    level = EARTH_RATE * np.cos(latitude * degree) * share(turn * degree / 2)
    seen = (GOAL**2 - (click * turn_deviation * degree) ** 2) * level**2
    noise = (random_walk * degree) ** 2 / hour
    return float(noise / (seen - (change * drift_change * degree / hour) ** 2))


def _some_cable(rng: np.random.Generator) -> dict[str, float]:
    # A turn between a quarter and a half, far from both, and no part so small that it hides.
    return {
        "turn": round(rng.uniform(118, 130)),
        "turn_deviation": round(rng.uniform(0.11, 0.126), 3),
        "random_walk": round(rng.uniform(0.003, 0.007), 4),
        "drift_change": round(rng.uniform(0.005, 0.006), 4),
        "latitude": round(rng.uniform(54, 60), 1),
    }


EXERCISES: dict[str, Exercise] = {
    "13.6": Value(
        kind="compute",
        right=_best_window,
        unit="s",
        accuracy=0.03,
        mistakes={
            "So it would be if the drift at the end of the window counted. The mean over the "
            "window has a smaller part of the walk.": (
                lambda: _window(NOISE.white * np.sqrt(NOISE.interval), 1.0)
            ),
            "Ten samples come in a second: their white noise is smaller in the mean over one.": (
                lambda: _window(NOISE.white, 1 / 3)
            ),
            "Ten samples come in a second, and the mean over the window has a smaller part of the "
            "walk than the drift at its end.": lambda: _window(NOISE.white, 1.0),
            "That is the number of samples; give the time.": lambda: (
                _best_window() / NOISE.interval
            ),
        },
        remark="At the best window the white part and the walk's have equal variances.",
    ),
    "13.7": Value(
        kind="compute",
        given=GivenNumbers(
            book={
                "turn": 120,
                "turn_deviation": 0.12,
                "random_walk": 0.005,
                "drift_change": 0.006,
                "latitude": 60.0,
            },
            draw=_some_cable,
            units={
                "turn": "degrees",
                "turn_deviation": "degrees",
                "random_walk": "degrees per root of an hour",
                "drift_change": "degrees an hour",
                "latitude": "degrees",
            },
        ),
        right=_waiting,
        unit="s",
        accuracy=0.01,
        mistakes={
            "That is the time of one position; both have to be waited for.": lambda **box: (
                _waiting(**box) / 2
            ),
            "So it would be after half a turn. A smaller turn leaves less of the Earth's rate in "
            "the difference.": lambda **box: _waiting(**box, share=lambda half: 1.0),
            "The difference of a vector and the turned one is twice the sine of half the turn, not "
            "of the turn, and not its cosine.": lambda **box: _waiting(**box, share=np.cos),
            "That is the noise alone. The turn is not known exactly, and the drifts change.": (
                lambda **box: _waiting(**box, click=0.0, change=0.0)
            ),
            "The change of the drifts counts as well.": lambda **box: _waiting(**box, change=0.0),
            "The turn is not known exactly, and half of its error goes into the heading.": (
                lambda **box: _waiting(**box, click=0.0)
            ),
            "A change of the drift is shared by both positions: half of it counts.": (
                lambda **box: _waiting(**box, change=1.0)
            ),
            "So it would be if the readings of one position alone told the heading. It takes the "
            "noise of both.": lambda **box: 2 * _waiting(**box),
        },
        remark="The turn's error takes a fixed part: no waiting gets below half of it.",
    ),
}
