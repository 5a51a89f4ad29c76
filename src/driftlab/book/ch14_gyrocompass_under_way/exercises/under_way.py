"""Exercises 14.1 to 14.6: the errors of a compass on a voyage."""

from functools import cache

import numpy as np
from scipy.constants import arcminute, degree, hour

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import slider
from driftlab.book.scenarios import (
    QUARTER_TURN,
    SARATOV_LATITUDE as LATITUDE,
    SCHULER_PERIOD,
    SPEED,
    SPEED_UP,
    ship_manoeuvre,
)
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE, gravity
from driftlab.gyrocompass.heading_error import coriolis_correction, speed_error
from driftlab.gyrocompass.simulation import simulate_gyrocompass

from ..experiments import GYRO_BIAS, TUNING_FACTORS

GRAVITY = float(gravity(LATITUDE))
TO_THE_EAST = {"course": -QUARTER_TURN, "turn": 0.0}
"""A voyage without a turn."""
LOG_ERROR = 0.1
HOURS = 2.0
"""Of 14.4: the length of the voyage."""


@cache
def _to_the_east() -> FloatArray:
    """Speed error, tilt after gathering way, mean tilt over the next swing: arc minutes."""
    run = simulate_gyrocompass(ship_manoeuvre(**TO_THE_EAST), np.zeros(3))
    begin = sum(SPEED_UP)
    after = np.searchsorted(run.times, begin)
    swing = (run.times > begin) & (run.times <= begin + SCHULER_PERIOD)
    tilts = run.tilt[after], run.tilt[swing].mean(axis=0)
    return np.array([abs(run.speed_error[after]), *np.linalg.norm(tilts, axis=-1)]) / arcminute


def _guess(speed_error_angle: float = 0.0, gathering: float = 0.0, even: float = 1.0) -> FloatArray:
    """Answer to 14.1 in arc minutes; the tilt on an even way counts in U sin(latitude) v/g."""
    hanging = even * EARTH_RATE * np.sin(LATITUDE) * SPEED / GRAVITY
    return np.array([speed_error_angle, gathering, hanging]) / arcminute


def _to_the_north() -> float:
    return float(-speed_error(LATITUDE, [SPEED, 0.0]))


def _plumb_line() -> float:
    """Largest lean of the plumb line while the ship gathers way, rad."""
    pushed = ship_manoeuvre(**TO_THE_EAST, interval=1.0).increments.velocity
    return float(np.abs(pushed[:, 0] / pushed[:, 1]).max())


def _wrong_log() -> float:
    """How many times more the log's error does to the speed error than to the mean tilt."""
    right, wrong = [SPEED, 0.0], [SPEED + LOG_ERROR, 0.0]
    turned = speed_error(LATITUDE, wrong) - speed_error(LATITUDE, right)
    pushed = coriolis_correction(LATITUDE, wrong) - coriolis_correction(LATITUDE, right)
    return float(np.abs(turned) / (np.linalg.norm(pushed) / GRAVITY))


def _heading_and_yaw(latitude: float, growth: float) -> FloatArray:
    """Errors in degrees at the quay with a gyro bias about East that grows, degrees an hour²."""
    quay = ship_manoeuvre(latitude * degree, speed=0.0, turn=0.0)
    bias = np.zeros_like(quay.increments.angle)
    # None in the interval that the alignment reads.
    bias[:, 2] = growth * degree / hour**2 * quay.times[:-1]
    run = simulate_gyrocompass(quay, bias)
    return np.degrees([run.heading_error[-1], run.yaw_error[-1]])


def _no_swing(growth: float, share: float) -> list[float]:
    """Answer to 14.4 if the last drift stood against this share of the Earth's rate."""
    return [growth * HOURS / hour / (EARTH_RATE * share), 0.0]


def _some_quay(rng: np.random.Generator) -> dict[str, float]:
    return {"latitude": round(rng.uniform(53, 60), 1), "growth": round(rng.uniform(8e-3, 2e-2), 3)}


@cache
def _voyages() -> FloatArray:
    """Heading errors (tunings, times) of the panel's first preset."""
    factors = TUNING_FACTORS
    return np.array(
        [
            simulate_gyrocompass(ship_manoeuvre(), GYRO_BIAS, tuning_factor=k).heading_error
            for k in factors
        ]
    )


def _best_tuning() -> float:
    return TUNING_FACTORS[int(np.argmin(np.abs(_voyages()).max(axis=1)))]


def _best_at_the_end() -> float:
    return TUNING_FACTORS[int(np.argmin(np.abs(_voyages()[:, -1])))]


CHAPTER_NAMES = {"phi": "varphi", "gravity": "g", "v1": "v_1", "v3": "v_3"}
"""What the symbols are called in the code of the chapter."""

HANGING = ("U", "varphi", "g", "R", "v_1", "v_3")


def _some_way(rng: np.random.Generator) -> tuple[float, ...]:
    # Real sizes: a term of the order R U²/g, which is first order too, is small on the Earth only.
    earth, place, pull = rng.uniform([5e-5, 0.3, 9.7], [9e-5, 1.2, 9.9])
    return earth, place, pull, rng.uniform(6.3e6, 6.4e6), *rng.uniform(-20.0, 20.0, 2)


def _hangs(earth: float, place: float, pull: float, _: float, north: float, east: float) -> float:
    """Tilt about East on an even way without a log."""
    return -earth * np.sin(place) * east / pull


