"""Wu et al., Figs. 3-5: a calibrated unit stands still and navigates; what it shows is error."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_number, unit_quaternions
from driftlab.earth import curvature_radii
from driftlab.imu import Noise, Unit, compensate, measure
from driftlab.motion.turntable import stand
from driftlab.strapdown import at_rest, navigate

from .error_model import attitude_error


class InPlace(NamedTuple):
    """Errors of a unit that stands still, computed minus true."""

    times: FloatArray  # (k,), s
    attitude: FloatArray  # (..., k, 3), rad about East, North, Up
    velocity: FloatArray  # (..., k, 2), m/s: East, North
    position: FloatArray  # (..., k, 2), m: East, North


def navigate_in_place(
    unit: Unit,
    found: Unit,
    attitude: ArrayLike,
    *,
    start: ArrayLike,
    reference: ArrayLike,
    latitude: float,
    duration: float,
    interval: float = 0.5,
    every: float = 60.0,
    noise: Noise | None = None,
    rng: np.random.Generator | None = None,
) -> InPlace:
    """Navigate with a unit at rest whose errors are taken out as far as they were found.

    Parameters
    ----------
    unit : Unit
        The true errors (...), in the axes of `attitude`.
    found : Unit
        The errors that a calibration found (...), in the body axes of its own choice.
    attitude : array_like, shape (4,)
        How the unit stands, body to East, North, Up.
    start : array_like, shape (..., 4)
        Attitude that the computer begins with.
    reference : array_like, shape (..., 4)
        True attitude of the axes whose attitude is wanted: errors count from it.
    latitude : float
        rad.
    duration, interval, every : float
        Of the navigation, between the increments, and between two results, s. The latter is rounded
        to an even number of increments, and the duration to a whole number of results.
    noise, rng
        As in `driftlab.imu.measure`.

    Notes
    -----
    Altitude and vertical velocity are held, as by a barometer.
    """
    seconds = finite_number(interval, "interval")
    if not 0 < seconds <= finite_number(every, "every") <= finite_number(duration, "duration"):
        raise ValueError(
            "interval, every, duration: expected positive times, each at least as long as the one "
            f"before, got {interval!r}, {every!r}, {duration!r} s."
        )
    # An even number of increments for each result.
    each = 2 * max(1, round(every / seconds / 2))
    count = each * max(1, round(duration / (each * seconds)))
    record = stand(attitude, latitude, seconds, count)
    angle, velocity = compensate(*measure(record, unit, noise, rng), found, seconds)
    believed, axes = unit_quaternions(start, "start"), unit_quaternions(reference, "reference")
    lead = np.broadcast_shapes(angle.shape[:-2], believed.shape[:-1], axes.shape[:-1])
    way = navigate(
        at_rest(latitude, np.broadcast_to(believed, (*lead, 4))),
        angle,
        velocity,
        seconds,
        every=each,
        hold_altitude=True,
    )
    meridian, across = curvature_radii(latitude)
    east = way.longitude * across * np.cos(latitude)
    times: FloatArray = each * seconds * np.arange(1.0, count // each + 1)
    return InPlace(
        times,
        attitude_error(way.attitude, axes[..., np.newaxis, :]),
        way.velocity[..., :2],
        np.stack([east, (way.latitude - latitude) * meridian], axis=-1),
    )
