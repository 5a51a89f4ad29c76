"""Plotnikov et al.: what a vehicle's way does to a gyrocompass, and its heading error at work.

The compass takes the level part of the rate of the local axes for North, and the specific force for
a plumb line. A way round the Earth adds to both. The error formula, here called (operating
heading), says what is left when both are known.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays
from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import geographic_rate, refuse_vertical


def speed_deviation(
    latitude: ArrayLike, velocity: ArrayLike, radius: float = EARTH_RADIUS
) -> FloatArray:
    """Angle (...) from what a moving compass takes for North to North, rad, positive about Up.

    The compass finds the level part of the rate of the local axes, in which the ship's own way
    round the Earth is contained. What it shows as heading is too large by this angle.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    velocity : array_like, shape (..., 2)
        North and East, m/s.
    radius : float
        Of the Earth, m.
    """
    north, _, east = np.moveaxis(geographic_rate(latitude, velocity, radius), -1, 0)
    _level_rate_squared(north, east)
    return np.arctan2(east, north)


def level_coriolis(
    latitude: ArrayLike, velocity: ArrayLike, radius: float = EARTH_RADIUS
) -> FloatArray:
    """Level specific force (..., 2) of an even motion that a horizon must not follow, m/s^2.

    A horizon that is turned by ``W/R`` follows changes of velocity. At an even velocity there is
    specific force all the same, North and East, because local axes turn. Part of it belongs to the
    change of the Earth's level rate with the latitude; the rest is this. With the velocity from a
    log it can be taken out of W.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad, not a pole.
    velocity : array_like, shape (..., 2)
        North and East, m/s.
    radius : float
        Of the Earth, m.
    """
    place, speed = finite_arrays(latitude=(latitude,), velocity=(velocity, 2))
    turn = geographic_rate(place, speed, radius)[..., 1]
    north, east = np.moveaxis(speed, -1, 0)
    return np.stack([(turn + EARTH_RATE * np.sin(place)) * east, -turn * north], axis=-1)


class OperatingHeadingError(NamedTuple):
    """The terms of (operating heading), each (...), rad.

    Attributes
    ----------
    east_rate, north_rate : ndarray
        What errors of the horizon's rates about East and about North make of the compass angle.
    yaw : ndarray
        Minus the error of the yaw.
    tilt : ndarray
        The tilt of the horizon as it shows in a pitched body.
    """

    east_rate: FloatArray
    north_rate: FloatArray
    yaw: FloatArray
    tilt: FloatArray

    @property
    def compass_angle(self) -> FloatArray:
        """Error (...) of the compass angle Psi_K: the left-hand side of the formula."""
        return self.east_rate + self.north_rate + self.yaw + self.tilt

    @property
    def heading(self) -> FloatArray:
        """Error (...) of the heading Psi = psi + Psi_K: the errors of the yaw cancel."""
        return self.east_rate + self.north_rate + self.tilt


def operating_heading_error(
    latitude: ArrayLike,
    velocity: ArrayLike,
    tilt: ArrayLike,
    tilt_rate: ArrayLike,
    drift: ArrayLike,
    yaw_error: ArrayLike,
    heading: ArrayLike,
    pitch: ArrayLike,
    radius: float = EARTH_RADIUS,
) -> OperatingHeadingError:
    """First-order heading error of the compass at work, term by term; (operating heading).

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    velocity : array_like, shape (..., 2)
        North and East, m/s.
    tilt : array_like, shape (..., 2)
        alpha and chi, rad: how far the modelled horizon is turned about North and about East.
    tilt_rate : array_like, shape (..., 2)
        Their derivatives, rad/s.
    drift : array_like, shape (..., 2)
        Drift rates of the gyros about North and about East, rad/s.
    yaw_error : array_like, shape (...)
        Error of psi, the yaw of the body in the modelled horizon, rad.
    heading, pitch : array_like, shape (...)
        rad; the pitch at most 89.9 degrees.
    radius : float
        Of the Earth, m.

    Raises
    ------
    ValueError
        Also if the horizon does not turn about any level axis: a body that moves West as fast as
        the Earth moves East has no compass.
    """
    place, speed, tilts, tilt_rates, drifts, yaw, heading, pitch = finite_arrays(
        latitude=(latitude,),
        velocity=(velocity, 2),
        tilt=(tilt, 2),
        tilt_rate=(tilt_rate, 2),
        drift=(drift, 2),
        yaw_error=(yaw_error,),
        heading=(heading,),
        pitch=(pitch,),
    )
    refuse_vertical(pitch)
    north, up, east = np.moveaxis(geographic_rate(place, speed, radius), -1, 0)
    squared = _level_rate_squared(north, east)
    (alpha, chi), (alpha_rate, chi_rate) = np.moveaxis(tilts, -1, 0), np.moveaxis(tilt_rates, -1, 0)
    # Errors of the two level rates of the modelled horizon: its gyros drift, and its axes turn and
    # are turned. The paper's denominator is R^2 times `squared`, and its v1 is -R times `east`.
    east_error = chi_rate - alpha * up + drifts[..., 1]
    north_error = alpha_rate + chi * up + drifts[..., 0]
    terms = np.broadcast_arrays(
        north * east_error / squared,
        -east * north_error / squared,
        -yaw,
        (alpha * np.cos(heading) - chi * np.sin(heading)) * np.tan(pitch),
    )
    return OperatingHeadingError(*map(np.array, terms))


def _level_rate_squared(north: FloatArray, east: FloatArray) -> FloatArray:
    squared = north**2 + east**2
    if squared.min() < (1e-6 * EARTH_RATE) ** 2:
        raise ValueError(
            "latitude, velocity: expected local axes that turn about a level axis, "
            f"got a level rate of {np.sqrt(squared.min()):.1g} rad/s."
        )
    return squared


def heading_error_of_attitude(
    attitude_error: ArrayLike, heading: ArrayLike, pitch: ArrayLike
) -> FloatArray:
    """Heading error (...) of a small attitude error, rad.

    Parameters
    ----------
    attitude_error : array_like, shape (..., 3)
        Rotation vector in North, Up, East that leads from the true to the computed attitude, rad.
    heading, pitch : array_like, shape (...)
        rad; the pitch at most 89.9 degrees.
    """
    error, heading, pitch = finite_arrays(
        attitude_error=(attitude_error, 3), heading=(heading,), pitch=(pitch,)
    )
    refuse_vertical(pitch)
    across = error[..., 0] * np.cos(heading) - error[..., 2] * np.sin(heading)
    return error[..., 1] - across * np.tan(pitch)
