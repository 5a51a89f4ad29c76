"""What the log of an inertial unit holds: rates or increments in SI units, and what is known of it.

A log tells neither its units nor its axes, so a record that forgets them is soon read wrongly. Here
the readers ask once, and what they were told stays with the numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

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

    >>> still = Recording(np.zeros((200, 3)), np.tile([0.0, 0.0, 9.8], (200, 1)), 0.01, "rates")
    >>> still.duration, still.increments().velocity.shape
    (2.0, (199, 3))
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
        for field in ("axes", "name", "source", "licence"):
            checked_text(getattr(self, field), field)
        keep(
            self,
            interval=positive_number(self.interval, "interval"),
            longest_gap=checked_longest_gap(self.longest_gap),
        )
        gyro = _rows(self.gyro, "gyro")
        keep(self, gyro=gyro)
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
        if self.axes:
            checked_axes(self.axes, "axes", "body")
        if self.latitude is not None:
            keep(self, latitude=finite_number(self.latitude, "latitude"))
            if abs(self.latitude) > np.pi / 2:
                raise ValueError(
                    f"latitude: expected rad, at most a quarter turn, got {shown(self.latitude)}."
                )
        if self.gravity is not None:
            keep(self, gravity=one_pull(self.gravity))

    def __len__(self) -> int:
        return len(self.gyro)

    @property
    def duration(self) -> float:
        """Time that the samples stand for, s.

        Examples
        --------
        >>> Recording(np.zeros((30, 3)), None, 0.1, "increments").duration
        3.0
        """
        if self.times is None:
            return len(self) * self.interval
        return float(self.times[-1] - self.times[0]) + self.interval

    def part(self, begin: int, end: int) -> Recording:
        """Return some of the rows.

        Parameters
        ----------
        begin, end : int
            The first row, and the first that is left out, as in a slice.

        Returns
        -------
        Recording
            All that is known of the whole, with views of the rows.

        Examples
        --------
        >>> len(Recording(np.zeros((30, 3)), None, 0.1, "increments").part(10, 15))
        5
        """
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
        """Return the rows of some time.

        Parameters
        ----------
        begin, end : float
            Since the first sample, s; a sample at `end` is left out.

        Returns
        -------
        Recording
            All that is known of the whole, with views of the rows.

        Raises
        ------
        ValueError
            If there is no sample in that time.

        Examples
        --------
        >>> len(Recording(np.zeros((30, 3)), None, 0.1, "increments").between(0.5, 1.5))
        10
        """
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
        """Return the same record in other body axes.

        Parameters
        ----------
        axes : str
            Three letters as in `driftlab.axes`, "FUR" say.

        Returns
        -------
        Recording
            With the columns in the new order, and signs changed where they must be.

        Raises
        ------
        ValueError
            If nobody said which axes the record has, or `axes` are none.

        Examples
        --------
        >>> log = Recording([[0, 0, 0]], [[0.0, 0.0, -9.8]], 0.1, "rates", axes="FRD")
        >>> log.in_axes("FUR").accelerometer
        array([[0. , 9.8, 0. ]])
        """
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
        """Increments of angle: those of the record, or integrals of its rates.

        Returns
        -------
        ndarray, shape (m, 3)
            rad. Rates become m = n - 1 increments, integrals of a cubic spline, which adds least
            to their noise: see `driftlab.sampled_rates.increments_from_rates`.

        Examples
        --------
        >>> Recording(np.ones((11, 3)), None, 0.1, "rates").angles().sum(axis=0).round(9)
        array([1., 1., 1.])
        """
        return self._integrals(self.gyro)

    def increments(self) -> Increments:
        """Increments of angle and velocity: those of the record, or integrals of its rates.

        On a turntable they are what `driftlab.calibration.calibrate` takes: chapter 08.

        Returns
        -------
        Increments
            Arrays (m, 3), rad and m/s, as in `angles`.

        Raises
        ------
        ValueError
            If the record has no accelerometers.

        Examples
        --------
        >>> log = Recording(np.zeros((11, 3)), np.full((11, 3), 2.0), 0.1, "rates")
        >>> log.increments().velocity.sum(axis=0).round(9)
        array([2., 2., 2.])
        """
        if self.accelerometer is None:
            raise ValueError("accelerometer: expected a record that has one, got none.")
        return Increments(self.interval, self.angles(), self._integrals(self.accelerometer))

    def _integrals(self, rows: FloatArray) -> FloatArray:
        if self.kind == "increments":
            return rows
        return increments_from_rates(
            rows, self.interval, times=self.times, degree=3, longest_gap=self.longest_gap
        )


def _rows(value: object, name: str) -> FloatArray:
    """Rows (n, 3) of a triad, at least one; not copied, but nobody changes them here."""
    rows = finite_array(value, name, 3)  # type: ignore[arg-type]
    if rows.ndim != 2:
        raise ValueError(f"{name}: expected shape (n, 3), got shape {rows.shape}.")
    rows = rows.view()
    rows.flags.writeable = False
    return rows
