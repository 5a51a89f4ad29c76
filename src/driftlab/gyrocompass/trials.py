"""Trials of a gyrocompass as the paper made them: on a dial table, and by restarts.

Also what the spread of a few results can say: the range of a sample over its standard deviation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_arrays, whole_number
from driftlab.core.quaternion import from_rotation_vector, multiply
from driftlab.core.vectors import wrap_angle
from driftlab.frames import attitude_from_angles
from driftlab.motion.vehicle import sensed_at_rest

from .alignment import align


def table_heading_error(
    dial: ArrayLike,
    drift: ArrayLike,
    offset: ArrayLike,
    latitude: ArrayLike,
    *,
    north_error: ArrayLike = 0.0,
    tilt: ArrayLike = (0.0, 0.0),
) -> FloatArray:
    """Heading (...) of an aligned compass minus what the dial of its table shows, rad.

    Parameters
    ----------
    dial : array_like, shape (...)
        What the dial shows, rad.
    drift, offset : array_like, shape (..., 3)
        Errors of the gyros in rad/s and of the accelerometers in m/s^2, in body axes.
    latitude : array_like, shape (...)
        rad.
    north_error : array_like, shape (...)
        True heading where the dial shows zero, rad.
    tilt : array_like, shape (..., 2)
        Of the table about North and about East, rad.
    """
    shown, drifts, offsets, place, north, tilts = finite_arrays(
        dial=(dial,),
        drift=(drift, 3),
        offset=(offset, 3),
        latitude=(latitude,),
        north_error=(north_error,),
        tilt=(tilt, 2),
    )
    leaning = np.insert(tilts, 1, 0.0, axis=-1)
    attitude = multiply(
        from_rotation_vector(leaning), attitude_from_angles(shown + north, 0.0, 0.0)
    )
    rate, force = sensed_at_rest(attitude, place)
    return wrap_angle(align(rate + drifts, force + offsets).heading - shown)


def range_over_deviation(values: ArrayLike) -> FloatArray:
    """Range over standard deviation (...) of samples (..., n), the latter with n - 1 below."""
    sample = finite_array(values, "values")
    if sample.ndim == 0 or sample.shape[-1] < 2:
        raise ValueError(f"values: expected at least two a sample, got shape {sample.shape}.")
    reach = np.ptp(sample, axis=-1)
    if not reach.all():
        raise ValueError("values: expected samples that spread, got equal values.")
    # In units of the range, so that no square underflows.
    scaled = (sample - sample[..., :1]) / reach[..., np.newaxis]
    return np.asarray(1 / scaled.std(axis=-1, ddof=1))


def most_range_over_deviation(count: int) -> float:
    """Largest value that `range_over_deviation` can have for `count` values: sqrt(2 (n - 1)).

    Two values at the ends and all others in the middle between them.
    """
    return float(np.sqrt(2 * (whole_number(count, "count", least=2) - 1)))


def normal_ranges(count: int, trials: int, rng: np.random.Generator) -> FloatArray:
    """`range_over_deviation` (trials,) of samples of `count` normal values."""
    size = (whole_number(trials, "trials"), whole_number(count, "count", least=2))
    return range_over_deviation(rng.standard_normal(size))
