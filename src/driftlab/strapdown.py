"""Strapdown navigation: attitude, velocity and position from the increments of an inertial unit.

Local axes are East, North, Up; attitude quaternions map body components to them. The computation
runs in Earth-centred inertial axes, where nothing but gravitation has to be added to what the
accelerometers say. Attitudes are then one cumulative product and velocities one cumulative sum;
only gravitation needs the position, and a few rounds of a fixed point settle that for half a minute
of motion at once. So an hour of flight takes some hundred NumPy calls on long arrays.

A step is a pair of increments: the coning correction is that of `two-step-4` of chapter 06, and the
velocity is corrected for rotation and sculling in the same way.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import ALGORITHMS

from .checks import (
    finite_arrays,
    finite_number,
    unit_quaternions,
    whole_number,
)
from .core import strapdown as core
from .core.strapdown import Navigation, last_of
from .earth import checked_latitude
from .imu import increment_rows

__all__ = ["Navigation", "at_rest", "last_of", "navigate"]

ALGORITHM = ALGORITHMS["two-step-4"]
"""The attitude algorithm of the navigation; its step is a pair of increments."""
_LONGEST = 20.0  # s: interval for which the fixed point still settles quickly


def at_rest(
    latitude: ArrayLike, attitude: ArrayLike, longitude: ArrayLike = 0.0, altitude: ArrayLike = 0.0
) -> Navigation:
    """Return the state of a unit that stands on the Earth: angles in rad, altitude in m.

    The attitude (..., 4), body to East, North, Up, is brought to unit norm.
    """
    place = finite_arrays(
        latitude=(latitude,),
        longitude=(longitude,),
        altitude=(altitude,),
        attitude=(unit_quaternions(attitude, "attitude"), 4),
    )
    checked_latitude(latitude)
    leading = np.broadcast_shapes(*(a.shape for a in place[:3]), place[3].shape[:-1])
    here = [np.broadcast_to(array, leading) for array in place[:3]]
    return Navigation(
        here[0],
        here[1],
        here[2],
        np.zeros((*leading, 3)),
        np.broadcast_to(place[3], (*leading, 4)),
    )


def navigate(
    start: Navigation,
    angle_increments: ArrayLike,
    velocity_increments: ArrayLike,
    interval: float,
    *,
    every: int = 2,
    hold_altitude: bool = False,
) -> Navigation:
    """Carry a state along the increments of gyros and accelerometers.

    Parameters
    ----------
    start : Navigation
        State before the first increment, leading axes (...).
    angle_increments, velocity_increments : array_like, shape (..., n, 3)
        Integrals of angular rate (rad) and specific force (m/s) in body axes over equal intervals.
        They must be true integrals, as from integrating sensors.
    interval : float
        Length of the intervals, s.
    every : int
        Increments between two results; even, because a step is made of two, and a divisor of n.
    hold_altitude : bool
        Put altitude and vertical velocity back to the start's altitude and to zero every `CHUNK`
        seconds, as a barometer would, and in all results. Without help a computed altitude runs
        away within an hour.

    Returns
    -------
    Navigation
        States (..., n // every) after each `every` increments.

    Raises
    ------
    ValueError
        If shapes do not fit, n is not a multiple of `every`, or the start is at a pole.
    """
    seconds = finite_number(interval, "interval")
    if not 0 < seconds <= _LONGEST:
        raise ValueError(
            f"interval: expected a positive time of at most {_LONGEST:g} s, got {interval!r}."
        )
    start = _checked(start)
    angle, velocity = increment_rows(angle_increments, velocity_increments)
    count = angle.shape[-2]
    if count % 2:
        raise ValueError(f"angle_increments: expected an even number of rows, got {count}.")
    if whole_number(every, "every", least=2) % 2 or count % every:
        raise ValueError(
            f"every: expected an even divisor of the number of increments, {count}, got {every!r}."
        )
    return core.navigate(
        start, angle, velocity, seconds, ALGORITHM, every=every, hold_altitude=hold_altitude
    )


def _checked(state: Navigation) -> Navigation:
    """Return the state as arrays, refusing what is not one by the name of the field."""
    latitude, longitude, altitude, velocity, attitude = finite_arrays(
        latitude=(state.latitude,),
        longitude=(state.longitude,),
        altitude=(state.altitude,),
        velocity=(state.velocity, 3),
        attitude=(unit_quaternions(state.attitude, "attitude"), 4),
    )
    return Navigation(checked_latitude(latitude), longitude, altitude, velocity, attitude)
