"""Whole turns of a rate table on the turning Earth, and what ideal sensors on it deliver.

The axis of the table is fixed to the Earth, and the body turns about an axis of its own that lies
along it. Nothing else moves, so the integrals of angular rate and specific force need only those
of the cosine and the sine of one angle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    keep,
    nonnegative_number,
    nonzero_vectors,
    shown,
    table_rate,
    whole_number,
)
from driftlab.core.quaternion import rotate
from driftlab.earth import checked_latitude, earth_rate, gravity
from driftlab.increments import Increments

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(6)
"""Exact to rounding over an eighth of a turn."""


@dataclass(frozen=True)
class TurntableRotation:
    """How a table makes its whole turns: all of the motion but the axis in the body.

    Attributes
    ----------
    rate : float
        Rate of the table against the Earth between starting and stopping, rad/s. Its sign is the
        sense: positive is counter-clockwise, seen from the tip of `table_axis`.
    turns : int
        Whole turns k.
    latitude : float or None
        rad; not a pole. None for Larin's computer experiment: no Earth and no gravity.
    table_axis : tuple of float
        Direction of the table's axis in East, North, Up; only its direction counts.
    angle_error : float
        By how much the table goes beyond its whole turns, in the sense in which it turns, rad.
    ramp : float
        Time in which the table gathers its rate evenly, and in which it stops, s.
    dwell : float
        Time after stopping in which the gyros are still read, s.

    See Also
    --------
    driftlab.drift.recorded_turn_estimate : What its record shows.

    Examples
    --------
    A turn each way at 10 degrees a second, begun and ended in two seconds:

    >>> there = TurntableRotation(rate=np.radians(10.0), latitude=np.radians(37.5), ramp=2.0)
    >>> back = TurntableRotation(rate=-np.radians(10.0), latitude=np.radians(37.5), ramp=2.0)
    >>> print(f"{there.duration:.1f} {np.degrees(back.mean_rate):.3f}")
    38.0 -9.474
    >>> there.increments([0, 0, 1], samples=360).angle.shape, there.angle([19.0]).round(3)
    ((360, 3), array([3.142]))
    """

    rate: float
    turns: int = 1
    latitude: float | None = None
    table_axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    angle_error: float = 0.0
    ramp: float = 0.0
    dwell: float = 0.0

    def __post_init__(self) -> None:
        if self.latitude is not None:
            keep(self, latitude=float(checked_latitude(finite_number(self.latitude, "latitude"))))
        direction, _ = nonzero_vectors(self.table_axis, "table_axis")
        if direction.ndim != 1:
            raise ValueError(f"table_axis: expected shape (3,), got shape {direction.shape}.")
        keep(
            self,
            rate=table_rate(self.rate, "rate"),
            turns=whole_number(self.turns, "turns"),
            table_axis=tuple(finite_array(self.table_axis, "table_axis", 3).tolist()),
            angle_error=finite_number(self.angle_error, "angle_error"),
            **{name: nonnegative_number(getattr(self, name), name) for name in ("ramp", "dwell")},
        )
        if abs(self.angle_error) >= np.pi:
            raise ValueError(
                f"angle_error: expected less than half a turn, got {shown(self.angle_error)} rad."
            )
        if self.ramp > self._until_braking:
            raise ValueError(
                f"ramp: expected at most {self._until_braking:.6g} s, in which the turns at the "
                f"full rate are made, got {shown(self.ramp)}."
            )

    @property
    def _until_braking(self) -> float:
        return (2 * np.pi * self.turns + self.angle_error) / abs(self.rate)

    @property
    def duration(self) -> float:
        """Time from the start to the end of the record, s."""
        return self._until_braking + self.ramp + self.dwell

    @property
    def mean_rate(self) -> float:
        """Whole turns over the whole time, rad/s, with the sign of the sense.

        It is the rate that counts for the Earth and a gyro bias, which add up over the whole time.
        """
        return float(np.copysign(2 * np.pi * self.turns / self.duration, self.rate))

    def angle(self, times: ArrayLike) -> FloatArray:
        """Angle (...) by which the table has turned against the Earth at times (...), s; rad."""
        since = finite_array(times, "times")
        return self.rate * (self._gathered(since) - self._gathered(since - self._until_braking))

    def _gathered(self, since: FloatArray) -> FloatArray:
        """Integral of a rate that grows evenly from 0 to 1 in the time of the ramp, and stays."""
        if not self.ramp:
            return np.maximum(since, 0.0)
        growing = np.clip(since, 0.0, self.ramp)
        return growing**2 / (2 * self.ramp) + np.maximum(since - self.ramp, 0.0)

    def increments(self, axis: ArrayLike, samples: int) -> Increments:
        """Return increments (..., n, 3) of ideal sensors over n equal intervals, exact to rounding.

        The body axis (..., 3) lies along the table's axis; the shorter rotation from the one to the
        other says how the sides of the body point at the start. A turn has at least eight samples.
        """
        n, _ = nonzero_vectors(axis, "axis")
        count = whole_number(samples, "samples", least=8 * self.turns)
        times = np.linspace(0.0, self.duration, count + 1)
        seconds = self.duration / count
        cosine, sine = self._mean_cosine_and_sine(times)
        turned = np.diff(self.angle(times))[:, np.newaxis] * n[..., np.newaxis, :]
        pushed = np.zeros_like(turned)
        if self.latitude is not None:
            up = np.array([0.0, 0.0, float(gravity(self.latitude))])
            for total, fixed in ((turned, earth_rate(self.latitude)), (pushed, up)):
                # What is fixed to the Earth goes round the axis backwards, seen from the body.
                start = self.components_at_start(fixed, n)
                along = np.einsum("...i,...i->...", n, start)[..., np.newaxis] * n
                total += seconds * (
                    along[..., np.newaxis, :]
                    + cosine[:, np.newaxis] * (start - along)[..., np.newaxis, :]
                    - sine[:, np.newaxis] * np.cross(n, start)[..., np.newaxis, :]
                )
        return Increments(seconds, turned, pushed)

    def _mean_cosine_and_sine(self, times: FloatArray) -> FloatArray:
        """Means (2, n) of the cosine and the sine of the angle over the intervals."""
        # Cut where the rate has a kink, or a quadrature would see it.
        kinks = self._until_braking * np.array([[0.0], [1.0]]) + np.array([0.0, self.ramp])
        edges = np.union1d(times, kinks[(kinks > times[0]) & (kinks < times[-1])])
        # And so that no piece turns by more than an eighth, however long a sample is.
        widths = np.diff(edges)
        parts = np.ceil(np.abs(self.rate) * widths / (np.pi / 4)).clip(1).astype(int)
        within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
        edges = np.append(
            np.repeat(edges[:-1], parts) + within * np.repeat(widths / parts, parts), edges[-1]
        )
        half = 0.5 * np.diff(edges)[:, np.newaxis]
        angles = self.angle(edges[:-1, np.newaxis] + half * (1 + _NODES))
        pieces = np.stack([np.cos(angles), np.sin(angles)]) * half @ _WEIGHTS
        sums = np.add.reduceat(pieces, np.searchsorted(edges, times[:-1]), axis=-1)
        return np.asarray(sums / np.diff(times))

    def components_at_start(self, fixed: ArrayLike, axis: ArrayLike) -> FloatArray:
        """Components (..., 3) in body axes, at the start, of a vector (3,) in East, North, Up."""
        fixed = finite_array(fixed, "fixed", 3)
        n, _ = nonzero_vectors(axis, "axis")
        a, _ = nonzero_vectors(self.table_axis, "table_axis")
        # From a to n by the shorter way; upside down, half a turn about any axis across.
        to_body = np.concatenate([np.cross(a, n), 1 + (n @ a)[..., np.newaxis]], axis=-1)
        across = np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
        opposite = np.abs(to_body).max(axis=-1, keepdims=True) < 1e-9
        to_body = np.where(opposite, np.append(across, 0.0), to_body)
        return rotate(to_body / np.linalg.norm(to_body, axis=-1, keepdims=True), fixed)
