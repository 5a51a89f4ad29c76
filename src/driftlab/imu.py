"""Errors of an inertial measurement unit (IMU): a model, their noise, and how large they may be.

``measured rate = (I + K) rate + bias + noise``, and so for the specific force: Wu (1)-(5).
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro

from .checks import (
    LARGEST_ACCELEROMETER_BIAS,
    LARGEST_GYRO_BIAS,
    LARGEST_SCALE,
    USUAL_ACCELEROMETER_BIAS,
    USUAL_GYRO_BIAS,
    FloatArray,
    checked_generator,
    checked_instance,
    error_matrix,
    finite_arrays,
    keep,
    usual_deviation,
    whole_number,
    within,
)


class ImuErrors(NamedTuple):
    """Errors of an inertial unit: 24 numbers, or arrays of them with leading axes.

    Attributes
    ----------
    gyro_bias : ndarray, shape (..., 3)
        rad/s.
    gyro_error : ndarray, shape (..., 3, 3)
        Error matrix K of the gyro triad, without unit.
    accelerometer_bias : ndarray, shape (..., 3)
        m/s^2.
    accelerometer_error : ndarray, shape (..., 3, 3)
        Error matrix L of the accelerometer triad, without unit.

    Examples
    --------
    A unit without errors but for a gyro bias of 0.01 degrees an hour about the first axis:

    >>> imu_errors = NO_ERRORS._replace(gyro_bias=np.array([0.01, 0.0, 0.0]) * degree / hour)
    >>> print(f"{imu_errors.gyro_bias[0]:.3e}")
    4.848e-08
    """

    gyro_bias: FloatArray
    gyro_error: FloatArray
    accelerometer_bias: FloatArray
    accelerometer_error: FloatArray


NO_ERRORS = ImuErrors(np.zeros(3), np.zeros((3, 3)), np.zeros(3), np.zeros((3, 3)))
"""A unit without errors."""

TYPICAL_ERRORS = ImuErrors(
    np.array([0.1, 0.2, 0.3]) * degree / hour,
    np.diag([10.0, 20.0, 30.0]) * micro
    + np.array([[0.0, 10.0, 20.0], [30.0, 0.0, 40.0], [50.0, 60.0, 0.0]]) * arcsecond,
    np.array([10.0, 20.0, 30.0]) * micro * g,
    np.diag([10.0, 20.0, 30.0]) * micro
    + np.array([[0.0, 10.0, 20.0], [30.0, 0.0, 10.0], [20.0, 30.0, 0.0]]) * arcsecond,
)
"""A navigation-grade unit with ring-laser gyros.

