"""What `propagate_level_frame` is given, checked: the start, the gains, the azimuth rate."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, checked_instance, finite_array, finite_number
from driftlab.earth import EARTH_RATE

from .alignment_results import Alignment
from .gains import Gains
from .two_position_alignment import PositionsAlignment

_MOST_TIMES_THE_EARTH = 100.0
"""An azimuth rate beyond it, 0.4 deg/s, is hardly one of a horizon: a latitude, or degrees. A ship
at 20 m/s turns its meridian once as fast as the Earth at 85 degrees of latitude."""


def refuse_alignment(start: object) -> None:
    """Refuse the natural slip of an alignment in the place of a horizon."""
    if isinstance(start, Alignment | PositionsAlignment):
        raise ValueError(
            "start: expected a LevelFrame(attitude, rate), got an alignment; say "
            "initial_level_frame(alignment)."
        )


def loop_gains(gains: Gains, seconds: float) -> tuple[float, float]:
    """Return k1 and k2, of a horizon that follows slowly in one interval."""
    k1, k2 = (
        finite_number(value, f"gains.{name}")
        for name, value in zip(Gains._fields, checked_instance(gains, Gains, "gains"), strict=True)
    )
    # W is close to g times the tilt, so these are the loop's gains in one interval.
    loop = 9.8 * np.array([k1 * seconds, k2 * seconds**2])
    if not (loop.min() >= 0 and loop.max() <= 1):
        raise ValueError(
            "gains, increments.interval: expected a horizon that follows slowly in one interval, "
            f"with gains k1 g h and k2 g h^2 from 0 to 1, got {loop[0]:.3g} and {loop[1]:.3g}."
        )
    return k1, k2


def azimuth_rates(azimuth_rate: ArrayLike, count: int) -> FloatArray:
    """Return an azimuth rate for each interval, (..., count)."""
    rate = finite_array(azimuth_rate, "azimuth_rate")
    fastest = float(np.abs(rate).max())
    if fastest > _MOST_TIMES_THE_EARTH * EARTH_RATE:
        raise ValueError(
            "azimuth_rate: expected rad/s near U sin(latitude), at rest at most "
            f"{EARTH_RATE:.3g}, got {fastest:.3g}. Is it a latitude, or in degrees?"
        )
    return np.broadcast_to(rate, count) if rate.ndim == 0 else rate
