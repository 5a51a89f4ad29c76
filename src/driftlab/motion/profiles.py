"""Test motions whose attitude is known exactly, and the angle increments that gyros would report.

Each motion gives the attitude (..., 4), the body rate (..., 3) and the increments over equal
intervals. Neither the attitude nor the increments come from an integration of the other.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    keep,
    nonzero_vectors,
    positive_number,
    shown,
    whole_number,
)
from driftlab.core.coning import cone_increments
from driftlab.core.quaternion import from_rotation_vector, multiply


class Motion(ABC):
    """A test motion: exact attitude, body rate and angle increments."""

    def attitude(self, time: ArrayLike) -> FloatArray:
        """Exact attitude at times (...) in s: unit quaternions (..., 4), body to reference."""
        return self._attitude(finite_array(time, "time"))

    def rate(self, time: ArrayLike) -> FloatArray:
        """Exact angular rate (..., 3) in body axes, rad/s, at times (...) in s."""
        return self._rate(finite_array(time, "time"))

    def increments(self, interval: float, count: int) -> FloatArray:
        """Angle increments (n, 3) of ideal gyros, rad, over n intervals of so many s from time 0.

        They are integrals of the body rate. Of `Sway` an interval is at most a quarter of the
        period of the roll.
        """
        step = positive_number(interval, "interval")
        middle = step * (np.arange(whole_number(count, "count"), dtype=np.float64) + 0.5)
        return self._increments(middle, step)

    @abstractmethod
    def _attitude(self, time: FloatArray) -> FloatArray: ...

    @abstractmethod
    def _rate(self, time: FloatArray) -> FloatArray: ...

    @abstractmethod
    def _increments(self, middle: FloatArray, interval: float) -> FloatArray:
        """Increments (n, 3) over intervals around the times `middle` (n,)."""


@dataclass(frozen=True)
class Coning(Motion):
    """Coning motion: the third body axis moves round a cone, and the body returns every period.

    Attributes
    ----------
    half_angle : float
        Half the opening angle of the cone, rad, at most pi in absolute value.
    frequency : float
        Revolutions round the cone in a second, Hz.

    Examples
    --------
    The body is back after one period, and yet the third gyro has summed up the solid angle of the
    cone, 2 pi (1 - cos 0.1):

    >>> motion = Coning(half_angle=0.1, frequency=1.0)
    >>> np.allclose(motion.attitude(0.0), motion.attitude(1.0))
    True
    >>> print(f"{motion.increments(interval=0.01, count=100)[:, 2].sum():.6f}")
    -0.031390
    """

    half_angle: float
    frequency: float

    def __post_init__(self) -> None:
        _check(self)
        if abs(self.half_angle) > np.pi:
            raise ValueError(
                f"half_angle: expected at most pi rad, got {shown(self.half_angle)}: "
                "is it in degrees?"
            )

    def _attitude(self, time: FloatArray) -> FloatArray:
        phase = self._around * time
        around = np.cos(phase), np.sin(phase), np.zeros_like(phase)
        return from_rotation_vector(self.half_angle * np.stack(around, axis=-1))

    def _rate(self, time: FloatArray) -> FloatArray:
        phase = self._around * time
        across, along = self._around * np.sin(self.half_angle), np.full_like(phase, self._along)
        return np.stack([-across * np.sin(phase), across * np.cos(phase), along], axis=-1)

    def _increments(self, middle: FloatArray, interval: float) -> FloatArray:
        around = np.asarray(self._around * interval)
        return cone_increments(np.asarray(self.half_angle), around, self._around * middle)

    @property
    def _around(self) -> float:
        return 2 * np.pi * self.frequency

    @property
    def _along(self) -> float:
        return float(-2 * self._around * np.sin(self.half_angle / 2) ** 2)


@dataclass(frozen=True)
class Sway(Motion):
    """Heading, pitch and roll of a ship in a seaway: three sines without a common period.

    Attributes
    ----------
    amplitude : float
        Amplitude of the roll, rad, at most pi in absolute value. Those of pitch and heading are 0.6
        and 0.4 of it.
    frequency : float
        Frequency of the roll, Hz. Those of pitch and heading are about 0.75 and 0.57 of it.

    Examples
    --------
    >>> motion = Sway(amplitude=0.1, frequency=0.2)
    >>> motion.attitude(0.0)[1:].round(4)  # pitch 0.0505 and heading 0.0364, in halves
    array([0.0252, 0.0182, 0.9995])
    """

    amplitude: float
    frequency: float

    def __post_init__(self) -> None:
        _check(self)
        if abs(self.amplitude) > np.pi:
            raise ValueError(
                f"amplitude: expected at most pi rad, got {shown(self.amplitude)}: "
                "is it in degrees?"
            )

    def _attitude(self, time: FloatArray) -> FloatArray:
        # Heading about axis 3, then pitch about axis 2, then roll about axis 1.
        angles, _ = self._angles(time)
        about = [from_rotation_vector(angles[..., i, np.newaxis] * np.eye(3)[i]) for i in range(3)]
        return multiply(multiply(about[2], about[1]), about[0])

    def _rate(self, time: FloatArray) -> FloatArray:
        angles, rates = self._angles(time)
        roll, pitch = angles[..., 0], angles[..., 1]
        d_roll, d_pitch, d_heading = (rates[..., i] for i in range(3))
        level = d_heading * np.cos(pitch)
        return np.stack(
            [
                d_roll - d_heading * np.sin(pitch),
                d_pitch * np.cos(roll) + level * np.sin(roll),
                level * np.cos(roll) - d_pitch * np.sin(roll),
            ],
            axis=-1,
        )

    def _increments(self, middle: FloatArray, interval: float) -> FloatArray:
        if abs(self.frequency * interval) > 0.25:
            raise ValueError(
                f"interval: expected at most a quarter of the period, got {shown(interval)} s "
                f"at {self.frequency!r} Hz."
            )
        # The rate has no elementary integral; sixteen points leave an error of a rounding.
        nodes, weights = np.polynomial.legendre.leggauss(16)
        rates = self._rate(middle[:, np.newaxis] + 0.5 * interval * nodes)
        return 0.5 * interval * np.einsum("j,ijk->ik", weights, rates)

    def _angles(self, time: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Roll, pitch and heading (..., 3) and their derivatives."""
        rates = 2 * np.pi * self.frequency * np.array([1.0, 0.7548776662, 0.5698402910])
        phases = rates * time[..., np.newaxis] + np.array([0.0, 1.0, 2.0])
        amplitudes = self.amplitude * np.array([1.0, 0.6, 0.4])
        return amplitudes * np.sin(phases), amplitudes * rates * np.cos(phases)


