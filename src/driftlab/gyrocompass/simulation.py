"""A gyrocompass on board: a ship lies still, gathers way and turns, and its compass errs.

The instrument is simulated, and the paper's formula is given the tilts and the yaw error that the
simulation really had.
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
    """Errors of a compass under way, computed minus true, at the same times.

    Attributes
    ----------
    times : ndarray, shape (n,)
        s.
    heading_error : ndarray, shape (..., n)
        rad, the speed deviation taken out.
    deviation : ndarray, shape (n,)
        The speed deviation, rad.
    formula : OperatingHeadingError
        Its terms, each (..., n).
    tilt : ndarray, shape (..., n, 2)
        Of the horizon about North and about East, rad.
    yaw_error, compass_error : ndarray, shape (..., n)
        Of the two parts of the heading, rad; that of the compass angle without the deviation.
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
    """Align a compass at the beginning of a voyage, let it work, and look at its errors.

    Parameters
    ----------
    way : Voyage
    drift : array_like, shape (..., n, 3) or (3,)
        Of the gyros in body axes, for each interval or for all, rad/s.
    offset : array_like, shape (3,)
        Of the accelerometers in body axes, m/s^2.
    tuning_factor : float
        k2 R: 1 is Schuler's tuning.
    damping : float
        Damping ratio of the horizon's swing.
    tilt : float
        Error of the aligned horizon about East, rad.
    log : bool
        Whether the computer knows velocity and latitude: it then takes `level_coriolis` out of the
        specific force, and turns in azimuth as it must.
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
    """What the instrument found against the truth, and what the formula makes of it."""
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
