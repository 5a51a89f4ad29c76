"""What the log of an inertial unit holds: rates or increments in SI units, and what is known of it.

A record that forgets its units and axes is soon read wrongly, so they stay with the numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from driftlab.axes import checked_axes, convert_vectors
from driftlab.checks import (
    FloatArray,
    checked_text,
    finite_array,
    finite_number,
    keep,
    one_of,
    one_pull,
    positive_number,
    row_number,
    shown,
)
from driftlab.increments import Increments
from driftlab.sampled_rates import increments_from_rates

from ._time_stamps import checked_longest_gap

Kind = Literal["rates", "increments"]


@dataclass(frozen=True, eq=False)
class Recording:
    """Samples of a gyro triad, and of an accelerometer triad if there is one.

    Attributes
    ----------
    gyro : ndarray, shape (n, 3)
        Of "rates" the angular rate at each moment, rad/s; of "increments" the angle over each
        interval, rad.
    accelerometer : ndarray, shape (n, 3), or None
        Specific force, m/s^2, or its increments, m/s; None if the log has none.
    interval : float
        Between samples, s; the usual one where stamps differ a little.
    kind : {"rates", "increments"}
        Of both triads.
    times : ndarray, shape (n,), or None
        Stamps of the samples, s; None if they are equally spaced.
    axes : str
        Body axes as in `driftlab.axes`, "FRD" say; empty if nobody said.
    latitude : float or None
        Of the place, rad.
    gravity : float or None
        Of the place, m/s^2.
    name, source, licence : str
        What it is called, who published it and where, under which licence.
    longest_gap : float
        Longest step of `times` that integrals may bridge, in usual steps; more than 1.

    Examples
    --------
    Two seconds of a unit that lies still, at 100 Hz:

    >>> force = np.tile([0.0, 0.0, -9.8], (200, 1))
    >>> still = Recording(np.zeros((200, 3)), force, 0.01, "rates", axes="FRD")
    >>> still.duration, still.increments().velocity.shape
    (2.0, (199, 3))
    >>> len(still.between(0.5, 1.5)), still.part(10, 15).in_axes("FUR").accelerometer[0]
    (100, array([0. , 9.8, 0. ]))
    """

    gyro: FloatArray
    accelerometer: FloatArray | None
    interval: float
    kind: Kind
    times: FloatArray | None = None
    axes: str = ""
    latitude: float | None = None
    gravity: float | None = None
    name: str = ""
    source: str = ""
    licence: str = ""
    longest_gap: float = 1.5

    def __post_init__(self) -> None:
        one_of(self.kind, ("rates", "increments"), "kind")
        _keep_known(self)
        gyro = _rows(self.gyro, "gyro")
        keep(self, gyro=gyro, interval=positive_number(self.interval, "interval"))
        if self.accelerometer is not None:
            rows = _rows(self.accelerometer, "accelerometer")
            if len(rows) != len(gyro):
                raise ValueError(
                    f"accelerometer: expected as many rows as the gyros have, {len(gyro)}, "
                    f"got {len(rows)}."
                )
            keep(self, accelerometer=rows)
        if self.times is not None:
            times = finite_array(self.times, "times", len(gyro))
            if not (np.diff(times) > 0).all():
                row = int(np.argmin(np.diff(times))) + 1
                raise ValueError(
                    f"times: expected stamps that increase, got {times[row]:.10g} s after "
                    f"{times[row - 1]:.10g} s in row {row + 1}."
                )
            keep(self, times=times)

    def __len__(self) -> int:
        return len(self.gyro)

    @property
    def duration(self) -> float:
        """Time that the samples stand for, s."""
        if self.times is None:
            return len(self) * self.interval
        return float(self.times[-1] - self.times[0]) + self.interval

    def part(self, begin: int, end: int) -> Recording:
        """Return the rows from `begin` to before `end`, as views, with all that is known."""
        rows = slice(row_number(begin, "begin"), row_number(end, "end"))
        if not len(self.gyro[rows]):
            raise ValueError(
                f"begin, end: expected some of the {len(self)} rows, "
                f"got {shown(begin)} and {shown(end)}."
            )
        return replace(
            self,
            gyro=self.gyro[rows],
            accelerometer=None if self.accelerometer is None else self.accelerometer[rows],
            times=None if self.times is None else self.times[rows],
        )

    def between(self, begin: float, end: float) -> Recording:
        """Return the samples from `begin` to before `end`, s since the first, as views."""
        first, last = finite_number(begin, "begin"), finite_number(end, "end")
        if self.times is None:
            places = np.ceil(np.array([first, last]) / self.interval - 1e-6)
            rows = np.clip(places, 0, len(self)).astype(int)  # others fit in no whole number
        else:
            rows = np.searchsorted(self.times - self.times[0], [first, last])
        start, stop = np.clip(rows, 0, len(self))
        if start >= stop:
            raise ValueError(
                f"begin, end: expected times of the record, which has {self.duration:g} s, "
                f"with a sample between them, got {shown(begin)} and {shown(end)}."
            )
        return self.part(int(start), int(stop))

    def in_axes(self, axes: str) -> Recording:
        """Return the same record in other body axes, three letters as in `driftlab.axes`."""
        if not self.axes:
            raise ValueError("axes: expected a record that knows its axes, got one that does not.")
        force, axes = self.accelerometer, checked_axes(axes, "axes", "body")
        return replace(
            self,
            gyro=convert_vectors(self.gyro, self.axes, axes),
            accelerometer=None if force is None else convert_vectors(force, self.axes, axes),
            axes=axes,
        )

    def angles(self) -> FloatArray:
        """Increments of angle (m, 3), rad: the record's, or of a spline through n = m + 1 rates."""
        return self._integrals(self.gyro)

    def increments(self) -> Increments:
        """Increments of angle, rad, and of velocity, m/s, (m, 3) as in `angles`."""
        if self.accelerometer is None:
            raise ValueError("accelerometer: expected a record that has one, got none.")
        return Increments(self.interval, self.angles(), self._integrals(self.accelerometer))

    def _integrals(self, rows: FloatArray) -> FloatArray:
        if self.kind == "increments":
            return rows
        return increments_from_rates(
            rows, self.interval, times=self.times, degree=3, longest_gap=self.longest_gap
        )


def _keep_known(record: Any) -> None:
    """Check what a recording and the layout of a log both say of the unit, and keep it."""
    for field in ("axes", "name", "source", "licence"):
        checked_text(getattr(record, field), field)
    keep(record, longest_gap=checked_longest_gap(record.longest_gap))
    if record.axes:
        checked_axes(record.axes, "axes", "body")
    if record.latitude is not None:
        keep(record, latitude=finite_number(record.latitude, "latitude"))
        if abs(record.latitude) > np.pi / 2:
            raise ValueError(
                f"latitude: expected rad, at most a quarter turn, got {shown(record.latitude)}."
            )
    if record.gravity is not None:
        keep(record, gravity=one_pull(record.gravity))


def _rows(value: object, name: str) -> FloatArray:
    """Rows (n, 3) of a triad, at least one; not copied, but nobody changes them here."""
    rows = finite_array(value, name, 3)  # type: ignore[arg-type]
    if rows.ndim != 2:
        raise ValueError(f"{name}: expected shape (n, 3), got shape {rows.shape}.")
    rows = rows.view()
    rows.flags.writeable = False
    return rows