EXERCISES: dict[str, Exercise] = {
    "14.1": Value(
        kind="predict",
        right=_to_the_east,
        unit="arc minutes",
        absolute=0.015,
        mistakes={
            "The way North turns the level rate aside. A way East has the direction of the Earth's "
            "own turn: it makes the level rate longer and does not turn it.": (
                lambda: _guess(_to_the_north())
            ),
            "The plumb line leans, but the tuned horizon does not follow it.": (
                lambda: _guess(gathering=_plumb_line())
            ),
            "On an even way there is a Coriolis force, and a part of it looks like a tilt.": (
                lambda: _guess(even=0.0)
            ),
            "That is the largest tilt, or the one for the whole Coriolis force; the horizon swings "
            "about the middle.": lambda: _guess(even=2.0),
            "Not the cosine: on a level way the Coriolis force that is level comes from the part "
            "of the Earth's rate about Up.": (lambda: _guess(even=1 / np.tan(LATITUDE))),
        },
        remark="The speed error asks for the way North, the Coriolis tilt for the speed alone.",
    ),
    "14.2": Choice(
        kind="explain",
        right="abd",
        wrong={
            "c": "does not fit the brackets: a tilt about East is in the one for North, with "
            "the factor of the velocity North. The one for East has only its rate.",
            "e": "is not so: both channels have the same gains, and the same period.",
            "f": "forgets the factor of the second bracket, which grows with the velocity North.",
        },
        remark="A compass reads a rate; what swings quickly against the Earth shows most.",
    ),
    "14.3": Value(
        kind="compute",
        right=_wrong_log,
        accuracy=0.03,
        mistakes={
            "A horizon that is not in balance swings out twice as far as it hangs; the mean is "
            "asked, and on a way North half of the Coriolis force is no tilt.": (
                lambda: _wrong_log() / 2
            ),
            "That is the ratio of the tilt to the speed error; give the other one.": (
                lambda: 1 / _wrong_log()
            ),
            "Not the sine: the speed error is divided by the level part of the Earth's rate.": (
                lambda: _wrong_log() / np.tan(LATITUDE)
            ),
            "Not the cosine: the Coriolis force that is level comes from the part of the Earth's "
            "rate about Up.": lambda: _wrong_log() * np.tan(LATITUDE),
            "A Coriolis force is an acceleration; it becomes a tilt when it is divided by g.": (
                lambda: _wrong_log() / GRAVITY
            ),
        },
        remark="A poor log is good enough for the horizon, and not for the speed error.",
    ),
    "14.4": Value(
        kind="compute",
        given=GivenNumbers(
            book={"latitude": 51.5, "growth": 0.01},
            draw=_some_quay,
            units={"latitude": "degrees", "growth": "degrees an hour, in every hour"},
        ),
        right=_heading_and_yaw,
        unit="degrees",
        absolute=(0.002, 5e-4),
        mistakes={
            "That is the other way round: the yaw hardly notices a drift about East.": (
                lambda **quay: _heading_and_yaw(**quay)[::-1]
            ),
            "That is the drift over the level rate. A drift that grows also makes the horizon "
            "swing.": lambda latitude, growth: _no_swing(growth, np.cos(latitude * degree)),
            "Sine for cosine, and no swing: North is told by the level part of the Earth's rate.": (
                lambda latitude, growth: _no_swing(growth, np.sin(latitude * degree))
            ),
            "Only the level part of the Earth's rate tells where North is; and there is a swing.": (
                lambda latitude, growth: _no_swing(growth, 1.0)
            ),
            "That is the angle by which the gyro has drifted. Gravity holds the horizon; the drift "
            "goes into the correction, in which North is read.": (
                lambda latitude, growth: [growth * HOURS**2 / 2, 0.0]
            ),
        },
    ),
    "14.5": Value(
        kind="slide",
        right=_best_tuning,
        absolute=0.01,
        from_panel=slider(
            "tuning",
            "Begin with the preset `Small drifts, a turn` and change the tuning alone.",
            **{"latitude": 51.5, "speed": 10.0, "course": 0.0, "turn": 90.0, "tilt": 0.0},
            **{"gyro_forward": 0.01, "gyro_up": 0.03, "gyro_right": 0.01, "log": False},
            damping=0.0,
        ),
        mistakes={
            "That is Schuler's own. On this voyage another stop of the slider has a smaller "
            "largest error.": lambda: 1.0,
            "The right side of Schuler's, but too far: now the acceleration tilts the horizon.": (
                lambda: 0.8
            ),
            "That has the smallest error at the end; look for the largest on the way.": (
                _best_at_the_end
            ),
        },
    ),
    "14.6": Formula(
        kind="compute",
        arguments=HANGING,
        aliases=CHAPTER_NAMES,
        draw=_some_way,
        right=_hangs,
        accuracy=5e-3,
        mistakes={
            "Look at the sign: the tilt must take away from the force that the way makes.": (
                lambda *way: -_hangs(*way)
            ),
            "That is the whole Coriolis force. Half of it is wanted: the horizon falls behind the "
            "meridian, so its level rates must change.": lambda *way: 2 * _hangs(*way),
            "The horizon falls behind the meridian: with the other sign of that, the correction "
            "would need a force the other way.": lambda *way: 3 * _hangs(*way),
            "The Coriolis force of a way North points East or West, and so tilts about North.": (
                lambda u, place, pull, r, v1, v3: _hangs(u, place, pull, r, v3, v1)
            ),
            "The level Coriolis force comes from the part of the Earth's rate about Up.": (
                lambda *way: _hangs(*way) / np.tan(way[1])
            ),
            "A force is not yet a tilt: g is missing.": lambda *way: _hangs(*way) * way[2],
            "Without acceleration there is still a force: the axes turn.": lambda *way: 0.0,
        },
        remark="On every course the tilt is about the line of the way itself.",
    ),
}
