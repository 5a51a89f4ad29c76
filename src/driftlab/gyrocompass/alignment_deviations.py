"""How well a heading at rest can be known: noise, biases, two-position alignment."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays, positive_array, usual_deviation
from driftlab.earth import EARTH_RATE, checked_latitude, gravity

from ._contradictions import NOTHING_KNOWN

_LEAST_TURN = np.radians(5.0)


def alignment_standard_deviation(
    latitude: ArrayLike,
    duration: ArrayLike,
    angle_random_walk: float,
    *,
    gyro_bias: float = 0.0,
    accelerometer_bias: float = 0.0,
) -> FloatArray:
    """Standard deviation of the heading of `align`, before it is run: one position.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    duration : array_like, shape (...)
        T of the means, s.
    angle_random_walk : float
        N of each gyro: square root of the density of its white noise, rad/√s.
    gyro_bias, accelerometer_bias : float
        Standard deviations of the biases of each sensor, rad/s and m/s^2.

    Returns
    -------
    ndarray, shape (...)
        rad, for a level body; at most pi/sqrt(3), 104 degrees, where nothing is known.

    Raises
    ------
    ValueError
        Within 0.1 degrees of a pole, if a duration is not positive, or a deviation negative.

    See Also
    --------
    align : The alignment itself.
    two_position_standard_deviation : With half a turn between two rests.
    driftlab.noise_terms.fit_noise_terms : The random walk of a record.

    Notes
    -----
    The first part is N / (U cos(latitude) √T). The mean of white noise is the best estimate of the
    rate that there is, so at rest no method that has nothing but these gyros gets below this bound
    (Cramér and Rao). Waiting helps against the noise only.

    Examples
    --------
    A gyro of 0.003 degrees per root hour at 60 degrees, in degrees of heading:

    >>> walk = np.radians(0.003) / 60
    >>> np.degrees(alignment_standard_deviation(np.radians(60.0), [75.0, 300.0], walk)).round(4)
    array([0.1583, 0.0792])
    """
    place, time = _checked(latitude, duration)
    walk, drift, offset = _deviations(
        angle_random_walk=angle_random_walk,
        gyro_bias=gyro_bias,
        accelerometer_bias=accelerometer_bias,
    )
    level = EARTH_RATE * np.cos(place)
    by_gyro = np.hypot(walk / np.sqrt(time), drift) / level
    return np.minimum(np.hypot(by_gyro, offset * np.tan(place) / gravity(place)), NOTHING_KNOWN)


def two_position_standard_deviation(
    latitude: ArrayLike,
    duration: ArrayLike,
    angle_random_walk: float,
    turn_angle: ArrayLike = np.pi,
    *,
    turn_error: float = 0.0,
    gyro_bias_change: float = 0.0,
    accelerometer_bias_change: float = 0.0,
) -> FloatArray:
    """Standard deviation of the heading of `align_multi_position`, with two positions.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    duration : array_like, shape (...)
        T of both positions together, s; each has half of it.
    angle_random_walk : float
        N of each gyro, rad/√s.
    turn_angle : array_like, shape (...)
        Angle about Up between the positions, rad, within a whole turn to either side.
    turn_error : float
        Standard deviation of what is known of this angle, rad.
    gyro_bias_change, accelerometer_bias_change : float
        Standard deviations of the change of a sensor's bias from one position to the other, rad/s
        and m/s^2. The biases themselves do not count.

    Returns
    -------
    ndarray, shape (...)
        rad, for a level body in its first position; at most pi/sqrt(3), as above.

    Raises
    ------
    ValueError
        As in `alignment_standard_deviation`, for a turn by 5 degrees or less, and by more than a
        whole one.

    Notes
    -----
    With s = sin(turn_angle/2) the square of the deviation is

        (N²/T + change²/4) / (s U cos φ)² + (turn_error/2)² + (change tan φ / (2 s g))²,

    the last with the accelerometers' change. Half a turn has s = 1: what the noise does is what it
    does in one position of the same time, and the bias is gone. If a drift wanders as slowly as may
    be, noise and change together are the Allan deviation σ of the gyro: σ(T/2) / (√2 s U cos φ).

    Examples
    --------
    The gyro of `alignment_standard_deviation`, half a turn and a right angle, in degrees of
    heading:

    >>> walk = np.radians(0.003) / 60
    >>> turns = np.radians([180.0, 90.0])
    >>> np.degrees(two_position_standard_deviation(np.radians(60.0), 300.0, walk, turns)).round(4)
    array([0.0792, 0.112 ])
    """
    place, time, angle = _checked(latitude, duration, turn_angle=(turn_angle,))
    if np.abs(angle).max() > 2 * np.pi:
        raise ValueError(
            "turn_angle: expected rad, at most a whole turn to either side, got "
            f"{angle.flat[np.argmax(np.abs(angle))]:.6g}."
        )
    half = np.abs(np.sin(angle / 2))
    if half.min() < np.sin(_LEAST_TURN / 2):
        raise ValueError(
            "turn_angle: expected angles of more than 5 degrees to either side of no turn, got "
            f"{np.degrees(angle.flat[np.argmin(half)]):.6g} degrees."
        )
    walk, wrong, drift, offset = _deviations(
        angle_random_walk=angle_random_walk,
        turn_error=turn_error,
        gyro_bias_change=gyro_bias_change,
        accelerometer_bias_change=accelerometer_bias_change,
    )
    by_gyro = np.hypot(walk / np.sqrt(time), drift / 2) / (half * EARTH_RATE * np.cos(place))
    by_level = offset * np.tan(place) / (2 * half * gravity(place))
    found = np.sqrt(by_gyro**2 + (wrong / 2) ** 2 + by_level**2)
    return np.minimum(found, NOTHING_KNOWN)


def _checked(
    latitude: ArrayLike, duration: ArrayLike, **others: tuple[ArrayLike]
) -> list[FloatArray]:
    place, time, *rest = finite_arrays(latitude=(latitude,), duration=(duration,), **others)
    checked_latitude(place)
    return [place, positive_array(time, "duration"), *rest]


def _deviations(**values: float) -> list[float]:
    # A comprehension is one more call in Python 3.11, and the warning would point into it.
    return [*map(usual_deviation, values.values(), values)]
