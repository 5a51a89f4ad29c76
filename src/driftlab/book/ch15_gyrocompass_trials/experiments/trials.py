"""Trials of a gyrocompass as the paper made them: on a dial table, and by restarts.

Also a statistic of the spread of a few results: the range over the standard deviation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_arrays, whole_number
from driftlab.core.quaternion import from_rotation_vector, multiply
from driftlab.core.vectors import wrap_angle
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.motion.vehicle import static_imu


def turntable_heading_error(
    dial_reading: ArrayLike,
    gyro_bias_body: ArrayLike,
    accelerometer_bias_body: ArrayLike,
    latitude: ArrayLike,
    *,
    pitch: ArrayLike = 0.0,
    roll: ArrayLike = 0.0,
    north_error: ArrayLike = 0.0,
    tilt: ArrayLike = (0.0, 0.0),
) -> FloatArray:
    """Heading of an aligned compass minus the reading of the dial of its table.

    Parameters
    ----------
    dial_reading : array_like, shape (...)
        rad.
    gyro_bias_body : array_like, shape (..., 3)
        Gyro biases in body axes, rad/s.
    accelerometer_bias_body : array_like, shape (..., 3)
        Accelerometer biases in body axes, m/s^2.
    latitude : array_like, shape (...)
        rad.
    pitch, roll : array_like, shape (...)
        To which the table is turned, rad.
    north_error : array_like, shape (...)
        True heading at which the dial reads zero, rad.
    tilt : array_like, shape (..., 2)
        Of the table about North and about East, rad.

    Returns
    -------
    ndarray, shape (...)
        rad, from -pi to pi.

    Raises
    ------
    ValueError
        If the shapes do not broadcast, or as in `align` at a pole.

    Examples
    --------
    The bias of a gyro turns with the table. Heading error in arc minutes:

    >>> dial, bias = np.radians([0, 60, 120, 180]), np.radians([0, 0, 0.01]) / 3600
    >>> error = turntable_heading_error(dial, bias, np.zeros(3), np.radians(60.0))
    >>> (60 * np.degrees(error)).round(2)
    array([ 4.57,  2.28, -2.28, -4.57])
    """
    shown, up, over, gyro_biases, accelerometer_biases, place, north, tilts = finite_arrays(
        dial_reading=(dial_reading,),
        pitch=(pitch,),
        roll=(roll,),
        gyro_bias_body=(gyro_bias_body, 3),
        accelerometer_bias_body=(accelerometer_bias_body, 3),
        latitude=(latitude,),
        north_error=(north_error,),
        tilt=(tilt, 2),
    )
    leaning = np.insert(tilts, 1, 0.0, axis=-1)
    attitude = multiply(from_rotation_vector(leaning), from_euler_angles(shown + north, up, over))
    rate, force = static_imu(attitude, place)
    # Whoever puts errors in need not be warned of them.
    found = align(rate + gyro_biases, force + accelerometer_biases, heading_tolerance=np.inf)
    return wrap_angle(found.heading - shown)


def range_over_standard_deviation(values: ArrayLike) -> FloatArray:
    """Range of a sample over its standard deviation.

    Parameters
    ----------
    values : array_like, shape (..., n)
        Samples of n values each, in any unit.

    Returns
    -------
    ndarray, shape (...)
        Without unit; the standard deviation is the one with the divisor n - 1.

    Raises
    ------
    ValueError
        If a sample has fewer than two values, or equal values only.

    Examples
    --------
    >>> float(range_over_standard_deviation([1.0, 2.0, 3.0]))
    2.0
    """
    sample = finite_array(values, "values")
    if sample.ndim == 0 or sample.shape[-1] < 2:
        raise ValueError(f"values: expected at least two a sample, got shape {sample.shape}.")
    reach = np.ptp(sample, axis=-1)
    if not reach.all():
        raise ValueError("values: expected samples that spread, got equal values.")
    # In units of the range, so that no square underflows.
    scaled = (sample - sample[..., :1]) / reach[..., np.newaxis]
    ratio: FloatArray = 1 / scaled.std(axis=-1, ddof=1)
    return ratio


def largest_range_over_standard_deviation(count: int) -> float:
    """Largest possible `range_over_standard_deviation` of a sample: sqrt(2 (n - 1)).

    A sample with one value at either end and all others midway between them attains it.

    Parameters
    ----------
    count : int
        n, at least 2.

    Returns
    -------
    float
        Without unit.

    Examples
    --------
    >>> float(range_over_standard_deviation([1.0, 2.0, 3.0]))
    2.0
    >>> largest_range_over_standard_deviation(3)
    2.0
    """
    return float(np.sqrt(2 * (whole_number(count, "count", least=2) - 1)))
