"""Simulation of a gyrocompass on board: its errors while a ship rests, accelerates and turns.

The paper's formula is evaluated with the tilts and the yaw error that occur in the simulation.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_number, positive_number
from driftlab.core.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.frames import angles_from_attitude, geographic_rate
from driftlab.motion.vehicle import Voyage, sensed_at_rest

from .alignment import align
from .heading_error import (
    OperatingHeadingError,
    level_coriolis,
    operating_heading_error,
    speed_deviation,
)
from .levelling import Horizon, Operation, Tuning, horizon_of, operate


class ErrorsUnderWay(NamedTuple):
    """Errors of a compass under way, computed minus true, at n times.

    Attributes
    ----------
    times : ndarray, shape (n,)
        From the start, s.
    heading_error : ndarray, shape (..., n)
        rad; the speed deviation is removed.
    deviation : ndarray, shape (n,)
        The speed deviation, rad.
    formula : OperatingHeadingError
        The paper's formula for the heading error; each term (..., n).
    tilt : ndarray, shape (..., n, 2)
        Of the horizon about North and about East, rad.
    yaw_error, compass_error : ndarray, shape (..., n)
        Errors of the two parts of the heading, yaw and compass angle, rad. From the latter the
        speed deviation is removed.

    Examples
    --------
    >>> from driftlab.motion.vehicle import voyage
    >>> still = voyage(0.8, np.zeros((11, 2)), 0.0, interval=1.0)
    >>> errors = take_along(still, np.zeros(3))
    >>> errors.times.shape, errors.tilt.shape
    ((10,), (10, 2))
    """

    times: FloatArray
    heading_error: FloatArray
    deviation: FloatArray
    formula: OperatingHeadingError
    tilt: FloatArray
    yaw_error: FloatArray
    compass_error: FloatArray


def take_along(
    way: Voyage,
    drift: ArrayLike,
    offset: ArrayLike = (0.0, 0.0, 0.0),
    *,
    tuning_factor: float = 1.0,
    damping: float = 0.0,
    tilt: float = 0.0,
    log: bool = False,
) -> ErrorsUnderWay:
    """Align a compass at the start of a voyage, operate it under way, and return its errors.

    Parameters
    ----------
    way : Voyage
        True motion, and the increments of ideal sensors.
    drift : array_like, shape (..., n, 3) or (3,)
        Drift rates of the gyros in body axes, for each interval or for all, rad/s.
    offset : array_like, shape (3,)
        Offsets of the accelerometers in body axes, m/s^2.
    tuning_factor : float
        k2 R: 1 is Schuler's tuning.
    damping : float
        Damping ratio of the horizon.
    tilt : float
        Error of the aligned horizon about East, rad.
    log : bool
        Whether velocity and latitude are known to the computation: it then subtracts
        `level_coriolis` from the specific force, and rotates in azimuth at the true rate.

    Returns
    -------
    ErrorsUnderWay
        Errors (..., n) at the end of each interval.

    Raises
    ------
    ValueError
        If the shapes of `drift` and `offset` do not fit the voyage, and as in `operate`.

    Examples
    --------
    An east gyro with a drift of 0.01 degrees per hour makes the same heading error at rest as the
    formula says, here in arc minutes:

    >>> from driftlab.motion.vehicle import voyage
    >>> still = voyage(np.radians(60.0), np.zeros((101, 2)), 0.0, interval=1.0)
    >>> errors = take_along(still, np.radians([0.0, 0.0, 0.01]) / 3600)
    >>> found = errors.heading_error, errors.formula.heading
    >>> [round(60 * float(np.degrees(error[-1])), 2) for error in found]
    [4.57, 4.57]
    """
    errors, offsets = finite_array(drift, "drift", 3), finite_array(offset, "offset", 3)
    increments = way.angle_increments.shape
    if (errors.ndim > 1 and errors.shape[-2:] != increments) or offsets.shape != (3,):
        raise ValueError(
            f"drift, offset: expected shapes (..., {increments[0]}, 3) or (3,) and (3,), "
            f"got {errors.shape} and {offsets.shape}."
        )
    drifts = np.broadcast_to(errors, (*errors.shape[:-2], *increments))
    stiffness = positive_number(tuning_factor, "tuning_factor")
    ratio = finite_number(damping, "damping")
    latitude, interval = float(way.latitude[0]), way.interval
    pull = float(gravity(latitude))
    rate, up = sensed_at_rest(way.attitude[0], latitude)
    aligned = align(rate + drifts[..., 0, :], up + offsets)
    start = horizon_of(aligned)
    leaning = np.array([0.0, 0.0, -finite_number(tilt, "tilt")])
    bent = multiply(from_rotation_vector(leaning), start.attitude)
    swing = float(np.sqrt(pull / EARTH_RADIUS * stiffness))
    force = way.velocity_increments + interval * offsets
    azimuth_rate = np.broadcast_to(
        (EARTH_RATE * np.sin(aligned.latitude))[..., np.newaxis], drifts.shape[:-1]
    )
    if log:
        vertical = geographic_rate(way.latitude, way.velocity)[:, 1]
        azimuth_rate = 0.5 * (vertical[1:] + vertical[:-1])
        north, east = np.moveaxis(level_coriolis(way.latitude, way.velocity), -1, 0)
        known = np.stack([north, np.zeros_like(north), east], axis=-1)
        # In body axes, like the specific force; the mean of both ends is that of the interval.
        known = rotate(conjugate(way.attitude), known)
        force = force - interval * 0.5 * (known[1:] + known[:-1])
    found = operate(
        Horizon(bent, start.rate),
        way.angle_increments + interval * drifts,
        force,
        interval,
        Tuning(2 * ratio * swing / pull, stiffness / EARTH_RADIUS),
        azimuth_rate,
    )
    return _errors_of(found, way, drifts)


def _errors_of(found: Operation, way: Voyage, drift: FloatArray) -> ErrorsUnderWay:
    """Errors of the computed heading and horizon, and those that the formula predicts."""
    true = way.attitude[1:]
    # Turned by minus the vector that turns the components.
    tilt = -to_rotation_vector(multiply(found.attitude, conjugate(true)))[..., [0, 2]]
    heading, pitch, _ = angles_from_attitude(true)
    deviation = speed_deviation(way.latitude[1:], way.velocity[1:])
    compass_error = wrap_angle(found.compass_angle - deviation)
    yaw_error = wrap_angle(found.yaw_pitch_roll.heading - heading)
    formula = operating_heading_error(
        way.latitude[1:],
        way.velocity[1:],
        tilt,
        np.gradient(tilt, way.interval, axis=-2),
        rotate(true, drift)[..., [0, 2]],
        yaw_error,
        heading,
        pitch,
    )
    return ErrorsUnderWay(
        way.times[1:],
        yaw_error + compass_error,
        deviation,
        formula,
        tilt,
        yaw_error,
        compass_error,
    )
