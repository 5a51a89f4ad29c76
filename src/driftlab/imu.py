"""Error model of an inertial unit: simulation of its errors and noise, and their compensation.

``measured rate = (E + K) rate + bias + noise``, and so for the specific force: Wu (1)-(5).
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro

from driftlab.motion.turntable import Record

from .checks import FloatArray, finite_array, finite_arrays, finite_number


class Unit(NamedTuple):
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

    >>> unit = PERFECT._replace(gyro_bias=np.array([0.01, 0.0, 0.0]) * degree / hour)
    >>> print(f"{unit.gyro_bias[0]:.3e}")
    4.848e-08
    """

    gyro_bias: FloatArray
    gyro_error: FloatArray
    accelerometer_bias: FloatArray
    accelerometer_error: FloatArray


PERFECT = Unit(np.zeros(3), np.zeros((3, 3)), np.zeros(3), np.zeros((3, 3)))
"""A unit without errors."""

TYPICAL = Unit(
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
class Noise:
    """White noise of the sensors and of the filter's reference velocity; zero for none.

    Attributes
    ----------
    angle_random_walk : float
        rad/sqrt(s), each gyro.
    velocity_random_walk : float
        (m/s)/sqrt(s), each accelerometer.
    velocity : float
        Standard deviation of each component of the reference velocity, m/s, because the table is
        not quite at rest. Independent from one update of the filter to the next.

    Examples
    --------
    >>> noise = Noise(velocity=0.0)  # the sensors keep their default noise
    >>> print(f"{np.degrees(noise.angle_random_walk) * 60:.4f}")  # degrees per sqrt(hour)
    0.0050
    """

    angle_random_walk: float = 0.005 * degree / float(np.sqrt(hour))
    velocity_random_walk: float = 5 * micro * g
    velocity: float = 0.01

    def __post_init__(self) -> None:
        _check_sizes(self)


@dataclass(frozen=True)
class Spread:
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

    Examples
    --------
    >>> print(f"{Spread().attitude:.3e}")  # one arc minute
    2.909e-04
    """

    attitude: float = 1 * arcminute
    gyro_bias: float = 0.3 * degree / hour
    accelerometer_bias: float = 300 * micro * g
    scale: float = 100 * micro
    installation: float = 40 * arcsecond

    def __post_init__(self) -> None:
        _check_sizes(self)


def _check_sizes(sizes: Noise | Spread) -> None:
    for field in fields(sizes):
        value = getattr(sizes, field.name)
        if finite_number(value, field.name) < 0:
            raise ValueError(f"{field.name}: expected a number of at least 0, got {value!r}.")


def random_units(spread: Spread, rng: np.random.Generator, *shape: int) -> Unit:
    """Draw units whose errors are normally distributed and independent of each other.

    Parameters
    ----------
    spread : Spread
        Standard deviations of the errors; its `attitude` is not used.
    rng : numpy.random.Generator
        Source of the random numbers.
    *shape : int
        Leading axes of the result; one unit without any if not given.

    Returns
    -------
    Unit
        Errors with leading axes `shape`.

    Examples
    --------
    >>> units = random_units(Spread(gyro_bias=0.0), np.random.default_rng(1), 5)
    >>> units.gyro_error.shape
    (5, 3, 3)
    >>> bool(units.gyro_bias.any())
    False
    """
    sizes = np.where(np.eye(3, dtype=bool), spread.scale, spread.installation)
    return Unit(
        spread.gyro_bias * rng.standard_normal((*shape, 3)),
        sizes * rng.standard_normal((*shape, 3, 3)),
        spread.accelerometer_bias * rng.standard_normal((*shape, 3)),
        sizes * rng.standard_normal((*shape, 3, 3)),
    )


def measure(
    record: Record, unit: Unit, noise: Noise | None = None, rng: np.random.Generator | None = None
) -> tuple[FloatArray, FloatArray]:
    """Angle and velocity increments as a unit with errors and noise reports them; Wu (1)-(5).

    Parameters
    ----------
    record : Record
        True increments, n of them.
    unit : Unit
        Errors of the unit. Their leading axes (...) are those of the result.
    noise : Noise, optional
        None for a unit without noise.
    rng : numpy.random.Generator, optional
        Source of the noise; needed for noise only.

    Returns
    -------
    angle_increments : ndarray, shape (..., n, 3)
        rad.
    velocity_increments : ndarray, shape (..., n, 3)
        m/s.

    Examples
    --------
    Two seconds at rest, with a gyro bias as the only error:

    >>> from driftlab.motion.turntable import stand
    >>> record = stand([0, 0, 0, 1], latitude=0.7, interval=1.0, count=2)
    >>> unit = PERFECT._replace(gyro_bias=np.array([0.0, 0.0, 1e-3]))
    >>> angle, velocity = measure(record, unit)
    >>> (angle - record.angle_increments).round(9)
    array([[0.   , 0.   , 0.001],
           [0.   , 0.   , 0.001]])
    """
    unit = checked_unit(unit)
    found = []
    for true, bias, error, walk in (
        (record.angle_increments, unit.gyro_bias, unit.gyro_error, "angle_random_walk"),
        (
            record.velocity_increments,
            unit.accelerometer_bias,
            unit.accelerometer_error,
            "velocity_random_walk",
        ),
    ):
        measured = true @ np.swapaxes(np.eye(3) + error, -1, -2)
        measured = measured + (record.interval * bias)[..., np.newaxis, :]
        size = 0.0 if noise is None else getattr(noise, walk) * np.sqrt(record.interval)
        if size:
            if rng is None:
                raise ValueError("rng: expected a numpy Generator to draw the noise, got None.")
            measured += size * rng.standard_normal(measured.shape)
        found.append(measured)
    return found[0], found[1]


def compensate(
    angle_increments: ArrayLike, velocity_increments: ArrayLike, unit: Unit, interval: float
) -> tuple[FloatArray, FloatArray]:
    """Take the known errors of a unit out of its increments: the inverse of `measure`.

    Parameters
    ----------
    angle_increments : array_like, shape (..., n, 3)
        Measured, rad.
    velocity_increments : array_like, shape (..., n, 3)
        Measured, m/s.
    unit : Unit
        Errors of the unit; their leading axes broadcast against those of the increments.
    interval : float
        Sample interval, s.

    Returns
    -------
    angle_increments : ndarray, shape (..., n, 3)
        True but for the noise, rad.
    velocity_increments : ndarray, shape (..., n, 3)
        True but for the noise, m/s.

    Raises
    ------
    ValueError
        If the sensitive axes of a triad lie in one plane, so that its errors cannot be taken out.

    Examples
    --------
    >>> from driftlab.motion.turntable import stand
    >>> record = stand([0, 0, 0, 1], latitude=0.7, interval=1.0, count=2)
    >>> angle, velocity = compensate(*measure(record, TYPICAL), TYPICAL, record.interval)
    >>> np.allclose(velocity, record.velocity_increments, rtol=0, atol=1e-12)
    True
    """
    unit = checked_unit(unit)
    for name in ("gyro_error", "accelerometer_error"):
        if (np.linalg.cond(np.eye(3) + getattr(unit, name)) > 1e12).any():
            raise ValueError(f"{name}: expected a triad E + K that spans space, got a flat one.")
    angle = finite_array(angle_increments, "angle_increments", 3)
    velocity = finite_array(velocity_increments, "velocity_increments", 3)
    return without_errors(angle, velocity, unit, finite_number(interval, "interval"))


def without_errors(
    angle: FloatArray, velocity: FloatArray, unit: Unit, interval: float
) -> tuple[FloatArray, FloatArray]:
    """Take known errors out of increments like `compensate`, without checking the arguments.

    Parameters
    ----------
    angle : ndarray, shape (..., n, 3)
        Measured angle increments, rad.
    velocity : ndarray, shape (..., n, 3)
        Measured velocity increments, m/s.
    unit : Unit
        Errors of the unit; their leading axes broadcast against those of the increments.
    interval : float
        Sample interval, s.

    Returns
    -------
    angle : ndarray, shape (..., n, 3)
        rad.
    velocity : ndarray, shape (..., n, 3)
        m/s.

    Examples
    --------
    >>> unit = PERFECT._replace(gyro_bias=np.array([0.0, 0.0, 1e-3]))
    >>> angle, _ = without_errors(np.ones((1, 3)), np.ones((1, 3)), unit, 10.0)
    >>> angle
    array([[1.  , 1.  , 0.99]])
    """
    return (
        _without_errors(angle, unit.gyro_bias, unit.gyro_error, interval),
        _without_errors(velocity, unit.accelerometer_bias, unit.accelerometer_error, interval),
    )


def _without_errors(
    measured: FloatArray, bias: FloatArray, error: FloatArray, interval: float
) -> FloatArray:
    inverse = np.linalg.inv(np.eye(3) + error)
    plain = measured - (interval * bias)[..., np.newaxis, :]
    return plain @ np.swapaxes(inverse, -1, -2)


def checked_unit(unit: Unit) -> Unit:
    """Return a unit as arrays with common leading axes, refusing wrong shapes and NaN by name.

    Parameters
    ----------
    unit : Unit
        Its fields may be anything that NumPy makes an array of.

    Returns
    -------
    Unit
        Float64 arrays, their leading axes broadcast to each other.

    Examples
    --------
    >>> checked_unit(PERFECT._replace(gyro_bias=np.zeros((5, 3)))).gyro_error.shape
    (5, 3, 3)
    """
    checked = finite_arrays(
        gyro_bias=(unit.gyro_bias, 3),
        gyro_error=(unit.gyro_error, 3, 3),
        accelerometer_bias=(unit.accelerometer_bias, 3),
        accelerometer_error=(unit.accelerometer_error, 3, 3),
    )
    return broadcast_unit(Unit(*checked))


def broadcast_unit(unit: Unit, *shape: int) -> Unit:
    """Return a unit with its leading axes broadcast to each other and to a given shape.

    Parameters
    ----------
    unit : Unit
        Float64 arrays.
    *shape : int
        Leading axes to broadcast to; none for the unit's own.

    Returns
    -------
    Unit
        Read-only views with common leading axes.

    Examples
    --------
    >>> broadcast_unit(PERFECT, 2).gyro_bias
    array([[0., 0., 0.],
           [0., 0., 0.]])
    """
    cores = (1, 2, 1, 2)
    own = (array.shape[: array.ndim - core] for array, core in zip(unit, cores, strict=True))
    lead = np.broadcast_shapes(shape, *own)
    return Unit(
        *(
            np.broadcast_to(array, lead + array.shape[array.ndim - core :])
            for array, core in zip(unit, cores, strict=True)
        )
    )


for _unit in (PERFECT, TYPICAL):
    for _array in _unit:
        _array.setflags(write=False)


def increment_rows(angle: ArrayLike, velocity: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return angle and velocity increments as arrays, refusing different numbers of them.

    Parameters
    ----------
    angle : array_like, shape (..., n, 3)
        Angle increments, rad.
    velocity : array_like, shape (..., n, 3)
        Velocity increments, m/s.

    Returns
    -------
    angle : ndarray, shape (..., n, 3)
        rad.
    velocity : ndarray, shape (..., n, 3)
        m/s.

    Raises
    ------
    ValueError
        If there is no axis of n intervals, or n is not the same in both.

    Examples
    --------
    >>> angle, velocity = increment_rows([[0, 0, 1]], [[0, 0, 9]])
    >>> velocity.shape
    (1, 3)
    >>> increment_rows(np.zeros((2, 3)), np.zeros((3, 3)))
    Traceback (most recent call last):
        ...
    ValueError: velocity_increments: expected as many as angle_increments, 2, got 3.
    """
    rows = []
    for name, value in (("angle_increments", angle), ("velocity_increments", velocity)):
        row = finite_array(value, name, 3)
        if row.ndim < 2:
            raise ValueError(f"{name}: expected shape (..., n, 3), got shape {row.shape}.")
        rows.append(row)
    if rows[0].shape[-2] != rows[1].shape[-2]:
        raise ValueError(
            "velocity_increments: expected as many as angle_increments, "
            f"{rows[0].shape[-2]}, got {rows[1].shape[-2]}."
        )
    return rows[0], rows[1]
