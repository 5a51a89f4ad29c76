"""Exercises 9.6 and 9.7: how long to wait for North."""

from functools import cache

import numpy as np
from scipy.constants import degree, hour

from driftlab.book.machinery.answers import Value
from driftlab.book.machinery.exercise import Exercise
from driftlab.earth import EARTH_RATE

from ..experiments import WHITE, gyro_noise

NOISE, WALK = gyro_noise(WHITE[0], slow=0.0), 0.01 * degree / hour / np.sqrt(hour)
"""Of 9.6: the white noise, and the walk of the drift in rad/s per root of a second."""

CABLE, CLICK, CHANGE = np.radians(120.0), np.radians(0.12), 0.006 * degree / hour
RANDOM_WALK, PLACE, GOAL = 0.005 * degree / np.sqrt(hour), np.radians(60.0), np.radians(0.1)
"""Of 9.7: turn, its deviation, change of a drift; the gyros, the latitude, and what is wanted."""


@cache
def _best_window() -> float:
    """Time in s over which the mean of white noise and of a walk from zero is best."""
    counts = np.arange(1, 20_001)
    white = NOISE.deviation_of_mean(1) ** 2 / counts
    # Steps are independent; step i is in all means but those of the samples before it.
    walk = WALK**2 * NOISE.interval * (counts - 1) * (2 * counts - 1) / (6 * counts)
    return NOISE.interval * float(counts[np.argmin(white + walk)])


def _window(white: float, walk_part: float) -> float:
    """Best time in s from a density of white noise and the part of the walk in its variance."""
    return white / (WALK * np.sqrt(walk_part))


def _waiting(
    sine: float = float(np.sin(CABLE / 2)), click: float = CLICK / 2, change: float = CHANGE / 2
) -> float:
    """Time of both positions, s, whose noise fills what turn and change leave of the deviation."""
    level = EARTH_RATE * np.cos(PLACE) * sine
    return float(RANDOM_WALK**2 / ((GOAL**2 - click**2) * level**2 - change**2))


EXERCISES: dict[str, Exercise] = {
    "9.6": Value(
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
    "9.7": Value(
        kind="compute",
        right=_waiting,
        unit="s",
        accuracy=0.01,
        mistakes={
            "That is the time of one position; both have to be waited for.": lambda: _waiting() / 2,
            "So it would be after half a turn. A smaller turn leaves less of the Earth's rate in "
            "the difference.": lambda: _waiting(1.0),
            "The difference of a vector and the turned one is twice the sine of half the turn, not "
            "of the turn, and not its cosine.": lambda: _waiting(0.5),
            "That is the noise alone. The turn is not known exactly, and the drifts change.": (
                lambda: _waiting(click=0.0, change=0.0)
            ),
            "The change of the drifts counts as well.": lambda: _waiting(change=0.0),
            "The turn is not known exactly, and half of its error goes into the heading.": (
                lambda: _waiting(click=0.0)
            ),
            "Of the turn's error half goes into the heading, not all of it.": (
                lambda: _waiting(click=CLICK)
            ),
            "A change of the drift is shared by both positions: half of it counts.": (
                lambda: _waiting(change=CHANGE)
            ),
            "So it would be if the readings of one position alone told the heading. It takes the "
            "noise of both.": lambda: 2 * _waiting(),
        },
        remark="The turn's error takes a fixed part: no waiting gets below half of it.",
    ),
}
