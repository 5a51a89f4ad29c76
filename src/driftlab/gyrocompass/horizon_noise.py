"""White gyro noise in the rate of the gyrocompass's horizon, damped or Schuler-tuned."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    one_pull,
    positive_number,
    shown,
)
from driftlab.earth import EARTH_RADIUS


def settled_deviation(
    angle_random_walk: float, natural_frequency: float, damping: float = float(np.sqrt(0.5))
) -> float:
    """Standard deviation of the rate of a damped horizon under white gyro noise, once settled.

    The rate is `LevelFrame.rate`, the integral part. The noise passes a second-order low-pass
    filter.

    Parameters
    ----------
    angle_random_walk : float
        N, rad/sqrt(s).
    natural_frequency : float
        wn of `damped_gains`, rad/s.
    damping : float
        zeta of `damped_gains`, without unit.

    Returns
    -------
    float
        N sqrt(wn/(4 zeta)), rad/s.

    Examples
    --------
    >>> f"{settled_deviation(1e-6, 0.01):.2e}"
    '5.95e-08'
    """
    frequency = positive_number(natural_frequency, "natural_frequency")
    ratio = positive_number(damping, "damping")
    walk = _checked_walk(angle_random_walk)
    return float(walk * np.sqrt(frequency / (4 * ratio)))


def swing_deviation(
    angle_random_walk: float, time: ArrayLike, gravity: float, radius: float = EARTH_RADIUS
) -> FloatArray:
    r"""Standard deviation of the rate of a Schuler-tuned horizon under white gyro noise.

    The rate is `LevelFrame.rate`, from a horizon without error. Nothing damps the oscillation, so
    it grows with the square root of the time.

    Parameters
    ----------
    angle_random_walk : float
        N, rad/sqrt(s).
    time : array_like, shape (...)
        Since the start, s.
    gravity : float
        g, m/s^2.
    radius : float
        R of the Earth, m.

    Returns
    -------
    ndarray, shape (...)
        rad/s.

    Raises
    ------
    ValueError
        If a time is negative.

    Notes
    -----
    With the Schuler frequency ws:

    .. math:: N \omega_s \sqrt{\frac{t}{2} - \frac{\sin 2 \omega_s t}{4 \omega_s}},
              \qquad \omega_s^2 = \frac{g}{R}

    Examples
    --------
    >>> one, four = swing_deviation(1e-6, [36000.0, 144000.0], 9.8)
    >>> round(float(four / one), 1)
    2.0
    """
    t, walk = finite_array(time, "time"), _checked_walk(angle_random_walk)
    if t.min() < 0:
        raise ValueError(f"time: expected times from 0 on, got {t.min():g} s.")
    schuler = np.sqrt(one_pull(gravity) / positive_number(radius, "radius"))
    swing = t / 2 - np.sin(2 * schuler * t) / (4 * schuler)
    deviation: FloatArray = walk * schuler * np.sqrt(np.maximum(swing, 0.0))
    return deviation


def _checked_walk(angle_random_walk: float) -> float:
    walk = finite_number(angle_random_walk, "angle_random_walk")
    if walk < 0:
        raise ValueError(f"angle_random_walk: expected a number of at least 0, got {shown(walk)}.")
    return walk
