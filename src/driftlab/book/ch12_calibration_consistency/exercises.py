"""Exercises of chapter 12: is the calibration as good as it says?"""

from dataclasses import replace
from functools import cache

import numpy as np

from driftlab.book.ch11_kalman_calibration.experiments import QUICK_TRIAL
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.imu import ImuNoise
from driftlab.monte_carlo import mean_square_bounds

TOLD = ImuNoise(reference_velocity=0.005)
MISINFORMED = replace(QUICK_TRIAL, assumed_noise=TOLD)
RUNS = 60


@cache
def _mean_nis() -> float:
    """Mean squared normalised innovation, over its degrees of freedom, of a misinformed filter."""
    trial = MISINFORMED.run(np.random.default_rng(8), RUNS)
    return float(trial.calibration.nis.mean()) / 3


def _runs_needed(factor: float = 1.1, confidence: float = 0.95) -> list[int]:
    """Least numbers of runs whose upper bound lies below the mean to expect: 27 states, 3."""
    return [
        next(n for n in range(1, 1000) if mean_square_bounds(m, n, confidence)[1] / m < factor**2)
        for m in (27, 3)
    ]


EXERCISES: dict[str, Exercise] = {
    "12.1": Choice(
        kind="predict",
        right="cf",
        wrong={
            "a": "makes a bias wrong by several σ and the squares too large by less than one per "
            "cent. One calibration cannot show so little.",
            "b": "is explained by the filter as a constant bias and a tilt. With 1 cm/s the rest "
            "drowns in the velocity noise.",
            "d": "is of second order, and the filter takes it for scale-factor errors of the "
            "accelerometers. What the model explains, rightly or wrongly, leaves no innovation.",
            "e": "makes the squares too small: the filter expects more noise than there is.",
        },
        remark="Innovations show what contradicts the model, if the assumed noise does not hide "
        "it.",
    ),
    "12.2": Value(
        kind="slide",
        right=_runs_needed,
        absolute=[0.5, 2.5],
        mistakes={
            "The mean to expect was taken for 1.1. Squares are compared: it is 1.21.": (
                lambda: _runs_needed(1.1**0.5)
            ),
            "The two numbers are exchanged: 27 components in each run say more than three.": (
                lambda: _runs_needed()[::-1]
            ),
        },
        remark="Nine times as many components need nine times fewer runs, more or less.",
    ),
    "12.3": Formula(
        kind="compute",
        arguments=("m", "N"),
        draw=lambda rng: (float(rng.integers(1, 31)), float(rng.integers(2, 200))),
        right=lambda m, N: np.sqrt(2 / (m * N)),
        mistakes={
            "This is the variance of the mean.": lambda m, N: 2 / (m * N),
            "The deviation of a mean was taken to fall like the number of runs. It is its variance "
            "that does.": lambda m, N: np.sqrt(2 / m) / N,
            "This is for a single run.": lambda m, N: np.sqrt(2 / m),
            "The mean has not been divided by the number of states yet.": (
                lambda m, N: np.sqrt(2 * m / N)
            ),
            "The square of a normal number has another variance than the number itself.": (
                lambda m, N: 1 / np.sqrt(m * N)
            ),
        },
        remark="Units that err badly make the true spread larger than that.",
    ),
    "12.4": Value(
        kind="compute",
        right=_mean_nis,
        accuracy=0.055,
        mistakes={
            "Twice the deviation is four times the variance, and squares are compared here.": (
                lambda: MISINFORMED.noise.reference_velocity / TOLD.reference_velocity
            ),
            "This would hold if the velocity noise were all. In the innovation there is also what "
            "the filter does not know of its own velocity, and that is told rightly.": (
                lambda: (MISINFORMED.noise.reference_velocity / TOLD.reference_velocity) ** 2
            ),
            "This is what a filter finds that is told the truth.": lambda: 1.0,
            "The mean has not been divided by the three components yet.": lambda: 3 * _mean_nis(),
        },
        remark="This test needs no truth: it works on a real table as well.",
    ),
    "12.5": Formula(
        kind="compute",
        arguments=("r", "omega"),
        draw=lambda rng: (float(rng.uniform(0.01, 0.1)), float(rng.uniform(0.05, 0.5))),
        right=lambda r, omega: 2 * r * omega,
        mistakes={
            "This is the acceleration of one accelerometer, not a velocity.": (
                lambda r, omega: r * omega**2
            ),
            "This is how fast the accelerometer itself moves. It stops with the table.": (
                lambda r, omega: r * omega
            ),
            "This is one accelerometer alone; there are two, and their forces are at right "
            "angles.": lambda r, omega: np.sqrt(2) * r * omega,
            "The force turns with the body: it does not add up along one direction.": (
                lambda r, omega: np.sqrt(2) * r * omega * np.pi / 2
            ),
            "An arm common to all three would leave nothing. Here each has its own.": (
                lambda r, omega: 0.0
            ),
        },
        remark="With three centimetres and ten degrees a second it is a centimetre a second.",
    ),
    "12.6": Choice(
        kind="explain",
        right="abd",
        wrong={
            "c": "repeats the mistake as well. What depends on the turns, as lever arms do, makes "
            "the same error in the same turns.",
            "e": "has it the wrong way round: with a larger assumed noise every innovation is "
            "divided by more, and the test becomes weaker.",
            "f": "counts the data of the record twice. The second pass starts from the prior of "
            "the first.",
        },
        remark="A test can only find what the model and the assumed noise leave to be seen.",
    ),
}
