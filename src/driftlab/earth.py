"""The Earth under a navigator: WGS 84 ellipsoid, normal gravity, rotation.

Local axes are East, North, Up. Earth-centred axes have the third axis along the Earth's own and
are called *inertial* when they do not turn with it. Constants: NIMA TR8350.2, third edition.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays

EARTH_RATE = 7.292115e-5
"""Angular rate of the Earth, rad/s."""
SEMI_MAJOR_AXIS = 6378137.0
"""Radius at the equator, m."""
FLATTENING = 1 / 298.257223563
ECCENTRICITY_SQUARED = FLATTENING * (2 - FLATTENING)
EQUATOR_GRAVITY = 9.7803253359
POLE_GRAVITY = 9.8321849378

_GRAVITY_GROWTH = (1 - FLATTENING) * POLE_GRAVITY / EQUATOR_GRAVITY - 1
_NEAREST_TO_POLE = np.radians(89.9)
_DEEPEST = 6.2e6  # m from the centre; any point that a navigator can reach is farther


def checked_latitude(latitude: ArrayLike) -> FloatArray:
    """Return latitudes (...) in rad, refusing the poles, where East and North are not defined."""
    values = finite_array(latitude, "latitude")
    worst = float(np.abs(values).max())
    if worst > _NEAREST_TO_POLE:
        raise ValueError(
            "latitude: expected at most 89.9 degrees from the equator, because East and North are "
            f"lost at a pole, got {worst:.6g} rad, that is {np.degrees(worst):.6g} degrees."
        )
    return values


def earth_rate(latitude: ArrayLike) -> FloatArray:
    """Angular rate (..., 3) of the Earth in East, North, Up, rad/s, at latitudes (...) in rad."""
    latitude = finite_array(latitude, "latitude")
    return EARTH_RATE * np.stack(
        [np.zeros_like(latitude), np.cos(latitude), np.sin(latitude)], axis=-1
    )


def curvature_radii(latitude: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Radii of curvature (...) in m: along the meridian, and across it (the prime vertical)."""
    sine = np.sin(finite_array(latitude, "latitude"))
    squared = 1 - ECCENTRICITY_SQUARED * sine**2
    across = SEMI_MAJOR_AXIS / np.sqrt(squared)
    return across * (1 - ECCENTRICITY_SQUARED) / squared, across


def gravity(latitude: ArrayLike, altitude: ArrayLike = 0.0) -> FloatArray:
    """Normal gravity (...) in m/s^2: Somigliana's formula, linear in the altitude (...) in m."""
    latitude, altitude = finite_arrays(latitude=(latitude,), altitude=(altitude,))
    return _gravity(np.sin(latitude) ** 2, altitude)


def _gravity(sine_squared: FloatArray, altitude: FloatArray) -> FloatArray:
    surface = EQUATOR_GRAVITY * (1 + _GRAVITY_GROWTH * sine_squared)
    surface = surface / np.sqrt(1 - ECCENTRICITY_SQUARED * sine_squared)
    return surface * (1 - 2 / SEMI_MAJOR_AXIS * altitude)


def position_vector(latitude: ArrayLike, altitude: ArrayLike) -> FloatArray:
    """Vector (..., 3) in m from the Earth's centre to a point of the meridian of longitude zero."""
    latitude, altitude = finite_arrays(latitude=(latitude,), altitude=(altitude,))
    _, across = curvature_radii(latitude)
    return np.stack(
        [
            (across + altitude) * np.cos(latitude),
            np.zeros(np.broadcast_shapes(latitude.shape, altitude.shape)),
            (across * (1 - ECCENTRICITY_SQUARED) + altitude) * np.sin(latitude),
        ],
        axis=-1,
    )


def geodetic(position: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Latitude, longitude (rad) and altitude (m), each (...), of Earth-centred `position` (..., 3).

    Bowring's formula: within 1e-11 rad up to 20 km from the ellipsoid.
    """
    x, y, rho, z = _cylindrical(position)
    sine, cosine, altitude, _ = _geodetic(rho, z)
    return np.arctan2(sine, cosine), np.arctan2(y, x), altitude


def _cylindrical(position: ArrayLike) -> tuple[FloatArray, ...]:
    """Components x and y, distance from the axis, and z of positions outside the inner Earth."""
    x, y, z = np.moveaxis(finite_array(position, "position", 3), -1, 0)
    squared = x * x + y * y
    lowest = float((squared + z * z).min())
    if lowest < _DEEPEST**2:
        raise ValueError(
            f"position: expected at least {_DEEPEST:.1e} m from the Earth's centre, "
            f"got {lowest**0.5:.3g} m."
        )
    return x, y, np.sqrt(squared), z


def _geodetic(
    rho: FloatArray, z: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Sine and cosine of the latitude, altitude, and prime vertical radius; `rho` from the axis."""
    minor = SEMI_MAJOR_AXIS * (1 - FLATTENING)
    x, y = (1 - FLATTENING) * rho, z
    size = np.sqrt(x * x + y * y)
    reduced_cosine, reduced_sine = x / size, y / size
    y = z + ECCENTRICITY_SQUARED / (1 - ECCENTRICITY_SQUARED) * minor * reduced_sine**3
    x = rho - ECCENTRICITY_SQUARED * SEMI_MAJOR_AXIS * reduced_cosine**3
    size = np.sqrt(x * x + y * y)
    sine, cosine = y / size, x / size
    inverse_across = np.sqrt(1 - ECCENTRICITY_SQUARED * sine * sine) / SEMI_MAJOR_AXIS
    altitude = rho * cosine + z * sine - SEMI_MAJOR_AXIS**2 * inverse_across
    return sine, cosine, altitude, 1 / inverse_across


def gravitation(position: ArrayLike) -> FloatArray:
    """Gravitation (..., 3) in m/s^2 at Earth-centred positions (..., 3) in m.

    It is normal gravity without the centrifugal part, and does not depend on the longitude, so
    inertial axes will do as well as axes that turn with the Earth.
    """
    x, y, rho, z = _cylindrical(position)
    sine, _, altitude, across = _geodetic(rho, z)
    down = _gravity(sine * sine, altitude)
    # The cosine of the latitude is rho/(across + altitude), so nothing is divided by rho.
    level = -down / (across + altitude) - EARTH_RATE**2
    return np.stack([level * x, level * y, -down * sine], axis=-1)


def ground_velocity(position: FloatArray) -> FloatArray:
    """Velocity (..., 3) of the turning Earth at a position (..., 3)."""
    x, y, z = np.moveaxis(position, -1, 0)
    return EARTH_RATE * np.stack([-y, x, np.zeros_like(z)], axis=-1)


EARTH_RADIUS = SEMI_MAJOR_AXIS * (1 - FLATTENING / 3)
"""Mean radius R of the ellipsoid, m. The paper's Earth is a sphere."""


def checked_gravity(gravity: FloatArray) -> FloatArray:
    """Return gravity (...) in m/s^2, refusing what does not pull."""
    if gravity.min() < np.finfo(float).tiny:
        raise ValueError(f"gravity: expected positive numbers, got {gravity.min():g}.")
    return gravity