@dataclass(frozen=True)
class FixedAxis(Motion):
    """Rotation about one fixed axis of the body: a constant rate and an oscillation.

    Attributes
    ----------
    amplitude : float
        Amplitude of the oscillation, rad; the body also turns by this angle in each second.
    frequency : float
        Frequency of the oscillation, Hz.
    axis : tuple of float
        Axis of the rotation in body axes; only its direction counts.

    Examples
    --------
    >>> motion = FixedAxis(amplitude=0.3, frequency=1.0, axis=(0.0, 0.0, 5.0))
    >>> motion.increments(interval=1.0, count=2).round(9)
    array([[0. , 0. , 0.3],
           [0. , 0. , 0.3]])
    """

    amplitude: float
    frequency: float
    axis: tuple[float, float, float] = (1.0, 2.0, 2.0)

    def __post_init__(self) -> None:
        _check(self)
        direction, _ = nonzero_vectors(self.axis, "axis")
        if direction.ndim != 1:
            raise ValueError(f"axis: expected shape (3,), got shape {direction.shape}.")
        # Plain numbers, so that a motion can be compared and be the key of a cache.
        keep(self, axis=tuple(finite_array(self.axis, "axis", 3).tolist()))

    def _attitude(self, time: FloatArray) -> FloatArray:
        angle = self.amplitude * (time + np.sin(2 * np.pi * self.frequency * time))
        return from_rotation_vector(angle[..., np.newaxis] * self._direction)

    def _rate(self, time: FloatArray) -> FloatArray:
        w = 2 * np.pi * self.frequency
        rate = self.amplitude * (1 + w * np.cos(w * time))
        return rate[..., np.newaxis] * self._direction

    def _increments(self, middle: FloatArray, interval: float) -> FloatArray:
        w = 2 * np.pi * self.frequency
        swing = 2 * np.cos(w * middle) * np.sin(w * interval / 2)
        angles: FloatArray = self.amplitude * (interval + swing)
        return angles[:, np.newaxis] * self._direction

    @property
    def _direction(self) -> FloatArray:
        return nonzero_vectors(self.axis, "axis")[0]


def _check(motion: Coning | Sway | FixedAxis) -> None:
    for field in fields(motion):
        if field.name != "axis":
            keep(motion, **{field.name: finite_number(getattr(motion, field.name), field.name)})
