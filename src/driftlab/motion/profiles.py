"""Test motions whose attitude is known exactly, and the angle increments that gyros would report.

Each motion gives the attitude (..., 4), the body rate (..., 3) and the increments over equal
intervals. Neither the attitude nor the increments come from an integration of the other.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    nonzero_vectors,
    whole_number,
)
from driftlab.core.quaternion import from_rotation_vector, multiply


class Motion(Protocol):
    """What a motion can say."""

    def attitude(self, time: ArrayLike) -> FloatArray:
        """Exact attitude (..., 4) at times (...) in s."""

    def rate(self, time: ArrayLike) -> FloatArray:
        """Angular rate in body axes (..., 3), rad/s, at times (...) in s."""

    def increments(self, interval: float, count: int) -> FloatArray:
        """Integrals (count, 3) of the body rate, rad, over intervals in s from time 0 on."""


@dataclass(frozen=True)
class Coning:
    """The third body axis runs round a cone, without turning about itself on the whole.

    Attributes
    ----------
    half_angle : float
        Half the opening angle of the cone, rad.
    frequency : float
        Turns round the cone in a second, Hz.
    """

    half_angle: float
    frequency: float

    def __post_init__(self) -> None:
        _check(self)
        if abs(self.half_angle) > np.pi:
            raise ValueError(f"half_angle: expected at most pi rad, got {self.half_angle!r}.")

    def attitude(self, time: ArrayLike) -> FloatArray:
        """Exact attitude (..., 4) at times (...) in s."""
        phase = self._rate * finite_array(time, "time")
        tilt = self.half_angle * np.stack(
            [np.cos(phase), np.sin(phase), np.zeros_like(phase)], axis=-1
        )
        return from_rotation_vector(tilt)

    def rate(self, time: ArrayLike) -> FloatArray:
        """Angular rate in body axes (..., 3), rad/s, at times (...) in s."""
        phase = self._rate * finite_array(time, "time")
        across = self._rate * np.sin(self.half_angle)
        along = np.full_like(phase, self._along)
        return np.stack([-across * np.sin(phase), across * np.cos(phase), along], axis=-1)

    def increments(self, interval: float, count: int) -> FloatArray:
        """Integrals (count, 3) of the body rate, rad, over intervals in s from time 0 on."""
        middle = _middles(interval, count)
        # Differences of cosines and sines as products, which lose no digits.
        chord = 2 * np.sin(self.half_angle) * np.sin(self._rate * interval / 2)
        return np.stack(
            [
                -chord * np.sin(self._rate * middle),
                chord * np.cos(self._rate * middle),
                np.full_like(middle, self._along * interval),
            ],
            axis=-1,
        )

    @property
    def _rate(self) -> float:
        return 2 * np.pi * self.frequency

    @property
    def _along(self) -> float:
        return float(-2 * self._rate * np.sin(self.half_angle / 2) ** 2)


@dataclass(frozen=True)
class Sway:
    """Heading, pitch and roll of a ship in a seaway: three sines without a common period.

    Attributes
    ----------
    amplitude : float
        Amplitude of the roll in rad, at most pi; pitch and heading sway by parts of it.
    frequency : float
        Frequency of the roll in Hz; pitch and heading have others.
    """

    amplitude: float
    frequency: float

    def __post_init__(self) -> None:
        _check(self)
        if abs(self.amplitude) > np.pi:
            raise ValueError(f"amplitude: expected at most pi rad, got {self.amplitude!r}.")

    def attitude(self, time: ArrayLike) -> FloatArray:
        """Exact attitude (..., 4) at times (...) in s."""
        angles, _ = self._angles(finite_array(time, "time"))
        about = [from_rotation_vector(angles[..., i, np.newaxis] * np.eye(3)[i]) for i in range(3)]
        return multiply(multiply(about[2], about[1]), about[0])

    def rate(self, time: ArrayLike) -> FloatArray:
        """Angular rate in body axes (..., 3), rad/s, at times (...) in s."""
        angles, rates = self._angles(finite_array(time, "time"))
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

    def increments(self, interval: float, count: int) -> FloatArray:
        """Integrals (count, 3) of the body rate, rad, over intervals in s from time 0 on.

        The rate has no elementary integral. Sixteen points of Gauss and Legendre in each interval
        leave an error of the size of rounding for intervals up to a quarter of the period.
        """
        middle = _middles(interval, count)
        if abs(self.frequency * interval) > 0.25:
            raise ValueError(
                f"interval: expected at most a quarter of the period, got {interval!r} s "
                f"at {self.frequency!r} Hz."
            )
        nodes, weights = np.polynomial.legendre.leggauss(16)
        rates = self.rate(middle[:, np.newaxis] + 0.5 * interval * nodes)
        return 0.5 * interval * np.einsum("j,ijk->ik", weights, rates)

    def _angles(self, time: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Roll, pitch and heading (..., 3) and their derivatives."""
        rates = 2 * np.pi * self.frequency * np.array([1.0, 0.7548776662, 0.5698402910])
        phases = rates * time[..., np.newaxis] + np.array([0.0, 1.0, 2.0])
        amplitudes = self.amplitude * np.array([1.0, 0.6, 0.4])
        return amplitudes * np.sin(phases), amplitudes * rates * np.cos(phases)