The contents of the paper's Table 2 are lost. These sizes are chosen after the defaults of the
public PSINS toolbox; which off-diagonal entry gets which of them is our choice.
"""


@dataclass(frozen=True)
class ImuNoise:
    """White noise of the sensors and of the filter's reference velocity; zero for none.

    Attributes
    ----------
    angle_random_walk : float
        rad/sqrt(s), each gyro.
    velocity_random_walk : float
        (m/s)/sqrt(s), each accelerometer.
    reference_velocity : float
        Standard deviation of each component of the reference velocity, m/s, because the table is
        not quite at rest. Independent from one update of the filter to the next.

    Examples
    --------
    >>> noise = ImuNoise(reference_velocity=0.0)  # the sensors keep their default noise
    >>> print(f"{np.degrees(noise.angle_random_walk) * 60:.4f}")  # degrees per sqrt(hour)
    0.0050
    """

    angle_random_walk: float = 0.005 * degree / float(np.sqrt(hour))
    velocity_random_walk: float = 5 * micro * g
    reference_velocity: float = 0.01

    def __post_init__(self) -> None:
        _check_sizes(self)


@dataclass(frozen=True)
class PriorDeviations:
    """Standard deviations of the unknowns before a calibration; zero for what is known.

    The velocity is not among the unknowns, because the table stands still.

    Attributes
    ----------
    attitude : float
        Error of the attitude at the start about each axis, rad: how well the table is aligned.
    gyro_bias : float
        rad/s, each gyro.
    accelerometer_bias : float
        m/s^2, each accelerometer.
    scale : float
        Diagonal entries of both error matrices, without unit.
    installation : float
        Off-diagonal entries of both error matrices, rad, independent of each other.
    lever_arm : float
        Each component of the accelerometers' lever arms, m; about the size of a unit. This and the
        next ones count only where `HigherOrderErrors` are among the unknowns.
    time_skew : float
        By how much the accelerometers are late, s: a tenth of a sample or so.
    accelerometer_quadratic : float
        s^2/m, each accelerometer: ten micro-g per g^2, as servo accelerometers have it.
    gyro_g_sensitivity : float
        (rad/s)/(m/s^2), each entry: a tenth of a degree an hour per g, much for an optical gyro and
        little for one that holds a mass.
    scale_asymmetry : float
        Scale-factor asymmetry of each gyro and accelerometer, without unit: ten ppm, as good
        optical gyros and servo accelerometers have it.

    Examples
    --------
    >>> print(f"{PriorDeviations().attitude:.3e}")  # one arc minute
    2.909e-04
    """

    attitude: float = 1 * arcminute
    gyro_bias: float = 0.3 * degree / hour
    accelerometer_bias: float = 300 * micro * g
    scale: float = 100 * micro
    installation: float = 40 * arcsecond
    lever_arm: float = 0.03
    time_skew: float = 1e-3
    accelerometer_quadratic: float = 10 * micro / g
    gyro_g_sensitivity: float = 0.1 * degree / hour / g
    scale_asymmetry: float = 10 * micro

    def __post_init__(self) -> None:
        _check_sizes(self)


def _check_sizes(sizes: ImuNoise | PriorDeviations) -> None:
    for field in fields(sizes):
        size = usual_deviation(getattr(sizes, field.name), field.name, stacklevel=5)
        keep(sizes, **{field.name: size})


def random_imu_errors(
    prior: PriorDeviations, rng: np.random.Generator | int, *shape: int
) -> ImuErrors:
    """Draw units whose errors are normally distributed and independent of each other.

    Parameters
    ----------
    prior : PriorDeviations
        Standard deviations of the errors; its `attitude` is not used.
    rng : numpy.random.Generator or int
        Source of the random numbers.
    *shape : int
        Leading axes of the result; one unit without any if not given.

    Returns
    -------
    ImuErrors
        Errors with leading axes `shape`.

    Examples
    --------
    >>> units = random_imu_errors(PriorDeviations(gyro_bias=0.0), np.random.default_rng(1), 5)
    >>> units.gyro_error.shape
    (5, 3, 3)
    >>> bool(units.gyro_bias.any())
    False
    """
    checked_instance(prior, PriorDeviations, "prior")
    draw = checked_generator(rng).standard_normal
    shape = tuple(whole_number(length, "shape") for length in shape)
    sizes = np.where(np.eye(3, dtype=bool), prior.scale, prior.installation)
    return ImuErrors(
        prior.gyro_bias * draw((*shape, 3)),
        sizes * draw((*shape, 3, 3)),
        prior.accelerometer_bias * draw((*shape, 3)),
        sizes * draw((*shape, 3, 3)),
    )


def checked_imu_errors(imu_errors: ImuErrors) -> ImuErrors:
    """Return the errors of a unit as arrays whose leading axes are broadcast to each other."""
    checked_instance(imu_errors, ImuErrors, "imu_errors")
    checked = finite_arrays(
        gyro_bias=(imu_errors.gyro_bias, 3),
        gyro_error=(imu_errors.gyro_error, 3, 3),
        accelerometer_bias=(imu_errors.accelerometer_bias, 3),
        accelerometer_error=(imu_errors.accelerometer_error, 3, 3),
    )
    return broadcast_imu_errors(ImuErrors(*checked))


def real_imu_errors(imu_errors: ImuErrors) -> ImuErrors:
    """Return a unit as `checked_imu_errors` does, refusing also what no function here is for.

    Parameters
    ----------
    imu_errors : ImuErrors
        Its fields may be anything that NumPy makes an array of.

    Returns
    -------
    ImuErrors
        Float64 arrays, their leading axes broadcast to each other.

    Raises
    ------
    ValueError
        If a bias drowns the Earth's rate or gravity; or as for `checked_imu_errors`.

    Warns
    -----
    UnusualWarning
        If a bias is of a size that few sensors have, an error matrix looks like the whole matrix
        I + K, or its entries like no rad and parts of the scale.

    Examples
    --------
    >>> real_imu_errors(NO_ERRORS._replace(gyro_bias=np.array([10.0, 20.0, 30.0])))
    Traceback (most recent call last):
    ValueError: gyro_bias: expected rad/s, at most 10 in size, got 30: is it in deg/h?
    """
    errors = checked_imu_errors(imu_errors)
    for name, most, usual, unit, slip in (
        ("gyro_bias", LARGEST_GYRO_BIAS, USUAL_GYRO_BIAS, "rad/s", "is it in deg/h?"),
        ("accelerometer_bias", LARGEST_ACCELEROMETER_BIAS, USUAL_ACCELEROMETER_BIAS, "m/s^2",
         "is it in mg?"),
    ):  # fmt: skip
        within(getattr(errors, name), name, most, unit, slip, usual)
    for name in ("gyro_error", "accelerometer_error"):
        error_matrix(getattr(errors, name), name, LARGEST_SCALE)
    return errors


def broadcast_imu_errors(imu_errors: ImuErrors, *shape: int) -> ImuErrors:
    """Return a unit with its leading axes broadcast to each other and to a given shape.

    Parameters
    ----------
    imu_errors : ImuErrors
        Float64 arrays.
    *shape : int
        Leading axes to broadcast to; none for the unit's own.

    Returns
    -------
    ImuErrors
        Read-only views with common leading axes.

    Examples
    --------
    >>> broadcast_imu_errors(NO_ERRORS, 2).gyro_bias
    array([[0., 0., 0.],
           [0., 0., 0.]])
    """
    cores = (1, 2, 1, 2)
    own = (array.shape[: array.ndim - core] for array, core in zip(imu_errors, cores, strict=True))
    lead = np.broadcast_shapes(shape, *own)
    return ImuErrors(
        *(
            np.broadcast_to(array, lead + array.shape[array.ndim - core :])
            for array, core in zip(imu_errors, cores, strict=True)
        )
    )


for _errors in (NO_ERRORS, TYPICAL_ERRORS):
    for _array in _errors:
        _array.setflags(write=False)
