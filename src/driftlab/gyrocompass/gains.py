"""Gains by which a computed horizon follows the accelerometers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from driftlab.checks import one_pull, positive_number
from driftlab.earth import EARTH_RADIUS


class Gains(NamedTuple):
    """Gains by which the horizon follows the accelerometers.

    Attributes
    ----------
    proportional : float
        k1, rad/s for each m/s^2.
    integral : float
        k2, rad/s^2 for each m/s^2.

    Examples
    --------
    >>> Gains(proportional=0.0, integral=1e-5)
    Gains(proportional=0.0, integral=1e-05)
    """

    proportional: float
    integral: float


def schuler_gains(radius: float = EARTH_RADIUS) -> Gains:
    """Gains of Schuler tuning, which has no ballistic error: k1 = 0 and k2 = 1/R.

    Parameters
    ----------
    radius : float
        R of the Earth, m.

    Returns
    -------
    Gains
        With the period of 84 minutes of a pendulum of the Earth's radius.

    Examples
    --------
    >>> gains = schuler_gains()
    >>> round(2 * np.pi / float(np.sqrt(9.8 * gains.integral)) / 60, 1)  # period, minutes
    84.4
    """
    return Gains(0.0, 1 / positive_number(radius, "radius"))


def damped_gains(
    natural_frequency: float, gravity: float, damping: float = float(np.sqrt(0.5))
) -> Gains:
    """Gains of a damped horizon, for accelerated alignment.

    Parameters
    ----------
    natural_frequency : float
        wn, rad/s.
    gravity : float
        g, m/s^2.
    damping : float
        Damping ratio zeta, without unit.

    Returns
    -------
    Gains
        k1 = 2 zeta wn/g and k2 = wn^2/g.

    Examples
    --------
    >>> gains = damped_gains(0.01, 9.8)
    >>> f"{gains.proportional:.2e} {gains.integral:.2e}"
    '1.44e-03 1.02e-05'
    """
    frequency = positive_number(natural_frequency, "natural_frequency")
    pull, ratio = one_pull(gravity), positive_number(damping, "damping")
    return Gains(2 * ratio * frequency / pull, frequency * frequency / pull)
