"""Navigation errors of a calibrated unit at rest; Wu et al., Figs. 3-5."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_number,
    positive_number,
    shown,
    unit_quaternions,
)
from driftlab.earth import checked_latitude, curvature_radii
from driftlab.imu import ImuErrors, ImuNoise
from driftlab.increments import compensate, measure
from driftlab.motion.turntable import static_trajectory
from driftlab.strapdown import navigate, stationary_state

from .body_axes import attitude_error

_MOST_INTERVALS = 2**31 - 1


class StaticNavigationErrors(NamedTuple):
    """Navigation errors of a unit at rest, computed minus true.

    Attributes
    ----------
    times : ndarray, shape (k,)
        From the start, s.
    attitude : ndarray, shape (..., k, 3)
        Attitude error phi about East, North, Up, rad.
    velocity : ndarray, shape (..., k, 2)
        East and North, m/s.
    position : ndarray, shape (..., k, 2)
        East and North, m.
    """

    times: FloatArray
    attitude: FloatArray
    velocity: FloatArray
    position: FloatArray


def navigate_static(
    imu_errors: ImuErrors,
    estimated: ImuErrors,
    attitude: ArrayLike,
    *,
    start: ArrayLike,
    reference: ArrayLike,
    latitude: float,
    duration: float,
    interval: float = 0.5,
    output_interval: float = 60.0,
    noise: ImuNoise | None = None,
    rng: np.random.Generator | int | None = None,
) -> StaticNavigationErrors:
    """Navigate with a unit at rest, with its errors compensated as far as they were found.

    Parameters
    ----------
    imu_errors, estimated : ImuErrors
        The true errors (...), in the axes of `attitude`, and those that a calibration found (...),
        in the body axes of its own choice.
    attitude : array_like or Rotation, shape (4,)
        True attitude of the unit, body to East, North, Up.
    start, reference : array_like or Rotation, shape (..., 4)
        Attitude with which the computation begins, and the true one from which errors count.
    latitude : float
        rad; not a pole.
    duration : float
        Of the navigation, s; rounded to a whole number of results.
    interval : float
        Between the increments, s.
    output_interval : float
        Between two results, s; rounded to an even number of increments.
    noise : ImuNoise, optional
        Of the sensors; none if not given.
    rng : numpy.random.Generator or int, optional
        Source of the noise.

    Returns
    -------
    StaticNavigationErrors
        Errors (..., k) as in Wu, Figs. 3-5. Altitude and vertical velocity are held, as by a
        barometer.

    Raises
    ------
    ValueError
        If the times are not positive and in ascending order, `noise` is given without `rng`, or as
        in `driftlab.strapdown.navigate`.

    Examples
    --------
    Largest position error of a typical unit without calibration in an hour, in m:

    >>> from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS
    >>> level = [0.0, 0.0, 0.0, 1.0]
    >>> errors = navigate_static(
    ...     TYPICAL_ERRORS, NO_ERRORS, level, start=level, reference=level,
    ...     latitude=0.7, duration=3600.0,
    ... )
    >>> round(float(np.abs(errors.position).max()), -2)
    26800.0
    """
    seconds, output, whole = (
        positive_number(value, name)
        for name, value in (
            ("interval", interval),
            ("output_interval", output_interval),
            ("duration", duration),
        )
    )
    latitude = float(checked_latitude(finite_number(latitude, "latitude")))
    if not seconds <= output <= whole:
        raise ValueError(
            "interval, output_interval, duration: expected positive times, each at least as long "
            f"as the one before, got {shown(interval)}, {shown(output_interval)}, "
            f"{shown(duration)} s."
        )
    if whole > _MOST_INTERVALS * seconds:
        raise ValueError(
            f"duration: expected at most {_MOST_INTERVALS} intervals of {shown(interval)} s, got "
            f"{shown(duration)} s."
        )
    # An even number of increments for each result.
    each = 2 * max(1, round(output / seconds / 2))
    count = each * max(1, round(whole / (each * seconds)))
    true = static_trajectory(attitude, latitude, seconds, count)
    checked_instance(estimated, ImuErrors, "estimated")
    compensated = compensate(measure(true.increments, imu_errors, noise, rng), estimated)
    believed, axes = unit_quaternions(start, "start"), unit_quaternions(reference, "reference")
    lead = np.broadcast_shapes(compensated.angle.shape[:-2], believed.shape[:-1], axes.shape[:-1])
    way = navigate(
        stationary_state(latitude, np.broadcast_to(believed, (*lead, 4))),
        compensated,
        every=each,
        hold_altitude=True,
    )
    meridian, across = curvature_radii(latitude)
    east = way.longitude * across * np.cos(latitude)
    times: FloatArray = each * seconds * np.arange(1.0, count // each + 1)
    return StaticNavigationErrors(
        times,
        attitude_error(way.attitude, axes[..., np.newaxis, :]),
        way.velocity[..., :2],
        np.stack([east, (way.latitude - latitude) * meridian], axis=-1),
    )
