"""The Earth under a navigator: WGS 84 ellipsoid, normal gravity, rotation.

Local axes are East, North, Up. Constants: NIMA TR8350.2, third edition.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays, pull_of_gravity, within
from .core import earth as core
from .core.earth import (
    EARTH_RATE,
    EQUATOR_GRAVITY,
    FLATTENING,
    SEMI_MAJOR_AXIS,
)

__all__ = [
    "EARTH_RADIUS",
    "EARTH_RATE",
    "EQUATOR_GRAVITY",
    "checked_gravity",
    "checked_latitude",
    "curvature_radii",
    "earth_rate",
    "gravity",
]

EARTH_RADIUS = SEMI_MAJOR_AXIS * (1 - FLATTENING / 3)
"""Mean radius R of the ellipsoid, m. The Earth of Plotnikov's paper is a sphere."""

_NEAREST_TO_POLE = np.radians(89.9)
_BEYOND_POLE = 1.6


def checked_latitude(latitude: ArrayLike) -> FloatArray:
    """Return latitudes, rad, refusing the poles, where East and North are not defined."""
    values = finite_array(latitude, "latitude")
    worst = float(np.abs(values).max())
    if worst > _NEAREST_TO_POLE:
        slip = "" if worst < 1.58 else f" Is it in degrees? np.radians({worst:.6g})."
        raise ValueError(
            "latitude: expected at most 89.9 degrees from the equator, because East and North are "
            f"lost at a pole, got {worst:.6g} rad, that is {np.degrees(worst):.6g} degrees.{slip}"
        )
    return values


def _any_latitude(latitude: FloatArray) -> FloatArray:
    """Refuse degrees, but no pole, nor a small step across one to form a difference."""
    slip = f"is it in degrees? np.radians({latitude.flat[np.abs(latitude).argmax()]:g})."
    return within(latitude, "latitude", _BEYOND_POLE, "rad", slip)


def checked_gravity(gravity: FloatArray) -> FloatArray:
    """Return magnitudes of gravity, m/s^2, refusing those of no planet, such as a number in g."""
    return pull_of_gravity(gravity)


def earth_rate(latitude: ArrayLike) -> FloatArray:
    """Angular rate of the Earth in East, North, Up.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.

    Returns
    -------
    ndarray, shape (..., 3)
        rad/s.

    Examples
    --------
    >>> (np.degrees(earth_rate(np.radians(30.0))) * 3600).round(3)  # degrees per hour
    array([ 0.   , 13.026,  7.521])
    """
    return core.earth_rate(_any_latitude(finite_array(latitude, "latitude")))


def curvature_radii(latitude: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Radii of curvature of the ellipsoid.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.

    Returns
    -------
    along, across : ndarray, shape (...)
        Of the meridian, and across it (the prime vertical), m.

    Examples
    --------
    >>> along, across = curvature_radii(0.0)
    >>> print(f"{along:.0f} {across:.0f}")
    6335439 6378137
    """
    return core.curvature_radii(_any_latitude(finite_array(latitude, "latitude")))


def gravity(latitude: ArrayLike, altitude: ArrayLike = 0.0) -> FloatArray:
    """Normal gravity, downwards: Somigliana's formula, of second order in the altitude.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    altitude : array_like, shape (...)
        Above the ellipsoid, m; from -5 km to 20 km.

    Returns
    -------
    ndarray, shape (...)
        m/s^2.

    Notes
    -----
    NIMA TR8350.2 (4-3). Up to 20 km it is within 0.3 micro-g of the gradient of the ellipsoid's own
    potential. True gravity differs from normal gravity by tens of micro-g from place to place.

    Examples
    --------
    >>> gravity(np.radians([0.0, 45.0, 90.0])).round(4)
    array([9.7803, 9.8062, 9.8322])
    """
    latitude, altitude = finite_arrays(latitude=(latitude,), altitude=(altitude,))
    return core.gravity(np.sin(_any_latitude(latitude)) ** 2, altitude)
