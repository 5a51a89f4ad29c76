"""What a word of 32 bits does to the quaternion of a step, and to an attitude of many steps."""

from typing import NamedTuple

import numpy as np
from scipy.constants import day

from driftlab.attitude.finite_precision import UPDATES, Update, integrate_in_word, step_in_word
from driftlab.checks import FloatArray
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

EARTH_RATE = 2 * np.pi / (day * 365.2422 / 366.2422)
"""Rate of the Earth against the stars, rad/s: one turn more in a year than there are days."""
AXIS = np.array([0.6, 0.0, 0.8])
"""Of all turns, in the body."""
EARTH_SECONDS = 1.0
"""How long the body stands on the Earth, s."""
EARTH_SAMPLE_RATES: FloatArray = np.array([10.0, 30, 100, 300, 1000, 3000, 10000])
"""Sample rates on the Earth, Hz."""
NORM_STEPS = 2000
"""Steps after which the norm is computed."""
NORM_ANGLES: FloatArray = np.geomspace(1e-4, 0.1, 7)
"""Angles of these steps, rad."""
STARTS = 16
"""Attitudes at the start, over which the errors are averaged."""
ANGLES: FloatArray = np.geomspace(1e-6, 1.0, 61)
"""Angles of a single step, rad."""


class ShortWord(NamedTuple):
    """Errors of arithmetic in float32, by update in the order of `UPDATES`.

    Attributes
    ----------
    angles : ndarray, shape (m,)
        Angle of one step, rad.
    subtracted, carried : ndarray, shape (m,)
        Relative errors of 1 - l0 of the step: subtracted from the stored l0, computed by itself.
    rates : ndarray, shape (n,)
        Sample rates, Hz.
    earth : ndarray, shape (update, n)
        Error of attitude after `EARTH_SECONDS` on the Earth, rms over the starts, rad.
    step_angles : ndarray, shape (p,)
        Angles of the steps whose norm is looked at, rad.
    norms : ndarray, shape (update, p)
        Change of the norm over `NORM_STEPS` steps, rms over the starts.
    """

    angles: FloatArray
    subtracted: FloatArray
    carried: FloatArray
    rates: FloatArray
    earth: FloatArray
    step_angles: FloatArray
    norms: FloatArray


def short_word_errors(seed: int = 2014) -> ShortWord:
    """Compute the errors of one step, of a body on the turning Earth, and of a fast one's norm."""
    k = -np.tan(ANGLES[:, np.newaxis] / 4) * AXIS
    step = step_in_word(k.astype(np.float32)).astype(np.float64)
    true = 2 * np.sin(ANGLES / 4) ** 2
    # Four normal deviates have no preferred direction: uniform over all rotations.
    starts = np.random.default_rng(seed).normal(size=(STARTS, 4))
    starts /= np.linalg.norm(starts, axis=-1, keepdims=True)
    # Attitudes that the word can hold, so that what is measured is the arithmetic alone.
    starts = starts.astype(np.float32).astype(np.float64)
    return ShortWord(
        ANGLES,
        np.abs(1 - step[:, 3] - true) / true,
        np.abs(step[:, 4] - true) / true,
        EARTH_SAMPLE_RATES,
        np.array([
            [_earth_error(starts, rate, update) for rate in EARTH_SAMPLE_RATES]
            for update in UPDATES
        ]),
        NORM_ANGLES,
        np.array([[_norm_error(starts, x, update) for x in NORM_ANGLES] for update in UPDATES]),
    )  # fmt: skip


def _earth_error(starts: FloatArray, rate: float, update: Update) -> float:
    steps = round(EARTH_SECONDS * rate)
    found = _end(starts, EARTH_RATE / rate, steps, update)
    true = multiply(starts, from_rotation_vector(EARTH_RATE * steps / rate * AXIS))
    return _rms(rotation_angle(multiply(conjugate(true), found)))


def _norm_error(starts: FloatArray, angle: float, update: Update) -> float:
    found = _end(starts, angle, NORM_STEPS, update)
    return _rms(np.linalg.norm(found, axis=-1) / np.linalg.norm(starts, axis=-1) - 1)


def _end(starts: FloatArray, angle: float, steps: int, update: Update) -> FloatArray:
    """Last attitude (STARTS, 4) after equal steps by `angle` in rad."""
    # Picard's third iterate; about a fixed axis it has no other error than that of its series.
    increments = np.tile(angle / 2 * AXIS, (2 * steps, 1))
    found = integrate_in_word(increments, "two-step-4", start=starts, update=update)[:, -1]
    return found.astype(np.float64)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
