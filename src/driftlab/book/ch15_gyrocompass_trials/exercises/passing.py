"""Exercises 15.4 and 15.5: what damping costs, and how much of it passes."""

from functools import cache

import numpy as np
from scipy.constants import degree, hour, minute

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.reading import slider
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.gyrocompass.type_test import COARSE, Gyrocompass, marine_type_test

DRIFT, EACH_START, WALK = (
    0.05 * degree / hour,
    0.01 * degree / hour,
    0.0003 * degree / np.sqrt(hour),
)
"""Of the level gyros as the panel opens, rad/s and rad/sqrt(s)."""
RATIOS = tuple(round(0.05 * stop, 2) for stop in range(21))
"""The stops of the panel's slider."""
MANOEUVRES = ("change of speed", "turn")


@cache
def _shares() -> dict[str, FloatArray]:
    """Share of each limit by damping ratio, of the panel's compass without a log."""
    noise = GyroNoise(white=WALK, gauss_markov=EACH_START, interval=1.0)
    tests = []
    for ratio in RATIOS:
        compass = Gyrocompass((0.0, 0.0, DRIFT), noise, damping=ratio, alignment_time=minute)
        tests.append(marine_type_test(compass, SARATOV_LATITUDE, steps=COARSE).shares)
    return {name: np.array([shares[name] for shares in tests]) for name in tests[0]}


def _heaviest(*tests: str) -> float:
    """Largest damping ratio with which these tests are passed."""
    kept = np.all([_shares()[name] <= 1 for name in tests], axis=0)
    return RATIOS[np.flatnonzero(kept)[-1]]


EXERCISES: dict[str, Exercise] = {
    "15.4": Choice(
        kind="explain",
        right="abc",
        wrong={
            "d": "is not so: the first error grows with the ratio; what heavy damping shortens is "
            "what comes after it.",
            "e": "is not so: the damping takes the difference of what is felt and what the log "
            "gives, and a constant error has no rate. It is in the speed error.",
            "f": "is not so: a constant drift is read in full, damped or not.",
        },
        remark="Damping compares two accelerations; what both have, it cannot take for a tilt.",
    ),
    "15.5": Value(
        kind="slide",
        right=lambda: _heaviest(*_shares()),
        absolute=0.01,
        from_panel=slider(
            "damping",
            "Begin with the preset `Damped without a log` and change the damping ratio alone.",
            **{"drift": 0.05, "gauss_markov": 0.01, "walk": 0.0003, "alignment": 1.0},
            **{"latitude": 51.5, "speed": 70.0, "log": False},
        ),
        mistakes={
            "With this one the turn passes, and the change of speed does not.": (
                lambda: _heaviest("turn")
            ),
            "At the quay all is well with it; look at the two manoeuvres.": (
                lambda: _heaviest(*(name for name in _shares() if name not in MANOEUVRES))
            ),
            "Undamped it keeps all limits, but a little damping does so too.": lambda: 0.0,
        },
        remark="Light damping passes, and a swing then takes hours to die out. A log spares you "
        "the choice.",
    ),
}
