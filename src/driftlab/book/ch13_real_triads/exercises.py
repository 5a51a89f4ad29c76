"""Exercises of chapter 13: real triads. None of them needs a recording."""

import numpy as np
from scipy.constants import arcsecond, degree, hour

from driftlab.book.machinery.answers import Choice, Value
from driftlab.book.machinery.exercise import Exercise
from driftlab.book.machinery.reading import slider
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.noise_terms import NoiseTerms

ADDED_UP = (-367.20, 0.15, 6.40)
"""Of 13.1: what three gyros add up to in one turn by hand, degrees."""

THERE, BACK = (364.20, 12.0), (-356.05, 15.0)
"""Of 13.2: what a gyro adds up to in a turn there and in one back, degrees, and the times, s."""

MISALIGNMENT = np.array([[1, 0.006, 0.001], [0.008, 1, -0.054], [0.025, -0.003, 1]])
SCALES = np.array([0.000209, 0.000210, 0.000209])
COUNTS = 4778
"""Of 13.4: T and the diagonal of K, and the counts of one rad/s; like those of the Xsens unit."""

CROSSING, NOISE = 8.0, NoiseTerms(300 * arcsecond, 1 * degree / np.sqrt(hour))
"""Of 13.3: where the lines are to cross, s, and the noise with which the panel opens."""

LEAN, WALK, WANTED = 0.05 * degree, 0.01 * degree / np.sqrt(hour), 0.1 * degree
"""Of 13.5: lean of the car, angle random walk of the gyro that points East, heading wanted."""
LATITUDE = np.radians(34.2)


def _after_the_turn() -> FloatArray:
    """Attitude error in degrees about x and about z if the direction of the rate is steady."""
    added = np.array(ADDED_UP)
    angle = float(np.linalg.norm(added))
    return ((angle - 360) / angle * added)[[0, 2]]


def _two_senses(with_times: bool = True) -> FloatArray:
    """n^T Sigma n, and the offset in degrees a second."""
    (there, first), (back, second) = THERE, BACK
    if not with_times:
        first = second = (first + second) / 2
    offset = (there + back) / (first + second)
    return np.array([(there - offset * first) / 360 - 1, offset])


def _quantisation(height: float = np.sqrt(3)) -> float:
    """Quantisation in arc seconds whose line, `height` Q / time, crosses the other where wanted."""
    return float(NOISE.angle_random_walk * np.sqrt(CROSSING) / height / arcsecond)


def _from_first(power: float) -> float:
    """The same by a law that the time of the crossing goes with that power of Q."""
    first = 3 * (NOISE.quantisation / NOISE.angle_random_walk) ** 2
    return float(NOISE.quantisation * (CROSSING / first) ** (1 / power) / arcsecond)


def _true_to_measured(matrix: FloatArray) -> FloatArray:
    """Error matrix if `matrix` takes true rates to counts."""
    return matrix / COUNTS - np.eye(3)


def _standing(lean: float = 1.0, walk: float = 1.0, share: float | None = None) -> float:
    """Hours until lean and noise together make the wanted error; the two count with factors.

    The heading is told by the part `share` of the Earth's rate, or by its level part.
    """
    told = EARTH_RATE * (np.cos(LATITUDE) if share is None else share)
    allowed = WANTED * told
    # (lean / T)^2 + walk^2 / T = allowed^2, quadratic in 1 / T.
    a, b = (lean * LEAN) ** 2, (walk * WALK) ** 2
    inverse = 2 * allowed**2 / (b + np.sqrt(b**2 + 4 * a * allowed**2))
    return float(1 / (inverse * hour))


def _added_plainly() -> float:
    """The same if lean and noise are added and not their squares."""
    allowed = WANTED * EARTH_RATE * np.cos(LATITUDE)
    root = (WALK + np.sqrt(WALK**2 + 4 * allowed * LEAN)) / (2 * allowed)
    return float(root**2 / hour)


