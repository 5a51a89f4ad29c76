"""One gyro answers late: a body that shakes about a fixed axis looks as if it went round a cone."""

import numpy as np
from scipy.constants import milli

from driftlab.attitude.coning_algorithms import AnyAlgorithm
from driftlab.attitude.integration import integrate
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number
from driftlab.quaternion import to_rotation_vector

SWING = float(np.radians(1.0))
"""Amplitude of the shaking, rad."""
SHAKING_FREQUENCY = 20.0
"""Of the shaking, Hz."""
LATE = 0.1 * milli
"""Delay of the second gyro, s."""
SAMPLE_RATE = 100
"""Of both gyros, Hz."""
DELAYS: FloatArray = np.geomspace(1e-6, 1e-2, 41)
"""Delays of the curves, s."""


def late_increments(
    late: float,
    swing: float = SWING,
    frequency: float = SHAKING_FREQUENCY,
    rate: float = SAMPLE_RATE,
    seconds: float = 20.0,
) -> FloatArray:
    """Increments (n, 3) of a body that shakes about the axis halfway between gyros 1 and 2.

    The second gyro answers late by so many seconds.
    """
    ends, around = np.arange(round(seconds * rate) + 1) / rate, 2 * np.pi * frequency
    component = swing / np.sqrt(2)
    first, second = (component * np.sin(around * (ends - delay)) for delay in (0.0, late))
    return np.diff(np.stack([first, second, 0 * ends], axis=-1), axis=0)


def pseudo_drift(algorithm: AnyAlgorithm, late: float, **shaking: float) -> float:
    """Apparent drift about the third axis, rad/s, in twenty seconds."""
    found = integrate(late_increments(late, seconds=20.0, **shaking), algorithm)[-1]
    return float(to_rotation_vector(found)[2] / 20.0)


def pseudo_coning(
    late: float = LATE,
    swing: float = SWING,
    frequency: float = SHAKING_FREQUENCY,
    sample_rate: float = SAMPLE_RATE,
) -> DataTable:
    """Compute the ellipse that the late gyro makes, and the drift over the delay."""
    delay, size = positive_number(late, "late"), positive_number(swing, "swing")
    often = positive_number(frequency, "frequency")
    rate = positive_number(sample_rate, "sample_rate")
    phase, lag = np.linspace(0, 2 * np.pi, 181), 2 * np.pi * often * delay
    first, second = size / np.sqrt(2) * np.sin([phase, phase - lag])
    shaking = {"swing": size, "frequency": often, "rate": rate}
    drifts = {
        name: np.array([abs(pseudo_drift(name, each, **shaking)) for each in DELAYS])
        for name in ("picard-1", "two-step-4")
    }
    ellipse = np.pi * size**2 / 2 * np.abs(np.sin(2 * np.pi * often * DELAYS)) * often
    return DataTable(
        {
            "along": ((first + second) / np.sqrt(2), "deg", "summed, along the axis of shaking"),
            "across": ((second - first) / np.sqrt(2), "arcsec", "summed, across it"),
            "delay": (DELAYS, "s", "of the second gyro"),
            "drift": (drifts, "deg_per_h", "apparent drift"),
            "ellipse": (ellipse, "deg_per_h", "area of the ellipse, so many times a second"),
        },
        {
            "late": (delay, "s", "delay of the ellipse that is drawn"),
            "swing": (size, "deg", "amplitude of the shaking"),
            "frequency": (often, "Hz", "frequency of the shaking"),
            "sample_rate": (rate, "Hz", "sample rate"),
        },
    )
