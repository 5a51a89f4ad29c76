"""What a real inertial unit says: its errors, its noise, and how known errors are taken out again.

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
    """The errors of an inertial unit: 24 numbers, or arrays of them with leading axes.

    Attributes
    ----------
    gyro_bias : ndarray, shape (..., 3)
        rad/s.
    gyro_error : ndarray, shape (..., 3, 3)
        K of the gyro triad, without unit.
    accelerometer_bias : ndarray, shape (..., 3)
        m/s^2.
    accelerometer_error : ndarray, shape (..., 3, 3)
        L of the accelerometer triad.
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
    """White noise of the sensors and of what the filter compares them with; zero for none.

    Attributes
    ----------
    angle_random_walk : float
        rad/sqrt(s), each gyro.
    velocity_random_walk : float
        (m/s)/sqrt(s), each accelerometer.
    velocity : float
        Standard deviation of each component of the reference velocity, m/s: the table is not quite
        at rest. Independent from one update of the filter to the next.
    """

    angle_random_walk: float = 0.005 * degree / float(np.sqrt(hour))
    velocity_random_walk: float = 5 * micro * g
    velocity: float = 0.01

    def __post_init__(self) -> None:
        _check_sizes(self)


@dataclass(frozen=True)
class Spread:
    """Standard deviations of what is not known before a calibration; zero for what is known.

    The velocity is known: the table stands.

    Attributes
    ----------
    attitude : float
        Of the attitude at the start, rad, about each axis: how well the table is set up.
    gyro_bias : float
        rad/s, each gyro.
    accelerometer_bias : float
        m/s^2, each accelerometer.
    scale : float
        Diagonal entries of both error matrices.
    installation : float
        Their off-diagonal entries, rad, each on its own.
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
    """Units with normally distributed errors, independent of each other; leading axes `shape`."""
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
    """Angle and velocity increments, each (..., n, 3), as a unit reports them; Wu (1)-(5).

    Parameters
    ----------
    record : Record
        True increments.
    unit : Unit
        Its leading axes (...) are those of the result.
    noise : Noise, optional
        None for a unit without noise.
    rng : numpy.random.Generator, optional
        Needed for noise.
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
    """True increments, each (..., n, 3), from measured ones and the errors of the unit (...).

    Raises
    ------
    ValueError
        If an error matrix leaves a triad flat, so that nothing can be taken out.
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
    """`compensate` for those who have checked their arguments already."""
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
    """Return the unit as arrays with common leading axes, refusing wrong shapes and NaN by name."""
    checked = finite_arrays(
        gyro_bias=(unit.gyro_bias, 3),
        gyro_error=(unit.gyro_error, 3, 3),
        accelerometer_bias=(unit.accelerometer_bias, 3),
        accelerometer_error=(unit.accelerometer_error, 3, 3),
    )
    return broadcast_unit(Unit(*checked))


def broadcast_unit(unit: Unit, *shape: int) -> Unit:
    """Return the unit with leading axes that are broadcast to each other, and to `shape`."""
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
    """Return angle and velocity increments (..., n, 3) as arrays, refusing unlike numbers."""
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