EXERCISES: dict[str, Exercise] = {
    "13.1": Value(
        kind="predict",
        right=_after_the_turn,
        unit="degrees",
        absolute=0.2,
        mistakes={
            "Angles about different axes do not add up: the rotation about z was spent in all "
            "directions of the room while the sensor turned about x.": (
                lambda: np.array(ADDED_UP)[[0, 2]] + [360.0, 0.0]
            ),
            "That is the whole angle. The sensor is back, so a whole turn of it is true.": (
                lambda: np.array(ADDED_UP)[[0, 2]]
            ),
            "The sensor has turned in the negative sense about x, and its gyro says too much.": (
                lambda: -_after_the_turn()
            ),
            "About z that is nearly so. About x more is left than nothing: the gyro has said more "
            "than a whole turn.": lambda: np.zeros(2),
        },
        remark="Compare the three turns of the chapter, and how steady a hand must be for this.",
    ),
    "13.2": Value(
        kind="compute",
        right=_two_senses,
        absolute=(5e-5, 0.003),
        mistakes={
            "The mean of both takes the offset out if both last equally long. These do not.": (
                lambda: _two_senses(with_times=False)
            ),
            "That is the number of degrees beyond a whole turn; Larin's number is a part of the "
            "turn.": lambda: _two_senses() * [360.0, 1.0],
            "One turn alone has the offset in it.": (
                lambda: np.array([THERE[0] / 360 - 1, _two_senses()[1]])
            ),
            "In the turn back the angle is negative and the offset is not: look at its sign.": (
                lambda: _two_senses() * [1.0, -1.0]
            ),
            "An angle over 2π is what is asked; this is an angle in radians.": (
                lambda: _two_senses() * [2 * np.pi, 1.0]
            ),
        },
        remark="Both are found from two turns. A third would say how far to trust them.",
    ),
    "13.3": Value(
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
    "13.4": Value(
        kind="compute",
        right=lambda: _true_to_measured(np.linalg.inv(MISALIGNMENT @ np.diag(SCALES))),
        accuracy=1e-3,
        mistakes={
            "T K takes what is measured to what is true. Ours goes the other way.": (
                lambda: MISALIGNMENT @ np.diag(SCALES) * COUNTS - np.eye(3)
            ),
            "To first order so. The entries are large enough for their products to count: invert "
            "the matrix.": lambda: np.eye(3) - MISALIGNMENT @ np.diag(SCALES) * COUNTS,
            "The counts are scaled first and made orthogonal then, so the inverses stand the other "
            "way round.": (
                lambda: _true_to_measured(np.linalg.inv(np.diag(SCALES) @ MISALIGNMENT))
            ),
            "Rows and columns have changed places.": (
                lambda: _true_to_measured(np.linalg.inv(MISALIGNMENT @ np.diag(SCALES))).T
            ),
            "That is I + K; the unit matrix is still in it.": (
                lambda: np.linalg.inv(MISALIGNMENT @ np.diag(SCALES)) / COUNTS
            ),
            "That is the non-orthogonality alone: the scales have errors too.": (
                lambda: np.linalg.inv(MISALIGNMENT) - np.eye(3)
            ),
        },
        remark="To first order it is a change of sign. The products are in the third digit.",
    ),
    "13.5": Value(
        kind="compute",
        right=_standing,
        unit="h",
        accuracy=0.02,
        mistakes={
            "So long it takes for the lean alone; the noise of the gyro is there as well.": (
                lambda: _standing(walk=0.0)
            ),
            "So long it takes for the noise alone; the lean is there as well, and is much more.": (
                lambda: _standing(lean=0.0)
            ),
            "Not the whole rate of the Earth tells where North is, only its level part.": (
                lambda: _standing(share=1.0)
            ),
            "The sine of the latitude gives the part of the Earth's rate about Up; North is told "
            "by the level part.": lambda: _standing(share=float(np.sin(LATITUDE))),
            "Lean and noise have nothing to do with each other: their squares add up.": (
                _added_plainly
            ),
        },
        remark="Twice as good a gyro would hardly shorten it. Another way of looking does.",
    ),
    "13.6": Choice(
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