@dataclass(frozen=True)
class FixedAxis:
    """Turning and swinging about one axis of the body.

    Attributes
    ----------
    amplitude : float
        Amplitude of the swing, rad; the body turns on by as much in each second besides.
    frequency : float
        Frequency of the swing, Hz.
    axis : tuple of float
        Only its direction counts.
    """

    amplitude: float
    frequency: float
    axis: tuple[float, float, float] = (1.0, 2.0, 2.0)

    def __post_init__(self) -> None:
        _check(self)

    def attitude(self, time: ArrayLike) -> FloatArray:
        """Exact attitude (..., 4) at times (...) in s."""
        time = finite_array(time, "time")
        angle = self.amplitude * (time + np.sin(2 * np.pi * self.frequency * time))
        return from_rotation_vector(angle[..., np.newaxis] * self._direction)

    def rate(self, time: ArrayLike) -> FloatArray:
        """Angular rate in body axes (..., 3), rad/s, at times (...) in s."""
        w = 2 * np.pi * self.frequency
        rate = self.amplitude * (1 + w * np.cos(w * finite_array(time, "time")))
        return rate[..., np.newaxis] * self._direction

    def increments(self, interval: float, count: int) -> FloatArray:
        """Integrals (count, 3) of the body rate, rad, over intervals in s from time 0 on."""
        middle, w = _middles(interval, count), 2 * np.pi * self.frequency
        swing = 2 * np.cos(w * middle) * np.sin(w * interval / 2)
        angles: FloatArray = self.amplitude * (interval + swing)
        return angles[:, np.newaxis] * self._direction

    @property
    def _direction(self) -> FloatArray:
        direction, _ = nonzero_vectors(self.axis, "axis")
        return direction


def _check(motion: Coning | Sway | FixedAxis) -> None:
    for field in fields(motion):
        if field.name != "axis":
            finite_number(getattr(motion, field.name), field.name)
        else:
            direction, _ = nonzero_vectors(getattr(motion, field.name), field.name)
            if direction.ndim != 1:
                raise ValueError(f"axis: expected shape (3,), got shape {direction.shape}.")


def _middles(interval: float, count: int) -> FloatArray:
    """Middle (count,) of each interval, in s."""
    step = finite_number(interval, "interval")
    if step <= 0:
        raise ValueError(f"interval: expected a positive time, got {interval!r}.")
    return step * (np.arange(whole_number(count, "count"), dtype=np.float64) + 0.5)
