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

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.integration import step_quaternions

from .checks import (
    FloatArray,
    finite_arrays,
    finite_number,
    unit_quaternions,
    whole_number,
)
from .earth import (
    EARTH_RATE,
    checked_latitude,
    geodetic,
    gravitation,
    ground_velocity,
    position_vector,
)
from .frames import local_axes
from .imu import increment_rows
from .quaternion import conjugate, cumulative_product, multiply, rotate
from .vectors import cross

CHUNK = 40.0
"""Seconds of motion over which the fixed point on gravitation runs at once."""
_LONGEST = 20.0  # s: interval for which the fixed point still settles quickly
_SETTLED = 1e-7  # m: change of the position at which the fixed point stops


class Navigation(NamedTuple):
    """Where a unit is, how it moves and stands; each with the same leading axes.

    Attributes
    ----------
    latitude, longitude : ndarray, shape (...)
        rad; longitudes from -pi to pi.
    altitude : ndarray, shape (...)
        m above the ellipsoid.
    velocity : ndarray, shape (..., 3)
        m/s against the Earth: East, North, Up.
    attitude : ndarray, shape (..., 4)
        Body to East, North, Up.
    """

    latitude: FloatArray
    longitude: FloatArray
    altitude: FloatArray
    velocity: FloatArray
    attitude: FloatArray


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
    to_inertial = local_axes(start.latitude, np.zeros_like(start.longitude))
    first = multiply(to_inertial, start.attitude)[..., np.newaxis, :]
    attitude = multiply(first, cumulative_product(step_quaternions(angle, "two-step-4")))
    before = np.concatenate(
        [np.broadcast_to(first, (*attitude.shape[:-2], 1, 4)), attitude[..., :-1, :]], axis=-2
    )
    pushes = rotate(before, velocity_of_pairs(angle, velocity))
    position = position_vector(start.latitude, start.altitude)
    speed = rotate(to_inertial, start.velocity) + ground_velocity(position)
    positions, speeds = np.empty_like(pushes), np.empty_like(pushes)
    size = max(1, int(CHUNK / (2 * seconds)))
    for begin in range(0, pushes.shape[-2], size):
        rows = np.s_[..., begin : begin + size, :]
        positions[rows], speeds[rows] = _fall(position, speed, pushes[rows], 2 * seconds)
        position, speed = positions[rows][..., -1, :], speeds[rows][..., -1, :]
        if hold_altitude:
            position, speed = _at_altitude(position, speed, start.altitude)
    chosen = np.s_[..., every // 2 - 1 :: every // 2, :]
    times = every * seconds * np.arange(1, count // every + 1)
    found = _to_local(positions[chosen], speeds[chosen], attitude[chosen], start.longitude, times)
    if not hold_altitude:
        return found
    height = np.broadcast_to(start.altitude[..., np.newaxis], found.altitude.shape)
    return found._replace(altitude=height, velocity=found.velocity * np.array([1.0, 1.0, 0.0]))


def last_of(states: Navigation) -> Navigation:
    """Return the last state (...) of a row of states (..., n)."""
    return Navigation(
        states.latitude[..., -1],
        states.longitude[..., -1],
        states.altitude[..., -1],
        states.velocity[..., -1, :],
        states.attitude[..., -1, :],
    )


def velocity_of_pairs(angle: FloatArray, velocity: FloatArray) -> FloatArray:
    """Velocity increments (..., n // 2, 3) of pairs, in the body axes at the start of each pair.

    With g1, g2, v1, v2 the increments of a pair, p = g1 + g2 + 2/3 g1×g2 is its rotation vector and
    v = v1 + v2. Under a constant rate and force the body's turn adds p×v/2 + p×(p×v)/6 + ...; where
    they change there is sculling, s = 2/3 (g1×v2 + v1×g2), which is turned by p/2 in its turn.
    """
    # Components first, so that everything but a cross product is plain arithmetic.
    angles, velocities = np.moveaxis(angle, -1, 0), np.moveaxis(velocity, -1, 0)
    g1, g2, v1, v2 = (row[..., i::2] for row in (angles, velocities) for i in (0, 1))
    p = g1 + g2 + (2 / 3) * cross(g1, g2)
    v = v1 + v2
    sculling = (2 / 3) * (cross(g1, v2) + cross(v1, g2))
    once = cross(p, v)
    twice = cross(p, once)
    pairs = v + once / 2 + twice / 6 + cross(p, twice) / 24 + sculling + cross(p, sculling) / 2
    return np.moveaxis(pairs, 0, -1)


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


def _fall(
    position: FloatArray, speed: FloatArray, pushes: FloatArray, step: float
) -> tuple[FloatArray, FloatArray]:
    """Inertial positions and velocities (..., n, 3) after each step of one chunk.

    `pushes` (..., n, 3) are the velocity increments of the accelerometers in inertial axes. The
    fixed point: where gravitation is known along the way, two sums give the way.
    """
    position, speed = position[..., np.newaxis, :], speed[..., np.newaxis, :]
    times = step * np.arange(1, pushes.shape[-2] + 1)[:, np.newaxis]
    here = gravitation(position)
    coasting = speed + np.cumsum(pushes, axis=-2)
    free = position + _integral(coasting, speed, step)
    places = free + 0.5 * here * times**2
    # An error of the way comes back as one of gravitation, at most 2 g/R times as large.
    contraction = float(times[-1, 0]) ** 2 * 1.6e-6
    while True:
        pull = _integral(gravitation(places), here, step)
        settled = free + _integral(pull, 0.0, step)
        change = np.abs(settled - places).max()
        places = settled
        if not change * contraction > _SETTLED:
            return places, coasting + pull


def _integral(values: FloatArray, first: FloatArray | float, step: float) -> FloatArray:
    """Integral by the trapezoid rule up to each of `values` (..., n, 3), `first` before them."""
    return step * (np.cumsum(values, axis=-2) + 0.5 * (first - values))


def _at_altitude(
    position: FloatArray, speed: FloatArray, altitude: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Inertial position and velocity (..., 3) put to an altitude, moving along the level."""
    latitude, longitude, found = geodetic(position)
    up = np.broadcast_to(np.array([0.0, 0.0, 1.0]), position.shape)
    up = rotate(local_axes(latitude, longitude), up)
    climb = np.einsum("...i,...i->...", speed, up)
    return (
        position + (altitude - found)[..., np.newaxis] * up,
        speed - climb[..., np.newaxis] * up,
    )


def _to_local(
    position: FloatArray,
    speed: FloatArray,
    attitude: FloatArray,
    start_longitude: FloatArray,
    times: FloatArray,
) -> Navigation:
    """From inertial to local axes; `times` (n,) in s since the axes were one in longitude."""
    latitude, inertial_longitude, altitude = geodetic(position)
    to_local = conjugate(local_axes(latitude, inertial_longitude))
    longitude = start_longitude[..., np.newaxis] + inertial_longitude - EARTH_RATE * times
    return Navigation(
        latitude,
        (longitude + np.pi) % (2 * np.pi) - np.pi,
        altitude,
        rotate(to_local, speed - ground_velocity(position)),
        multiply(to_local, attitude),
    )
