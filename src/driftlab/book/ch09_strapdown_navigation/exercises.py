"""Exercises of chapter 09: strapdown navigation."""

from __future__ import annotations

import numpy as np
from scipy.constants import degree, g, hour, micro

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import STATIC_ERROR_SOURCES, static_error_modes

PUSH = 100 * micro * g


def _swing(cause: str) -> float:
    """Amplitude of the Schuler oscillation of the position for a cause of size one, m."""
    modes = static_error_modes(TABLE_LATITUDE)
    place = STATIC_ERROR_SOURCES.index(cause)
    waves = modes.cosine[1:, 5:, place], modes.sine[1:, 5:, place]
    return float(np.sqrt(sum((wave**2).sum() for wave in waves)))


def _equal_swing() -> float:
    """Bias of an East gyro that swings as far as the accelerometer, degrees per hour."""
    swung = PUSH * _swing("accelerometer bias East")
    return swung / _swing("gyro bias East") / (degree / hour)


EXERCISES: dict[str, Exercise] = {
    "9.1": Choice(
        kind="predict",
        right="ade",
        wrong={
            "b": "leaves gravity out. As the computed place moves off, the computed level turns "
            "with it, and gravity then pulls back. What remains is an offset and a swing.",
            "c": "leaves the Earth's rate out. With a wrong azimuth the computer expects a part of "
            "it about East that is not there, as if the East gyro had a bias.",
            "f": "is what two plain integrations say. With gravity it is the other way round: "
            "compute both after an hour.",
        },
        remark="Gravity restores the level channels and destroys the vertical one.",
    ),
    "9.2": Value(
        kind="slide",
        right=_equal_swing,
        accuracy=0.06,
        mistakes={
            "The accelerometer's amplitude and the gyro's are exchanged in the ratio.": (
                lambda: (0.01**2) / _equal_swing()
            ),
            "This is the ratio of the two amplitudes; multiply it by the 0.01 °/h that you set.": (
                lambda: _equal_swing() / 0.01
            ),
            "This is in radians per second.": lambda: _equal_swing() * degree / hour,
        },
        remark="It is the accelerometer bias over g, times the Schuler rate.",
    ),
    "9.3": Formula(
        kind="compute",
        arguments=("h_0", "T", "g", "R"),
        draw=lambda rng: tuple(rng.uniform(0.5, 2, 4)),  # in any units; none overflows
        right=lambda h_0, T, g, R: h_0 * np.cosh(T * np.sqrt(2 * g / R)),
        mistakes={
            "Gravity falls by 2g/R per metre: the distance from the centre is squared.": (
                lambda h_0, T, g, R: h_0 * np.cosh(T * np.sqrt(g / R))
            ),
            "The error starts with no velocity, so half of it belongs to the mode that decays.": (
                lambda h_0, T, g, R: h_0 * np.exp(T * np.sqrt(2 * g / R))
            ),
            "In the end this is right; at the start it is half of the error.": (
                lambda h_0, T, g, R: h_0 * np.exp(T * np.sqrt(2 * g / R)) / 2
            ),
            "This is a swing: it never gets larger than it was at the start. The feedback of the "
            "altitude has the other sign.": (
                lambda h_0, T, g, R: h_0 * np.cos(T * np.sqrt(2 * g / R))
            ),
        },
        remark="A metre becomes a kilometre in 72 minutes.",
    ),
    "9.4": Formula(
        kind="compute",
        arguments=("q", "T"),
        draw=lambda rng: (rng.uniform(1e-5, 1e-2), rng.uniform(10, 600)),
        right=lambda q, T: q * np.sqrt(T**3 / 3),
        mistakes={
            "This is the standard deviation of the velocity.": lambda q, T: q * np.sqrt(T),
            "This would hold if the velocity had its final error from the beginning.": (
                lambda q, T: q * np.sqrt(T) * T
            ),
            "This is the variance.": lambda q, T: q**2 * T**3 / 3,
            "Half of velocity times time holds for a constant acceleration. Add up variances: "
            "an early kick has the time T to act, a late one hardly any.": (
                lambda q, T: q * np.sqrt(T) * T / 2
            ),
            "The variance of a sum of independent kicks was taken for the square of their sum.": (
                lambda q, T: q * T**2 / 2
            ),
        },
        remark="With 5 µg/√Hz it is about a centimetre after a minute. A bias of 50 µg makes 0.9 m "
        "in the same time.",
    ),
    "9.5": Formula(
        kind="compute",
        arguments=("e_N", "e_U", "ell"),
        draw=lambda rng: (*rng.uniform(-1e-7, 1e-7, 2), rng.uniform(-1.4, 1.4)),
        right=lambda e_N, e_U, ell: e_N * np.cos(ell) + e_U * np.sin(ell),
        mistakes={
            "The sign: a gyro that shows too much turns the computed axes too far, ahead of the "
            "Earth, and the computer believes that it moves East.": (
                lambda e_N, e_U, ell: -(e_N * np.cos(ell) + e_U * np.sin(ell))
            ),
            "Sine and cosine are exchanged: at the equator the Earth's axis points North.": (
                lambda e_N, e_U, ell: e_N * np.sin(ell) + e_U * np.cos(ell)
            ),
            "This is the component across the Earth's axis in the meridian. It goes round in a "
            "day, and comes back.": lambda e_N, e_U, ell: e_N * np.sin(ell) - e_U * np.cos(ell),
            "This is the speed to the East over the Earth's radius. A degree of longitude is "
            "shorter than that.": (
                lambda e_N, e_U, ell: (e_N * np.cos(ell) + e_U * np.sin(ell)) * np.cos(ell)
            ),
            "This is how it begins, for an hour or two. In the long run the vertical bias counts "
            "as well.": lambda e_N, e_U, ell: e_N / np.cos(ell),
            "You have divided by the cosine of the latitude. A rate about the Earth's axis is a "
            "rate of the longitude already.": lambda e_N, e_U, ell: e_N + e_U * np.tan(ell),
            "The sign of the vertical bias: North of the equator the Earth's axis points up, so "
            "both biases turn the same way about it.": (
                lambda e_N, e_U, ell: e_N * np.cos(ell) - e_U * np.sin(ell)
            ),
        },
        remark="It is the part along the Earth's axis, the only one that a day does not turn "
        "round. With a ratio of minus the tangent of the latitude nothing runs away.",
    ),
    "9.6": Choice(
        kind="explain",
        right="ade",
        wrong={
            "b": "asks for too much. A zero velocity says that the push of gravity along the tilt "
            "and the bias cancel. Their sum is found, and each alone is not.",
            "c": "removes the velocity that the tilt has made and leaves the tilt. Until the next "
            "stop the tilt makes as much again.",
            "f": "has a limit that no number of stops removes: an East gyro bias and an azimuth "
            "error have the same effect.",
        },
        remark="The filter gains from what it was never shown: the covariance says how each "
        "unmeasured error goes with the velocity.",
    ),
}
