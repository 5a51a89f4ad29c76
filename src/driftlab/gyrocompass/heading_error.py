"""A vehicle's motion and its gyrocompass, and the heading error at work; Plotnikov et al.

The compass takes the horizontal component of the rate of the local axes for North, and the specific
force for the vertical. Motion round the Earth adds to both. The error formula, here called
(operating heading), gives the error that remains when both are known.
`speed_error` is the northing error (steaming error) of other books.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays, within
from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import checked_pitch, navigation_frame_rate


def speed_error(
    latitude: ArrayLike, velocity: ArrayLike, radius: float = EARTH_RADIUS
) -> FloatArray:
    r"""Speed error of a compass (north-steaming error): angle from its North to true North.

    The compass finds the horizontal component of the rate of the local axes, to which the vehicle's
    own motion round the Earth contributes. Its heading is too large by this angle.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    velocity : array_like, shape (..., 2)
        North and East, m/s.
    radius : float
        Of the Earth, m.

    Returns
    -------
    ndarray, shape (...)
        rad, positive about Up, as are headings.

    Raises
    ------
    ValueError
        If the local axes do not turn about any horizontal axis, or at a pole.

    See Also
    --------
    operating_heading_error : All terms of a compass under way.
    simulate_gyrocompass : The compass on a voyage.
    coriolis_correction : What a log takes out.

    Notes
    -----
    With the velocity v to North and East, the Earth's rate U and radius R it is

    .. math:: -\arctan \frac{v_N / R}{U \cos\varphi + v_E / R}.

    References
    ----------
    - K. R. Britting, *Inertial Navigation Systems Analysis*, Wiley, 1971.

    Examples
    --------
    In degrees, for 10 m/s to the North at 60 degrees:

    >>> round(float(np.degrees(speed_error(np.radians(60.0), [10.0, 0.0]))), 2)
    -2.47
    """
    north, _, east = np.moveaxis(navigation_frame_rate(latitude, velocity, radius), -1, 0)
    _level_rate_squared(north, east)
    return np.arctan2(east, north)


def coriolis_correction(
    latitude: ArrayLike, velocity: ArrayLike, radius: float = EARTH_RADIUS
) -> FloatArray:
    """Horizontal specific force of motion at constant velocity that must not tilt the horizon.

    A horizon that turns at the rate ``W/R`` follows changes of velocity. Even at constant velocity
    there is a horizontal specific force, because the local axes turn. Part of it belongs to the
    change of the Earth's horizontal rate with the latitude; this is the rest. If a log gives the
    velocity, it can be subtracted from W.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad, not a pole.
    velocity : array_like, shape (..., 2)
        North and East, m/s.
    radius : float
        Of the Earth, m.

    Returns
    -------
    ndarray, shape (..., 2)
        North and East, m/s^2.

    Raises
    ------
    ValueError
        At a pole.

    Examples
    --------
    >>> coriolis_correction(np.radians(60.0), [10.0, 0.0]).round(6)
    array([ 0.      , -0.000632])
    """
    place, speed = finite_arrays(latitude=(latitude,), velocity=(velocity, 2))
    turn = navigation_frame_rate(place, speed, radius)[..., 1]
    north, east = np.moveaxis(speed, -1, 0)
    return np.stack([(turn + EARTH_RATE * np.sin(place)) * east, -turn * north], axis=-1)


class OperatingHeadingError(NamedTuple):
    """Terms of the heading error of a compass at work; (operating heading).

    Attributes
    ----------
    east_rate, north_rate : ndarray, shape (...)
        Errors of the compass angle from errors of the horizon's rates about East and about North,
        rad.
    yaw : ndarray, shape (...)
        Minus the error of the yaw, rad.
    tilt : ndarray, shape (...)
        Effect of the tilt of the horizon in a pitched body, rad.
    """

    east_rate: FloatArray
    north_rate: FloatArray
    yaw: FloatArray
    tilt: FloatArray

    @property
    def compass_angle(self) -> FloatArray:
        """Error of the compass angle Psi_K (...), rad: all four terms, as in the formula."""
        return self.east_rate + self.north_rate + self.yaw + self.tilt

    @property
    def heading(self) -> FloatArray:
        """Error of the heading Psi = psi + Psi_K (...), rad, in which errors of the yaw cancel."""
        return self.east_rate + self.north_rate + self.tilt


def operating_heading_error(
    latitude: ArrayLike,
    velocity: ArrayLike,
    tilt: ArrayLike,
    tilt_rate: ArrayLike,
    gyro_bias_north_east: ArrayLike,
    yaw_error: ArrayLike,
    heading: ArrayLike,
    pitch: ArrayLike,
    radius: float = EARTH_RADIUS,
    *,
    proportional_rate: ArrayLike = (0.0, 0.0),
) -> OperatingHeadingError:
    """First-order heading error of the compass at work, term by term; (operating heading).

    The paper's formula is that of a compass angle from the whole level rates of the horizon. From
    their integral parts, as `LevellingHistory.heading` reads it, it is that of the whole rates less
    their proportional parts.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    velocity : array_like, shape (..., 2)
        North and East, m/s.
    tilt : array_like, shape (..., 2)
        alpha and chi, rad: rotation of the modelled horizon about North and about East.
    tilt_rate : array_like, shape (..., 2)
        Their derivatives, rad/s.
    gyro_bias_north_east : array_like, shape (..., 2)
        Gyro biases resolved in North and East, rad/s.
    yaw_error : array_like, shape (...)
        Error of psi, the yaw of the body in the modelled horizon, rad.
    heading, pitch : array_like, shape (...)
        rad; the pitch at most 89.9 degrees.
    radius : float
        Of the Earth, m.
    proportional_rate : array_like, shape (..., 2)
        k1 W3 and -k1 W1, rad/s, if the heading is read from the integral parts. Zeros without
        damping, or if it is read from the whole rates.

    Returns
    -------
    OperatingHeadingError
        Terms (...) in rad.

    Raises
    ------
    ValueError
        If the horizon does not turn about any horizontal axis (a body that moves West as fast as
        the Earth moves East has no compass), at a pole, or in a vertical body.

    See Also
    --------
    simulate_gyrocompass : The compass on a voyage, with this formula beside it.

    Examples
    --------
    A gyro bias of 0.01 degrees per hour about East, at rest at 60 degrees, in arc minutes:

    >>> bias, zero = np.radians([0.0, 0.01]) / 3600, [0.0, 0.0]
    >>> found = operating_heading_error(np.radians(60.0), zero, zero, zero, bias, 0.0, 0.0, 0.0)
    >>> round(60 * float(np.degrees(found.heading)), 2)
    4.57
    """
    place, speed, tilts, tilt_rates, biases, yaw, heading, pitch, unread = finite_arrays(
        latitude=(latitude,),
        velocity=(velocity, 2),
        tilt=(tilt, 2),
        tilt_rate=(tilt_rate, 2),
        gyro_bias_north_east=(gyro_bias_north_east, 2),
        yaw_error=(yaw_error,),
        heading=(heading,),
        pitch=(pitch,),
        proportional_rate=(proportional_rate, 2),
    )
    checked_pitch(pitch)
    checked_small_bias(biases, "gyro_bias_north_east")
    north, up, east = np.moveaxis(navigation_frame_rate(place, speed, radius), -1, 0)
    squared = _level_rate_squared(north, east)
    (alpha, chi), (alpha_rate, chi_rate) = np.moveaxis(tilts, -1, 0), np.moveaxis(tilt_rates, -1, 0)
    # Errors of the two level rates of the modelled horizon: its gyros are biased, and its axes turn
    # and are turned. The paper's denominator is R^2 times `squared`, and its v1 is -R times `east`.
    east_error = chi_rate - alpha * up + biases[..., 1] - unread[..., 1]
    north_error = alpha_rate + chi * up + biases[..., 0] - unread[..., 0]
    terms = np.broadcast_arrays(
        north * east_error / squared,
        -east * north_error / squared,
        -yaw,
        (alpha * np.cos(heading) - chi * np.sin(heading)) * np.tan(pitch),
    )
    return OperatingHeadingError(*(np.array(term)[()] for term in terms))


def checked_small_bias(biases: FloatArray, name: str) -> None:
    """Warn of gyro biases far above the Earth's rate, which no formula of first order bears."""
    slip = "first order does not hold; were degrees per hour meant, np.radians(x) / 3600?"
    within(biases, name, np.inf, "rad/s", slip, usual=10 * EARTH_RATE)


def _level_rate_squared(north: FloatArray, east: FloatArray) -> FloatArray:
    squared = north**2 + east**2
    if squared.min() < (1e-6 * EARTH_RATE) ** 2:
        raise ValueError(
            "latitude, velocity: expected local axes that turn about a level axis, "
            f"got a level rate of {np.sqrt(squared.min()):.1g} rad/s."
        )
    return squared
