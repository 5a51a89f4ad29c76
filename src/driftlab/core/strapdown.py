"""Strapdown navigation in Earth-centred inertial axes: the arithmetic of `driftlab.strapdown`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray

from .attitude import attitudes
from .coning import ConingSteps
from .earth import (
    EARTH_RATE,
    geodetic,
    gravitation,
    ground_velocity,
    local_axes,
    position_vector,
)
from .quaternion import conjugate, multiply, rotate
from .sculling import velocity_of_steps

CHUNK = 40.0
"""Seconds of motion over which the fixed point on gravitation runs at once."""
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


def navigate(
    start: Navigation,
    angle: FloatArray,
    velocity: FloatArray,
    interval: float,
    algorithm: ConingSteps,
    *,
    every: int = 2,
    hold_altitude: bool = False,
) -> Navigation:
    """Carry a state along increments (..., n, 3) by an algorithm that makes a step of two."""
    size = steps_at_once(interval)
    to_inertial = local_axes(start.latitude, np.zeros_like(start.latitude))
    first = multiply(to_inertial, start.attitude)
    attitude = attitudes(algorithm, angle, first=first)
    first = first[..., np.newaxis, :]
    before = np.concatenate(
        [np.broadcast_to(first, (*attitude.shape[:-2], 1, 4)), attitude[..., :-1, :]], axis=-2
    )
    pushes = rotate(before, velocity_of_steps(algorithm, angle, velocity))
    position = position_vector(start.latitude, start.altitude)
    speed = rotate(to_inertial, start.velocity) + ground_velocity(position)
    # One of the parts alone may have leading axes; what does not depend on it is computed once.
    lead = np.broadcast_shapes(
        pushes.shape[:-2], position.shape[:-1], speed.shape[:-1], start.longitude.shape
    )
    positions, speeds = np.empty((2, *lead, *pushes.shape[-2:]))
    for begin in range(0, pushes.shape[-2], size):
        rows = np.s_[..., begin : begin + size, :]
        positions[rows], speeds[rows] = _fall(position, speed, pushes[rows], 2 * interval)
        position, speed = positions[rows][..., -1, :], speeds[rows][..., -1, :]
        if hold_altitude:
            position, speed = _at_altitude(position, speed, start.altitude)
    chosen = np.s_[..., every // 2 - 1 :: every // 2, :]
    times = every * interval * np.arange(1, angle.shape[-2] // every + 1)
    found = _to_local(positions[chosen], speeds[chosen], attitude[chosen], start.longitude, times)
    if not hold_altitude:
        return found
    height = np.broadcast_to(start.altitude[..., np.newaxis], found.altitude.shape).copy()
    return found._replace(altitude=height, velocity=found.velocity * np.array([1.0, 1.0, 0.0]))


def steps_at_once(interval: float) -> int:
    """Steps of two increments of this interval in a `CHUNK`."""
    return max(1, int(CHUNK / (2 * interval)))


def final_state(states: Navigation) -> Navigation:
    """Return the last state (...) of a row of states (..., n), which need not be kept for it."""
    return Navigation(
        states.latitude[..., -1].copy(),
        states.longitude[..., -1].copy(),
        states.altitude[..., -1].copy(),
        states.velocity[..., -1, :].copy(),
        states.attitude[..., -1, :].copy(),
    )


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
