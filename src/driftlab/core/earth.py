"""The ellipsoid and its gravity: the formulas behind `driftlab.earth` and `driftlab.frames`."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

from .vectors import components, stacked

EARTH_RATE = 7.292115e-5
SEMI_MAJOR_AXIS = 6378137.0
FLATTENING = 1 / 298.257223563
ECCENTRICITY_SQUARED = FLATTENING * (2 - FLATTENING)
EQUATOR_GRAVITY = 9.7803253359
POLE_GRAVITY = 9.8321849378

_GRAVITY_GROWTH = (1 - FLATTENING) * POLE_GRAVITY / EQUATOR_GRAVITY - 1
_DEEPEST = 6.2e6  # m from the centre; any point that a navigator can reach is farther


def earth_rate(latitude: FloatArray) -> FloatArray:
    """Angular rate (..., 3) of the Earth in East, North, Up."""
    return EARTH_RATE * np.stack(
        [np.zeros_like(latitude), np.cos(latitude), np.sin(latitude)], axis=-1
    )


def curvature_radii(latitude: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Radii of curvature (...): along the meridian, and of the prime vertical."""
    squared = 1 - ECCENTRICITY_SQUARED * np.sin(latitude) ** 2
    across = SEMI_MAJOR_AXIS / np.sqrt(squared)
    return across * (1 - ECCENTRICITY_SQUARED) / squared, across


def gravity(sine_squared: FloatArray, altitude: FloatArray) -> FloatArray:
    """Normal gravity (...) from the squared sine of the latitude, and the altitude."""
    surface = EQUATOR_GRAVITY * (1 + _GRAVITY_GROWTH * sine_squared)
    surface = surface / np.sqrt(1 - ECCENTRICITY_SQUARED * sine_squared)
    return surface * (1 - 2 / SEMI_MAJOR_AXIS * altitude)


def position_vector(latitude: FloatArray, altitude: FloatArray) -> FloatArray:
    """Vector (..., 3) from the Earth's centre to a point of the meridian of longitude zero."""
    _, across = curvature_radii(latitude)
    return np.stack(
        [
            (across + altitude) * np.cos(latitude),
            np.zeros(np.broadcast_shapes(latitude.shape, altitude.shape)),
            (across * (1 - ECCENTRICITY_SQUARED) + altitude) * np.sin(latitude),
        ],
        axis=-1,
    )


def geodetic(position: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Latitude, longitude and altitude, each (...), of positions (..., 3)."""
    x, y, rho, z = _cylindrical(position)
    sine, cosine, altitude, _ = _geodetic(rho, z)
    return np.arctan2(sine, cosine), np.arctan2(y, x), altitude


def gravitation(position: FloatArray) -> FloatArray:
    """Gravitation (..., 3) at positions (..., 3): normal gravity without the centrifugal part."""
    x, y, rho, z = _cylindrical(position)
    sine, _, altitude, across = _geodetic(rho, z)
    down = gravity(sine * sine, altitude)
    # The cosine of the latitude is rho/(across + altitude), so nothing is divided by rho.
    level = -down / (across + altitude) - EARTH_RATE**2
    return stacked(level * x, level * y, -down * sine)


def _cylindrical(position: FloatArray) -> tuple[FloatArray, ...]:
    """Components x and y, distance from the axis, and z of positions outside the inner Earth."""
    x, y, z = components(position)
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


def ground_velocity(position: FloatArray) -> FloatArray:
    """Velocity (..., 3) of the turning Earth at a position (..., 3)."""
    x, y, z = components(position)
    return EARTH_RATE * stacked(-y, x, np.zeros_like(z))


def local_axes(latitude: FloatArray, longitude: FloatArray) -> FloatArray:
    """Quaternion (..., 4) from East, North, Up to Earth-centred axes."""
    half_tilt, half_turn = np.pi / 4 - latitude / 2, np.pi / 4 + longitude / 2
    sine_tilt, cosine_tilt = np.sin(half_tilt), np.cos(half_tilt)
    sine_turn, cosine_turn = np.sin(half_turn), np.cos(half_turn)
    return stacked(
        cosine_turn * sine_tilt,
        sine_turn * sine_tilt,
        sine_turn * cosine_tilt,
        cosine_turn * cosine_tilt,
    )
