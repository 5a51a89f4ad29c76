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
# Of the free-air gradient, per metre: TR8350.2 (4-3) with m = 0.00344978650684.
_GRADIENT = 2 * (1 + FLATTENING + 0.00344978650684) / SEMI_MAJOR_AXIS
_GRADIENT_GROWTH = 4 * FLATTENING / SEMI_MAJOR_AXIS
_CURVATURE = 3 / SEMI_MAJOR_AXIS**2
# Gravity grows to the poles by g_p - g_e, so that above the ellipsoid it leans to the equator.
_BEND = 2 * (POLE_GRAVITY - EQUATOR_GRAVITY) / SEMI_MAJOR_AXIS
# Gravity on the ellipsoid over the radius of the prime vertical: these two, with the sine squared.
_SURFACE = EQUATOR_GRAVITY / SEMI_MAJOR_AXIS
_SURFACE_GROWTH = _SURFACE * _GRAVITY_GROWTH
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
    """Normal gravity (...) downwards from the squared sine of the latitude, and the altitude."""
    across = SEMI_MAJOR_AXIS / np.sqrt(1 - ECCENTRICITY_SQUARED * sine_squared)
    return _gravity(sine_squared, altitude, across)


def _gravity(sine_squared: FloatArray, altitude: FloatArray, across: FloatArray) -> FloatArray:
    """The same where the radius of the prime vertical is known."""
    surface = across * (_SURFACE + _SURFACE_GROWTH * sine_squared)
    gradient = _GRADIENT - _GRADIENT_GROWTH * sine_squared - _CURVATURE * altitude
    return surface * (1 - altitude * gradient)


def gravity_north(latitude: FloatArray, altitude: FloatArray) -> FloatArray:
    """North component (...) of normal gravity above the ellipsoid."""
    return -_BEND * altitude * (np.sin(latitude) * np.cos(latitude))


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
    squared, bend = sine * sine, _BEND * altitude
    # Gravity leans by bend * sine * cosine to the equator: a part of it is along the axis.
    inwards = _gravity(squared, altitude, across) - bend * squared
    # The cosine of the latitude is rho/(across + altitude), so nothing is divided by rho.
    level = -inwards / (across + altitude) - EARTH_RATE**2
    return stacked(level * x, level * y, -(inwards + bend) * sine)


def _cylindrical(position: FloatArray) -> tuple[FloatArray, ...]:
    """Components x and y, distance from the axis, and z of positions outside the inner Earth."""
    x, y, z = components(position)
    squared = x * x + y * y
    refuse_inner_earth(float((squared + z * z).min()))
    return x, y, np.sqrt(squared), z


def refuse_inner_earth(square: float) -> None:
    """Refuse a position with this squared distance from the Earth's centre, if it is too deep."""
    if square < _DEEPEST**2:
        raise ValueError(
            f"position: expected at least {_DEEPEST:.1e} m from the Earth's centre, "
            f"got {square**0.5:.3g} m."
        )


def _geodetic(
    rho: FloatArray, z: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Sine and cosine of the latitude, altitude, and prime vertical radius; `rho` from the axis."""
    minor = SEMI_MAJOR_AXIS * (1 - FLATTENING)
    x, y = (1 - FLATTENING) * rho, z
    size = np.sqrt(x * x + y * y)
    reduced_cosine, reduced_sine = x / size, y / size
    # Products, because NumPy takes its time over third powers.
    sine_cubed = reduced_sine * reduced_sine * reduced_sine
    y = z + ECCENTRICITY_SQUARED / (1 - ECCENTRICITY_SQUARED) * minor * sine_cubed
    cosine_cubed = reduced_cosine * reduced_cosine * reduced_cosine
    x = rho - ECCENTRICITY_SQUARED * SEMI_MAJOR_AXIS * cosine_cubed
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
