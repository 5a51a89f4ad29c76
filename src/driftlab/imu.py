"""Errors of an inertial measurement unit (IMU): a model, their noise, and how large they may be.

``measured rate = (I + K) rate + bias + noise``, and so for the specific force: Wu (1)-(5).
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from .checks import (
    LARGEST_ACCELEROMETER_BIAS,
    LARGEST_GYRO_BIAS,
    LARGEST_SCALE,
    USUAL_ACCELEROMETER_BIAS,
    USUAL_GYRO_BIAS,
    FloatArray,
    checked_generator,
    checked_instance,
    finite_arrays,
    keep,
    plausible_error_matrix,
    usual_deviation,
    whole_number,
    within,
)

# As scipy.constants has them, which takes longer to load than everything that needs this module.
degree, hour, micro, g = np.pi / 180, 3600.0, 1e-6, 9.80665
arcminute, arcsecond = degree / 60, degree / 3600


class ImuErrors(NamedTuple):
    """Errors of an inertial unit: 24 numbers, or arrays of them with leading axes.

    Attributes
    ----------
    gyro_bias : ndarray, shape (..., 3)
        rad/s.
    gyro_error_matrix : ndarray, shape (..., 3, 3)
        Error matrix K of the gyro triad, without unit.
    accelerometer_bias : ndarray, shape (..., 3)
        m/s^2.
    accelerometer_error_matrix : ndarray, shape (..., 3, 3)
        Error matrix L of the accelerometer triad, without unit.

    Examples
    --------
    A unit whose only error is a bias of the first gyro, 0.01 degrees per hour:

    >>> imu_errors = NO_ERRORS._replace(gyro_bias=np.array([0.01, 0.0, 0.0]) * degree / hour)
    >>> print(f"{imu_errors.gyro_bias[0]:.3e}")
    4.848e-08
    """

    gyro_bias: FloatArray
    gyro_error_matrix: FloatArray
    accelerometer_bias: FloatArray
    accelerometer_error_matrix: FloatArray


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
    """Noise of the sensors and of the filter's reference velocity; zero for none.

    Attributes
    ----------
    angle_random_walk : float
        rad/sqrt(s), each gyro.
    velocity_random_walk : float
        (m/s)/sqrt(s), each accelerometer.
    reference_velocity : float
        Standard deviation of each component of the reference velocity, m/s; 1e-4 or less for
        a table that stands. Independent from one update of the filter to the next.
    gyro_bias_instability, accelerometer_bias_instability : float
        Standard deviation of the part of each bias that varies, rad/s and m/s^2: a stationary
        first-order Gauss-Markov process, in addition to the constant (turn-on) bias.
    gyro_correlation_time, accelerometer_correlation_time : float
        Of these processes, s: in this time the autocorrelation falls to 1/e.

    Notes
    -----
    Data sheets often call the flat, lowest part of the Allan deviation the bias instability. A
    Gauss-Markov process with the standard deviation s and the correlation time T has an Allan
    deviation that is largest at the averaging time 1.89 T, where it is 0.617 s. So s is 1.62 times
    the flat part, and T the averaging time there divided by 1.89. The flat part is 0.664 B in IEEE
    Std 952, so s is 1.08 times its coefficient B.

    Examples
    --------
    Gyros whose biases vary by 0.003 degrees per hour (1σ) in some ten minutes:

    >>> noise = ImuNoise(
    ...     gyro_bias_instability=0.003 * degree / hour, gyro_correlation_time=600.0
    ... )
    >>> noise = ImuNoise(reference_velocity=0.0)  # the sensors keep their default noise
    >>> print(f"{np.degrees(noise.angle_random_walk) * 60:.4f}")  # degrees per sqrt(hour)
    0.0050
    """

    angle_random_walk: float = 0.005 * degree / float(np.sqrt(hour))
    velocity_random_walk: float = 5 * micro * g
    reference_velocity: float = 0.01
    gyro_bias_instability: float = 0.0
    gyro_correlation_time: float = 0.0
    accelerometer_bias_instability: float = 0.0
    accelerometer_correlation_time: float = 0.0

    def __post_init__(self) -> None:
        _check_sizes(self)
        for sensor in ("gyro", "accelerometer"):
            size = getattr(self, f"{sensor}_bias_instability")
            if size and not getattr(self, f"{sensor}_correlation_time"):
                raise ValueError(
                    f"{sensor}_correlation_time: expected a time above 0 s for a bias instability "
                    f"of {size:g}, got 0."
                )


@dataclass(frozen=True)
class PriorStandardDeviations:
    """Standard deviations of the unknowns before a calibration; zero for what is known.

    Attributes
    ----------
    attitude : float
        Error of the attitude at the start about each axis, rad: how well the table is aligned.
    gyro_bias : float
        rad/s, each gyro.
    accelerometer_bias : float
        m/s^2, each accelerometer.
    scale_factor : float
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
    scale_factor_asymmetry : float
        Scale-factor asymmetry of each gyro and accelerometer, without unit: ten ppm, as good
        optical gyros and servo accelerometers have it.
    velocity : float
        Of each component at the start, m/s: zero on a table, which stands still; not on a ship.

    Examples
    --------
    >>> print(f"{PriorStandardDeviations().attitude:.3e}")  # one arc minute
    2.909e-04
    """

    attitude: float = 1 * arcminute
    gyro_bias: float = 0.3 * degree / hour
    accelerometer_bias: float = 300 * micro * g
    scale_factor: float = 100 * micro
    installation: float = 40 * arcsecond
    lever_arm: float = 0.03
    time_skew: float = 1e-3
    accelerometer_quadratic: float = 10 * micro / g
    gyro_g_sensitivity: float = 0.1 * degree / hour / g
    scale_factor_asymmetry: float = 10 * micro
    velocity: float = 0.0

    def __post_init__(self) -> None:
        _check_sizes(self)


def _check_sizes(sizes: ImuNoise | PriorStandardDeviations) -> None:
    for field in fields(sizes):
        size = usual_deviation(getattr(sizes, field.name), field.name, stacklevel=5)
        keep(sizes, **{field.name: size})


def random_imu_errors(
    prior: PriorStandardDeviations, rng: np.random.Generator | int, *shape: int
) -> ImuErrors:
    """Draw units whose errors are normally distributed and independent of each other.

    Parameters
    ----------
    prior : PriorStandardDeviations
        Standard deviations of the errors; its `attitude` is not used.
    rng : numpy.random.Generator or int
        Source of the random numbers.
    *shape : int
        Leading axes of the result; none for one unit.

    Returns
    -------
    ImuErrors
        Errors with leading axes `shape`.

    Examples
    --------
    >>> prior = PriorStandardDeviations(gyro_bias=0.0)
    >>> units = random_imu_errors(prior, np.random.default_rng(1), 5)
    >>> units.gyro_error_matrix.shape
    (5, 3, 3)
    """
    checked_instance(prior, PriorStandardDeviations, "prior")
    draw = checked_generator(rng).standard_normal
    shape = tuple(whole_number(length, "shape") for length in shape)
    sizes = np.where(np.eye(3, dtype=bool), prior.scale_factor, prior.installation)
    return ImuErrors(
        prior.gyro_bias * draw((*shape, 3)),
        sizes * draw((*shape, 3, 3)),
        prior.accelerometer_bias * draw((*shape, 3)),
        sizes * draw((*shape, 3, 3)),
    )


def checked_imu_errors(imu_errors: ImuErrors, *shape: int) -> ImuErrors:
    """Return the errors of a unit as arrays whose leading axes are broadcast to each other.

    If a `shape` is given, they are broadcast to it as well.
    """
    checked_instance(imu_errors, ImuErrors, "imu_errors")
    cores = (3,), (3, 3), (3,), (3, 3)
    named = zip(imu_errors._asdict().items(), cores, strict=True)
    checked = finite_arrays(**{name: (value, *core) for (name, value), core in named})
    own = (array.shape[: -len(core)] for array, core in zip(checked, cores, strict=True))
    lead = np.broadcast_shapes(shape, *own)
    pairs = zip(checked, cores, strict=True)
    return ImuErrors(*(np.broadcast_to(array, lead + core) for array, core in pairs))


def checked_usual_imu_errors(imu_errors: ImuErrors) -> ImuErrors:
    """Return a unit as `checked_imu_errors` does, refusing biases that no unit here has.

    A bias of a size that few sensors have gives an `UnusualWarning`, and so does an error matrix
    that looks like I + K, or like one in other units.
    """
    errors = checked_imu_errors(imu_errors)
    most, usual = LARGEST_GYRO_BIAS, USUAL_GYRO_BIAS
    within(errors.gyro_bias, "gyro_bias", most, "rad/s", "is it in deg/h?", usual)
    most, usual = LARGEST_ACCELEROMETER_BIAS, USUAL_ACCELEROMETER_BIAS
    within(errors.accelerometer_bias, "accelerometer_bias", most, "m/s^2", "is it in mg?", usual)
    for name in ("gyro_error_matrix", "accelerometer_error_matrix"):
        plausible_error_matrix(getattr(errors, name), name, LARGEST_SCALE)
    return errors


for _errors in (NO_ERRORS, TYPICAL_ERRORS):
    for _array in _errors:
        _array.setflags(write=False)
