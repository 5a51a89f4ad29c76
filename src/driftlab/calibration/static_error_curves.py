"""Curves of the errors at rest from their causes: exact, and as textbooks approximate them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    finite_number,
    unit_quaternions,
)
from driftlab.core.quaternion import rotate
from driftlab.earth import EARTH_RATE, checked_latitude, earth_rate, gravity
from driftlab.imu import ImuErrors
from driftlab.increments import compensate, measure
from driftlab.motion.turntable import static_trajectory

from ._moments import checked_moments
from .body_axes import attitude_error
from .schuler_pair import static_error_rates
from .static_error_growth import STATIC_CAUSES, static_error_modes
from .static_navigation import StaticNavigationErrors


def static_causes(
    imu_errors: ImuErrors,
    estimated: ImuErrors,
    attitude: ArrayLike,
    *,
    start: ArrayLike,
    reference: ArrayLike,
    latitude: float,
) -> FloatArray:
    """Causes of the errors at rest of a calibrated unit.

    Parameters
    ----------
    imu_errors, estimated : ImuErrors
        The true errors (...), in the axes of `attitude`, and those that are compensated (...).
    attitude : array_like or Rotation, shape (4,)
        True attitude of the unit, body to East, North, Up.
    start, reference : array_like or Rotation, shape (..., 4)
        Attitude with which the computation begins, and that from which errors count.
    latitude : float
        rad; not a pole.

    Returns
    -------
    ndarray, shape (..., 12)
        In the order of `STATIC_CAUSES`. The biases are all that the compensated sensors show beside
        the Earth's rate and gravity in the axes of `reference`, so scale and installation errors
        are in them, and the distance of the reference from the unit's own axes.

    Examples
    --------
    An East accelerometer whose bias was found but for 10 micro-g:

    >>> from driftlab.imu import NO_ERRORS
    >>> unit = NO_ERRORS._replace(accelerometer_bias=np.array([1e-4, 0, 0]))
    >>> level = [0.0, 0.0, 0.0, 1.0]
    >>> causes = static_causes(unit, NO_ERRORS, level, start=level, reference=level, latitude=0.7)
    >>> print(STATIC_CAUSES[10], float(causes[10].round(6)))
    accelerometer bias East 0.0001
    """
    axes = unit_quaternions(reference, "reference")
    still = static_trajectory(attitude, latitude, 1.0, 2)
    checked_instance(estimated, ImuErrors, "estimated")
    believed = unit_quaternions(start, "start")
    sensed = compensate(measure(still.increments, imu_errors), estimated)
    rate, force = (rotate(axes, row.mean(axis=-2)) for row in (sensed.angle, sensed.velocity))
    push = force - np.array([0.0, 0.0, float(gravity(latitude))])
    tilt = attitude_error(believed, axes)
    lead = np.broadcast_shapes(tilt.shape, rate.shape)[:-1]
    parts = (tilt, np.zeros(4), rate - earth_rate(latitude), push[..., :2])
    return np.concatenate(
        [np.broadcast_to(part, (*lead, part.shape[-1])) for part in parts], axis=-1
    )


def static_errors(times: ArrayLike, latitude: float, causes: ArrayLike) -> StaticNavigationErrors:
    """Errors of a navigator at rest from their causes: the exact solution of the linear equations.

    Parameters
    ----------
    times : array_like, shape (k,)
        Since the start, s.
    latitude : float
        rad; not a pole.
    causes : array_like, shape (..., 12)
        Errors at the start and sensor biases, in the order of `STATIC_CAUSES`.

    Returns
    -------
    StaticNavigationErrors
        As `navigate_static` gives them, but for what is of second order.

    Examples
    --------
    Position error in km after four hours with an East gyro bias of 0.01 deg/h:

    >>> causes = np.zeros(12)
    >>> causes[STATIC_CAUSES.index("gyro bias East")] = np.radians(0.01) / 3600
    >>> errors = static_errors([4 * 3600.0], np.radians(37.5), causes)
    >>> (errors.position[0] / 1e3).round(1)
    array([-1.4, -3.8])
    """
    given = finite_array(causes, "causes", len(STATIC_CAUSES))
    moments = checked_moments(times)
    states = np.einsum(
        "kij,...j->...ki", static_error_modes(latitude).at(moments).sum(axis=0), given
    )
    return StaticNavigationErrors(moments, states[..., :3], states[..., 3:5], states[..., 5:7])


def schuler_position(times: ArrayLike, latitude: float, causes: ArrayLike) -> FloatArray:
    """Position errors as textbooks approximate them: one pendulum, and an Earth that hardly turns.

    Parameters
    ----------
    times : array_like, shape (k,)
        Since the start, s; few hours.
    latitude : float
        rad; not a pole.
    causes : array_like, shape (..., 12)
        In the order of `STATIC_CAUSES`.

    Returns
    -------
    ndarray, shape (..., k, 2)
        East and North, m.

    Notes
    -----
    With w Schuler's rate and R = g/w^2, a tilt gives R (1 - cos wt), a velocity sin wt / w, an
    accelerometer bias (1 - cos wt)/w^2, a level gyro bias R (t - sin wt / w). An azimuth error
    acts as a gyro bias U cos L along East, and a vertical bias as one that grows with the time.
    What is left out is of relative size U t, and Foucault's.

    Examples
    --------
    The same bias as in `static_errors`, after forty minutes and after four hours:

    >>> causes = np.zeros(12)
    >>> causes[STATIC_CAUSES.index("gyro bias East")] = np.radians(0.01) / 3600
    >>> times, latitude = [2400.0, 14400.0], np.radians(37.5)
    >>> exact = static_errors(times, latitude, causes).position[:, 1]
    >>> (schuler_position(times, latitude, causes)[:, 1] / exact).round(2)
    array([1.01, 1.21])
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    given = finite_array(causes, "causes", len(STATIC_CAUSES))
    time = checked_moments(times)
    rate = static_error_rates(place).schuler
    radius = float(gravity(place)) / rate**2
    level = EARTH_RATE * np.cos(place)
    swing, lag = 1 - np.cos(rate * time), time - np.sin(rate * time) / rate
    tilt_e, tilt_n, azimuth, v_e, v_n, east, north, *biases = (
        column[..., np.newaxis] for column in np.moveaxis(given, -1, 0)
    )
    drift_e, drift_n, drift_u, push_e, push_n = biases
    turned = drift_u * level * radius * (time**2 / 2 - swing / rate**2)
    position = (
        east - radius * tilt_n * swing + v_e * np.sin(rate * time) / rate
        + push_e * swing / rate**2 + radius * drift_n * lag,
        north + radius * tilt_e * swing + v_n * np.sin(rate * time) / rate
        + push_n * swing / rate**2 - radius * (drift_e + level * azimuth) * lag + turned,
    )  # fmt: skip
    return np.stack(position, axis=-1)
