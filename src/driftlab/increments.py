"""What an inertial unit delivers: increments of angle and velocity, with its errors and without.

An integrating sensor counts how far the body has turned, and how much velocity it has gained,
since the last sample. Increments lose nothing between two samples, whatever the motion.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .checks import (
    FloatArray,
    checked_generator,
    checked_instance,
    finite_array,
    positive_number,
    row_number,
)
from .core.gauss_markov import gauss_markov
from .higher_order_errors import (
    HigherOrderErrors,
    checked_higher_order_errors,
    higher_order_effects,
)
from .imu import ImuErrors, ImuNoise, checked_usual_imu_errors


class Increments(NamedTuple):
    """Increments of an inertial unit over n equal intervals.

    Attributes
    ----------
    interval : float
        Sample interval, s.
    angle : ndarray, shape (..., n, 3)
        Integrals of the angular rate against inertial space, body axes, rad.
    velocity : ndarray, shape (..., n, 3)
        Integrals of the specific force, body axes, m/s.

    See Also
    --------
    driftlab.recordings.Recording.increments : From a log.
    driftlab.sampled_rates.increments_from_rates : From sampled rates.

    Examples
    --------
    Two seconds of a body that lies still on a planet that does not turn:

    >>> increments = Increments(1.0, np.zeros((2, 3)), np.tile([0.0, 0.0, 9.8], (2, 1)))
    >>> increments.part(0, 1).velocity
    array([[0. , 0. , 9.8]])
    """

    interval: float
    angle: FloatArray
    velocity: FloatArray

    @property
    def mean_rate(self) -> FloatArray:
        """Mean angular rate (..., n, 3) over each interval, body axes, rad/s."""
        interval, angle, _ = checked_increments(self)
        return angle / interval

    def part(self, begin: int, end: int) -> Increments:
        """Return the increments of intervals `begin` to `end`, as in a slice, as views."""
        rows = np.s_[..., row_number(begin, "begin") : row_number(end, "end"), :]
        return Increments(self.interval, self.angle[rows], self.velocity[rows])


def checked_increments(increments: Increments) -> Increments:
    """Return increments as arrays, as many velocities as angles, over a positive interval.

    Their leading axes are not broadcast.
    """
    checked_instance(increments, Increments, "increments")
    seconds = positive_number(increments.interval, "increments.interval")
    rows = []
    for name in ("angle", "velocity"):
        row = finite_array(getattr(increments, name), f"increments.{name}", 3)
        if row.ndim < 2:
            raise ValueError(
                f"increments.{name}: expected shape (..., n, 3), got shape {row.shape}."
            )
        rows.append(row)
    angle, velocity = rows
    if angle.shape[-2] != velocity.shape[-2]:
        raise ValueError(
            "increments.velocity: expected as many as increments.angle, "
            f"{angle.shape[-2]}, got {velocity.shape[-2]}."
        )
    return Increments(seconds, angle, velocity)


def measure(
    increments: Increments,
    imu_errors: ImuErrors,
    noise: ImuNoise | None = None,
    rng: np.random.Generator | int | None = None,
    *,
    higher_order: HigherOrderErrors | None = None,
) -> Increments:
    """Increments as a unit with errors and noise reports them; Wu (1)-(5).

    Parameters
    ----------
    increments : Increments
        True increments, n of them.
    imu_errors : ImuErrors
        Errors of the unit. Their leading axes (...) are those of the result.
    noise : ImuNoise, optional
        None for a unit without noise. A bias instability is held over each interval.
    rng : numpy.random.Generator or int, optional
        Source of the noise; needed for noise only.
    higher_order : HigherOrderErrors, optional
        Lever arms and other errors that bias and matrix do not describe.

    Returns
    -------
    Increments
        Arrays of shape (..., n, 3), rad and m/s.

    See Also
    --------
    driftlab.motion.turntable_trajectory : True increments on a table.

    Examples
    --------
    A second at rest, with a gyro bias as the only error:

    >>> from driftlab.imu import NO_ERRORS
    >>> true = Increments(1.0, np.zeros((1, 3)), np.array([[0.0, 0.0, 9.8]]))
    >>> biased = NO_ERRORS._replace(gyro_bias=np.array([0.0, 0.0, 1e-3]))
    >>> measure(true, biased).angle
    array([[0.   , 0.   , 0.001]])
    """
    seconds, angle, velocity = checked_increments(increments)
    errors = checked_usual_imu_errors(imu_errors)
    if noise is not None:
        checked_instance(noise, ImuNoise, "noise")
    source = None if rng is None else checked_generator(rng)
    if higher_order is not None:
        more = higher_order_effects(
            seconds, angle, velocity, checked_higher_order_errors(higher_order)
        )
        angle, velocity = angle + more[0], velocity + more[1]
    found = []
    for sensor, true, walk in (
        ("gyro", angle, "angle_random_walk"),
        ("accelerometer", velocity, "velocity_random_walk"),
    ):
        error = getattr(errors, f"{sensor}_error_matrix")
        measured = true @ np.swapaxes(np.eye(3) + error, -1, -2)
        measured = measured + (seconds * getattr(errors, f"{sensor}_bias"))[..., np.newaxis, :]
        size = 0.0 if noise is None else getattr(noise, walk) * np.sqrt(seconds)
        if size:
            measured += size * checked_generator(source).standard_normal(measured.shape)
        if noise is not None and (varying := getattr(noise, f"{sensor}_bias_instability")):
            kept = float(np.exp(-seconds / getattr(noise, f"{sensor}_correlation_time")))
            draws = checked_generator(source).standard_normal(np.swapaxes(measured, -1, -2).shape)
            measured += seconds * varying * np.swapaxes(gauss_markov(draws, kept), -1, -2)
        found.append(measured)
    return Increments(seconds, found[0], found[1])


def compensate(
    increments: Increments,
    imu_errors: ImuErrors,
    *,
    higher_order: HigherOrderErrors | None = None,
) -> Increments:
    """Take the known errors of a unit out of its increments: the inverse of `measure`.

    Parameters
    ----------
    increments : Increments
        Measured, arrays of shape (..., n, 3).
    imu_errors : ImuErrors
        Errors of the unit; their leading axes broadcast against those of the increments.
    higher_order : HigherOrderErrors, optional
        Errors that bias and matrix do not describe; they are taken out to the third order.

    Returns
    -------
    Increments
        True except for the noise.

    Raises
    ------
    ValueError
        If the sensitive axes of a triad lie in one plane, so that its errors cannot be taken out.

    See Also
    --------
    driftlab.calibration.from_json : Reads errors that were kept.

    Examples
    --------
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> true = Increments(1.0, np.zeros((1, 3)), np.array([[0.0, 0.0, 9.8]]))
    >>> compensate(measure(true, TYPICAL_ERRORS), TYPICAL_ERRORS).velocity.round(12) + 0.0
    array([[0. , 0. , 9.8]])
    """
    errors = checked_usual_imu_errors(imu_errors)
    for name in ("gyro_error_matrix", "accelerometer_error_matrix"):
        if (np.linalg.cond(np.eye(3) + getattr(errors, name)) > 1e12).any():
            raise ValueError(f"{name}: expected a triad I + K that spans space, got a flat one.")
    if higher_order is not None:
        higher_order = checked_higher_order_errors(higher_order)
    return _without_errors(checked_increments(increments), errors, higher_order)


def _without_errors(
    increments: Increments,
    imu_errors: ImuErrors,
    higher_order: HigherOrderErrors | None = None,
    rate_change: FloatArray | None = None,
) -> Increments:
    """Take known errors out as `compensate` does; `rate_change` as of `higher_order_effects`."""
    seconds, angle, velocity = increments
    angle = _without(angle, seconds * imu_errors.gyro_bias, imu_errors.gyro_error_matrix)
    velocity = _without(
        velocity, seconds * imu_errors.accelerometer_bias, imu_errors.accelerometer_error_matrix
    )
    if higher_order is not None:
        plain = angle, velocity
        for _ in range(2):  # the first time from what is not yet true; then third order is left
            more = higher_order_effects(seconds, angle, velocity, higher_order, rate_change)
            angle, velocity = plain[0] - more[0], plain[1] - more[1]
    return Increments(seconds, angle, velocity)


def _without(measured: FloatArray, bias: FloatArray, error: FloatArray) -> FloatArray:
    plain = measured - bias[..., np.newaxis, :]
    return plain @ np.swapaxes(np.linalg.inv(np.eye(3) + error), -1, -2)
