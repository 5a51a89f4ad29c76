"""Exercises of chapter 17: real triads. None of them needs a recording."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.constants import arcsecond, degree, hour

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import slider
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.noise_terms import NoiseTerms

CROSSING, NOISE = 8.0, NoiseTerms(300 * arcsecond, 1 * degree / np.sqrt(hour))
"""Of 17.3: where the lines are to cross, s, and the noise with which the panel opens."""

WANTED = 0.1 * degree
"""Of 17.5: the deviation of the heading that is wanted."""


def _after_the_turn(added: FloatArray) -> FloatArray:
    """Attitude error in degrees about x and about z if the direction of the rate is steady."""
    angle = float(np.linalg.norm(added))
    return ((angle - 360) / angle * added)[[0, 2]]


def _some_hand(rng: np.random.Generator) -> dict[str, FloatArray]:
    # As in the book: a negative turn, and more than a whole one, as what is said of the slips has.
    across = rng.choice([-1, 1], 2) * rng.uniform([0.1, 4], [0.4, 9])
    return {"added": np.round([-rng.uniform(362.5, 374), *across], 2)}


def _two_senses(
    there: float, time_there: float, back: float, time_back: float, with_times: bool = True
) -> FloatArray:
    """n^T Sigma n, and the offset in degrees a second."""
    if not with_times:
        time_there = time_back = (time_there + time_back) / 2
    offset = (there + back) / (time_there + time_back)
    return np.array([(there - offset * time_there) / 360 - 1, offset])


def _some_phone(rng: np.random.Generator) -> dict[str, float]:
    turn = 360 * (1 + rng.choice([-1, 1]) * rng.uniform(1e-3, 1e-2))
    offset = rng.uniform(0.1, 0.4)  # positive, as what is said of the slips has it
    first, second = round(rng.uniform(10, 13), 1), round(rng.uniform(14, 18), 1)
    there, back = (round(float(s * turn + offset * t), 2) for s, t in ((1, first), (-1, second)))
    return {"there": there, "time_there": first, "back": back, "time_back": second}


def _quantisation(height: float = np.sqrt(3)) -> float:
    """Quantisation in arc seconds whose line, `height` Q / time, crosses the other where wanted."""
    return float(NOISE.angle_random_walk * np.sqrt(CROSSING) / height / arcsecond)


def _from_first(power: float) -> float:
    """The same by a law that the time of the crossing goes with that power of Q."""
    first = 3 * (NOISE.quantisation / NOISE.angle_random_walk) ** 2
    return float(NOISE.quantisation * (CROSSING / first) ** (1 / power) / arcsecond)


def _error_matrix(T: FloatArray, scales: FloatArray, counts: int) -> FloatArray:
    """Ours: what T and the diagonal matrix of the scales leave to be inverted."""
    return np.linalg.inv(T @ np.diag(scales)) / counts - np.eye(3)


def _not_inverted(T: FloatArray, scales: FloatArray, counts: int) -> FloatArray:
    return T @ np.diag(scales) * counts - np.eye(3)


def _some_unit(rng: np.random.Generator) -> dict[str, Any]:
    """Like the Xsens unit of the chapter, with two entries larger than the rest."""
    T = np.eye(3)
    places, signs = rng.permutation(np.argwhere(T == 0)), rng.choice([-1, 1], 6)
    sizes = rng.uniform([0.04, 0.02, *4 * [0.001]], [0.06, 0.03, *4 * [0.01]])
    T[tuple(places.T)] = np.round(signs * sizes, 3)
    counts = round(rng.uniform(4730, 4830))
    scales = np.round(1 / counts + rng.permutation([-1e-6, 0, 1e-6]), 6)
    return {"T": T, "scales": scales, "counts": counts}


def _standing(
    latitude: float,
    lean: float,
    random_walk: float,
    *,
    told_by: Callable[[float], float] = np.cos,
    squares: bool = True,
) -> float:
    """Hours until lean and noise together make the wanted error.

    The heading is told by a function of the latitude times the Earth's rate. Without `squares`
    lean and noise are added as they are.
    """
    allowed = WANTED * EARTH_RATE * told_by(latitude * degree)
    a, b = lean * degree, random_walk * degree / np.sqrt(hour)
    if squares:  # (a / T)^2 + b^2 / T = allowed^2, quadratic in T
        time = (b**2 + np.sqrt(b**4 + 4 * a**2 * allowed**2)) / (2 * allowed**2)
    else:  # a / T + b / sqrt(T) = allowed, quadratic in sqrt(T)
        time = ((b + np.sqrt(b**2 + 4 * a * allowed)) / (2 * allowed)) ** 2
    return float(time / hour)


def _some_car(rng: np.random.Generator) -> dict[str, float]:
    # As in the book the lean alone takes about ten times as long as the noise alone.
    lean = round(rng.uniform(0.03, 0.09), 3)
    random_walk = round(float(np.sqrt(lean * rng.uniform(1.7e-3, 2.5e-3))), 4)
    return {"latitude": round(rng.uniform(28, 34), 1), "lean": lean, "random_walk": random_walk}


EXERCISES: dict[str, Exercise] = {
    "17.1": Value(
        kind="predict",
        given=GivenNumbers(
            book={"added": np.array([-367.20, 0.15, 6.40])},
            draw=_some_hand,
            units={"added": "degrees, about x, y and z"},
        ),
        right=_after_the_turn,
        unit="degrees",
        absolute=0.2,
        mistakes={
            "Angles about different axes do not add up: the rotation about z was spent in all "
            "directions of the room while the sensor turned about x.": (
                lambda added: added[[0, 2]] + [360.0, 0.0]
            ),
            "That is the whole angle. The sensor is back, so a whole turn of it is true.": (
                lambda added: added[[0, 2]]
            ),
            "The sensor has turned in the negative sense about x, and its gyro says too much.": (
                lambda added: -_after_the_turn(added)
            ),
            "About z that is nearly so. About x more is left than nothing: the gyro has said more "
            "than a whole turn.": lambda added: np.zeros(2),
        },
        remark="Compare the three turns of the chapter, and how steady a hand must be for this.",
    ),
    "17.2": Value(
        kind="compute",
        given=GivenNumbers(
            book={"there": 364.20, "time_there": 12.0, "back": -356.05, "time_back": 15.0},
            draw=_some_phone,
            units={"there": "degrees", "time_there": "s", "back": "degrees", "time_back": "s"},
        ),
        right=_two_senses,
        absolute=(5e-5, 0.003),
        mistakes={
            "The mean of both takes the offset out if both last equally long. These do not.": (
                lambda **turns: _two_senses(**turns, with_times=False)
            ),
            "That is the number of degrees beyond a whole turn; Larin's number is a part of the "
            "turn.": lambda **turns: _two_senses(**turns) * [360.0, 1.0],
            "One turn alone has the offset in it.": (
                lambda **turns: np.array([turns["there"] / 360 - 1, _two_senses(**turns)[1]])
            ),
            "In the turn back the angle is negative and the offset is not: look at its sign.": (
                lambda **turns: _two_senses(**turns) * [1.0, -1.0]
            ),
            "An angle over 2π is what is asked; this is an angle in radians.": (
                lambda **turns: _two_senses(**turns) * [2 * np.pi, 1.0]
            ),
        },
        remark="Both are found from two turns. A third would say how far to trust them.",
    ),
    "17.3": Value(
        kind="slide",
        right=_quantisation,
        unit="arc seconds",
        absolute=30.0,
        from_panel=slider(
            "quantisation",
            "Begin with the preset `Puzzle: two that fall` and move the slider `quantisation` "
            "alone.",
            **{"walk": 1.0, "flicker": 0, "rate_walk": 0, "ramp": 0, "length": 10.0},
        ),
        mistakes={
            "The line of the quantisation has the height of its coefficient at the root of three "
            "seconds, not at one.": lambda: _quantisation(height=1.0),
            "The crossing goes with the square of the quantisation.": lambda: _from_first(1.0),
            "That is the way to a later crossing.": lambda: _from_first(-2.0),
        },
        remark="Shorter than the crossing the angle is what is noisy, longer it is the rate.",
    ),
    "17.4": Value(
        kind="compute",
        given=GivenNumbers(
            book={
                "T": np.array([[1, 0.006, 0.001], [0.008, 1, -0.054], [0.025, -0.003, 1]]),
                "scales": np.array([0.000209, 0.000210, 0.000209]),
                "counts": 4778,
            },
            draw=_some_unit,
            units={"scales": "on the diagonal of IMU-TK's K", "counts": "of one radian a second"},
        ),
        right=_error_matrix,
        accuracy=1e-3,
        mistakes={
            "T K takes what is measured to what is true. Ours goes the other way.": (_not_inverted),
            "To first order so. The entries are large enough for their products to count: invert "
            "the matrix.": lambda **unit: -_not_inverted(**unit),
            "The counts are scaled first and made orthogonal then, so the inverses stand the other "
            "way round.": (  # Transposed, the product of two has its factors exchanged.
                lambda **unit: _error_matrix(**{**unit, "T": unit["T"].T}).T
            ),
            "Rows and columns have changed places.": (lambda **unit: _error_matrix(**unit).T),
            "That is I + K; the unit matrix is still in it.": (
                lambda **unit: _error_matrix(**unit) + np.eye(3)
            ),
            "That is the non-orthogonality alone: the scales have errors too.": (
                lambda **unit: np.linalg.inv(unit["T"]) - np.eye(3)
            ),
        },
        remark="To first order it is a change of sign. The products are in the third digit.",
    ),
    "17.5": Value(
        kind="compute",
        given=GivenNumbers(
            book={"latitude": 34.2, "lean": 0.05, "random_walk": 0.01},
            draw=_some_car,
            units={
                "latitude": "degrees",
                "lean": "degrees",
                "random_walk": "degrees per root of an hour",
            },
        ),
        right=_standing,
        unit="h",
        accuracy=0.02,
        mistakes={
            "So long it takes for the lean alone; the noise of the gyro is there as well.": (
                lambda **car: _standing(**{**car, "random_walk": 0.0})
            ),
            "So long it takes for the noise alone; the lean is there as well, and is much more.": (
                lambda **car: _standing(**{**car, "lean": 0.0})
            ),
            "Not the whole rate of the Earth tells where North is, only its level part.": (
                lambda **car: _standing(**car, told_by=lambda latitude: 1.0)
            ),
            "The sine of the latitude gives the part of the Earth's rate about Up; North is told "
            "by the level part.": lambda **car: _standing(**car, told_by=np.sin),
            "Lean and noise have nothing to do with each other: their squares add up.": (
                lambda **car: _standing(**car, squares=False)
            ),
        },
        remark="Twice as good a gyro would hardly shorten it. Another way of looking does.",
    ),
    "17.6": Choice(
        kind="explain",
        right="acd",
        wrong={
            "b": "takes a row that follows from its data for one that is true. What stands in the "
            "data without being a rest is in the row, and in no deviation.",
            "e": "is likely and not certain. Another rule leaves other moves out, and whoever "
            "leaves out what does not fit has small residuals.",
            "f": "takes the wrong measure. The deviation says how far a calibration may be from "
            "the truth; two calibrations of one record share its noise, and whatever else is in "
            "it.",
        },
        remark="Fair to a table is who says what was tried, and what was not.",
    ),
}
