"""Exercises of chapter 16: one triad through all four papers."""

from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import slider
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE as LATITUDE, SCHULER_PERIOD, TURN
from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import drift_per_revolution
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.motion.vehicle import smooth_step, vehicle_trajectory

from .experiments import (
    AXES,
    MISALIGNMENT,
    NON_ORTHOGONALITY,
    aligned_heading_error,
    bent_triad,
)

PUZZLE: FloatArray = np.array([[0, -30 * arcsecond, 0], [0, 0, 0], [0, 0, 0]])
BENT = bent_triad(NON_ORTHOGONALITY, MISALIGNMENT)
PARTS_OF_PERIOD = (0.25, 0.5, 1.0)


def _tilt(matrix: FloatArray, turn: float) -> FloatArray:
    """Tilt (2,) about North and East that a turn from North leaves behind, rad."""
    k12, k32 = matrix[[0, 2], 1]
    sine, missing = np.sin(turn), 1 - np.cos(turn)
    return np.array([-k12 * sine - k32 * missing, k12 * missing - k32 * sine])


def _east(matrix: FloatArray, turn: float) -> float:
    return float(_tilt(matrix, turn)[1])


def _size(matrix: FloatArray, turn: float) -> float:
    return float(np.linalg.norm(_tilt(matrix, turn)))


def _half_turn(of_tilt: Callable[[FloatArray, float], float] = _east) -> list[float]:
    """How many times more a half turn leaves than a quarter, for both triads."""
    return [abs(of_tilt(m, np.pi) / of_tilt(m, QUARTER_TURN)) for m in (PUZZLE, BENT)]


def _steps(latitude: float) -> FloatArray:
    """Of the puzzle's triad: largest drift in a turn, aligned heading error, and first swing."""
    headings = np.radians(np.arange(0.0, 360.0))
    aligned = aligned_heading_error(PUZZLE, headings, latitude)
    gain = np.sqrt(gravity(latitude) / EARTH_RADIUS) / (EARTH_RATE * np.cos(latitude))
    largest = [np.abs(part).max() for part in (drift_per_revolution(AXES, PUZZLE), aligned)]
    return np.array([*largest, gain * _east(PUZZLE, QUARTER_TURN)])


def _growth(from_latitude: float, to_latitude: float) -> FloatArray:
    """How many times more they are at the northern latitude, degrees."""
    return _steps(float(np.radians(to_latitude))) / _steps(float(np.radians(from_latitude)))


def _ratio(function: np.ufunc, from_latitude: float, to_latitude: float) -> float:
    """How many times more a function of the latitude is at the northern place."""
    return float(function(np.radians(to_latitude)) / function(np.radians(from_latitude)))


def _some_places(rng: np.random.Generator) -> dict[str, float]:
    return {
        "from_latitude": round(rng.uniform(30, 50), 1),
        "to_latitude": round(rng.uniform(70, 78), 1),
    }


def _slider(about_forward: float = 1.0, right_gyro: float = 1.0) -> float:
    """Misalignment about the right axis, in arc seconds, with which a quarter turn leaves no swing.

    The arguments are the sign of the misalignment about forward in K_32, and the weight of K_32.
    """
    k32 = NON_ORTHOGONALITY[2] + about_forward * MISALIGNMENT[0]
    return float((NON_ORTHOGONALITY[0] - right_gyro * k32) / arcsecond)


def _after_turns(count: int, gap: float) -> float:
    """Largest heading error in a period after turns by 90 degrees, their middles `gap` s apart."""
    interval, (begin, length) = 8.0, TURN
    last = begin + (count - 1) * gap + length
    times = interval * np.arange(round((last + SCHULER_PERIOD) / interval) + 2)
    turned = sum(smooth_step(times, begin + i * gap, length) for i in range(count))
    way = vehicle_trajectory(
        LATITUDE, np.zeros((len(times), 2)), QUARTER_TURN * np.asarray(turned), interval=interval
    )
    run = simulate_gyrocompass(way, way.increments.mean_rate @ PUZZLE.T, speed_log=True)
    swing = (run.times > last) & (run.times <= last + SCHULER_PERIOD)
    return float(np.abs(run.heading_error[swing]).max())


@cache
def _one_turn() -> float:
    return _after_turns(1, 0.0)


@cache
def _four_turns() -> tuple[float, ...]:
    return tuple(_after_turns(4, part * SCHULER_PERIOD) / _one_turn() for part in PARTS_OF_PERIOD)


def _by_phases(turn: float = QUARTER_TURN) -> list[float]:
    """The same if the swings only added up, each tilt turned by `turn` against the one before."""
    tilt = complex(*_tilt(PUZZLE, QUARTER_TURN)[::-1])  # about East and about North
    number, time = np.arange(4), np.linspace(0.0, 2 * np.pi, 361)[:, np.newaxis]
    found = []
    for part in PARTS_OF_PERIOD:
        swings = np.cos(time - 2 * np.pi * part * number)
        east = (swings * tilt * np.exp(1j * turn * number)).sum(axis=1).real
        found.append(float(np.abs(east).max() / abs(tilt.real)))
    return found


ROLL = ("K_11", "K_21", "K_31", "gamma")


def _some_roll(rng: np.random.Generator) -> tuple[float, ...]:
    return (*rng.uniform(-1.0, 1.0, 3), rng.uniform(0.3, 1.0))


def _rolled(_: float, k21: float, k31: float, roll: float) -> float:
    """Tilt about the level right axis after a roll."""
    return float(-(k21 * (1 - np.cos(roll)) + k31 * np.sin(roll)))


EXERCISES: dict[str, Exercise] = {
    "16.1": Value(
        kind="predict",
        right=_half_turn,
        absolute=0.15,
        mistakes={
            "So the tilt grows as a whole. The heading feels the swing about East alone.": (
                lambda: _half_turn(_size)
            ),
            "For the puzzle's triad. In the other one the right gyro leans as well, and what it "
            "does to the East tilt is undone by the second quarter of the turn.": (
                lambda: [_half_turn()[0]] * 2
            ),
            "The two triads are not alike: begin with the one that has only one entry in the "
            "second column.": lambda: _half_turn()[::-1],
            "The forward gyro makes more and more of an East tilt up to the half turn.": (
                lambda: [_half_turn()[1]] * 2
            ),
        },
        remark="K_12 goes with 1 - cos of the turn, K_32 with its sine.",
    ),
    "16.2": Choice(
        kind="explain",
        right="abf",
        wrong={
            "c": "is what a drift does that is fixed in the body. Here the false rate turns with "
            "the true one: it is the level part of the Earth's rate, seen from an axis aside.",
            "d": "needs an entry in the second column. A triad turned about Up feels a turn about "
            "Up as it is.",
            "e": "cannot be: a triad turned as a whole is a good triad with other axes, and it "
            "does not drift.",
        },
        remark="An error that the ship can calibrate herself, with one landmark.",
    ),
    "16.3": Value(
        kind="compute",
        given=GivenNumbers(
            book={"from_latitude": 51.5, "to_latitude": 75.0},
            draw=_some_places,
            units={"from_latitude": "degrees", "to_latitude": "degrees"},
        ),
        right=_growth,
        accuracy=0.02,
        mistakes={
            "The tilt that the turn leaves has nothing to do with the Earth; only the level rate, "
            "against which it is read, shrinks.": (
                lambda **at: [1, _ratio(np.tan, **at), _ratio(np.tan, **at)]
            ),
            "At the quay the gyro leans into the Earth's rate about Up, and this part grows.": (
                lambda **at: [1, 1 / _ratio(np.cos, **at), 1 / _ratio(np.cos, **at)]
            ),
            "At the quay, too, something changes: the rate about Up grows, the level one falls.": (
                lambda **at: [1, 1, 1 / _ratio(np.cos, **at)]
            ),
            "A turntable turns as fast at any latitude.": (
                lambda **at: [
                    1 / _ratio(np.cos, **at),
                    _ratio(np.tan, **at),
                    1 / _ratio(np.cos, **at),
                ]
            ),
            "That is the way back to the South. Northward the level rate shrinks.": (
                lambda **at: 1 / _growth(**at)
            ),
            "The swing is read against the level rate, which goes with the cosine and not the "
            "sine.": lambda **at: [1, _ratio(np.tan, **at), 1 / _ratio(np.sin, **at)],
        },
        remark="The bend is the same everywhere; what it is measured against is not.",
    ),
    "16.4": Value(
        kind="slide",
        right=_slider,
        unit="arc seconds",
        absolute=13.0,
        from_panel=slider(
            "turn_right",
            "Begin with the preset `Bent and turned` and move the slider `about right` alone.",
            **{"pair_0": -30.0, "pair_1": 20.0, "pair_2": 30.0, "turn_forward": 20.0},
            **{"turn_up": 25.0, "turn": 90.0},
        ),
        mistakes={
            "That is the value of the preset, with which a turn to the East leaves no swing.": (
                lambda: _slider(right_gyro=-1.0)
            ),
            "That makes the forward gyro's entry vanish; the right gyro makes an East tilt too.": (
                lambda: _slider(right_gyro=0.0)
            ),
            "Look at the sign of the misalignment about forward in K_32.": (
                lambda: _slider(about_forward=-1.0)
            ),
        },
    ),
    "16.5": Value(
        kind="compute",
        right=_four_turns,
        absolute=0.05,
        mistakes={
            "So the swings add up if each keeps to its line. On the turning Earth that line turns "
            "too, slowly, and the sum shows it.": _by_phases,
            "Each turn begins at another heading; its tilt points a quarter of a turn farther.": (
                lambda: _by_phases(0.0)
            ),
            "That is in degrees; give multiples of what one turn leaves.": (
                lambda: np.degrees(_one_turn()) * np.array(_four_turns())
            ),
        },
    ),
    "16.6": Formula(
        kind="compute",
        arguments=ROLL,
        draw=_some_roll,
        right=_rolled,
        mistakes={
            "A drift tilts the modelled horizon the other way: look at the sign.": (
                lambda *roll: -_rolled(*roll)
            ),
            "The right gyro's axis rolls too: its false rate does not stay level.": (
                lambda k11, k21, k31, roll: -k31 * roll
            ),
            "The upper axis leans sideways in a roll, and its false rate has a level part then.": (
                lambda k11, k21, k31, roll: -k31 * np.sin(roll)
            ),
            "Look at the side to which the upper axis leans in a positive roll.": (
                lambda k11, k21, k31, roll: k21 * (1 - np.cos(roll)) - k31 * np.sin(roll)
            ),
            "That is the tilt about the line of the bow; give the one about the level line to "
            "the right.": lambda k11, k21, k31, roll: -k11 * roll,
            "The first index is the gyro that errs, the second the axis of the turn: the upper "
            "gyro and the right one have changed places.": (
                lambda k11, k21, k31, roll: _rolled(k11, k31, k21, roll)
            ),
        },
        remark="A function of the roll alone: when the ship is upright again, it is gone.",
    ),
}
