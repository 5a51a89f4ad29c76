"""What the columns of a log mean: described once, checked once, for whichever reader takes it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from driftlab.checks import (
    checked_instance,
    checked_text,
    finite_array,
    keep,
    positive_number,
    shown,
    some_of,
)

from ._units import accelerometer_unit, gyro_unit, time_unit
from .guards import RULES
from .recording import _keep_known

Columns = Sequence[str | int]
Time = str | int | tuple[str | int, str]


@dataclass(frozen=True)
class Layout:
    """What the columns of a log mean, and what is known of the unit that wrote it.

    The readers take these fields as keywords, or one `Layout` for many logs of a kind.

    Attributes
    ----------
    gyro, accelerometer : sequence of str or int
        Three columns each, in the order of the axes: names from the header, without units, or
        numbers counted from 1. A minus before either, as in "-gyr_y", changes the sign.
    units : str or sequence of str, optional
        Of the gyros and the accelerometers, ("deg/s", "g") say, or of the gyros alone; if not
        given, the header must tell them, in brackets. Rates are in deg/s, mdeg/s, deg/h, rad/s,
        mrad/s, with m/s^2, g, mg; increments in deg, rad, mrad, urad, arcsec, with m/s, mm/s, g*s,
        mg*s, ug*s; "g" is 9.80665 m/s^2. The size of one count may stand before: "1/131 deg/s".
    zeros : sequence of float
        Counts that stand for zero, of the gyros and of the accelerometers: 32768, say.
    time : str, int or tuple, optional
        Column of time stamps; with its unit (s, ms, us, ns), as ("t", "ms"), if the header does
        not tell it; the unit "iso" stands for dates and times such as 2024-05-01T12:00:00.25.
    interval, rate : float, optional
        Between samples, s, or samples per second. Give one of time, interval, rate.
    longest_gap : float
        Longest step of the time stamps that is accepted, in usual steps; any if "gap" is allowed.
        Integrals of the rates bridge it by a spline.
    axes : str
        Body axes, as in `driftlab.axes`.
    latitude, gravity : float, optional
        Of the place, rad and m/s^2.
    name, source, licence : str
        As in `Recording`; the name is the file's if none is given.
    allow : sequence of str
        Names of `RULES` that this log may break.

    Examples
    --------
    >>> mine = Layout(gyro=("wx", "-wy", "wz"), units="deg/s", rate=100, latitude=0.6, gravity=9.8)
    >>> mine.units, mine.rate  # dl.recordings.read_csv("log.csv", mine), and so for other logs
    (('deg/s',), 100.0)
    """

    gyro: Columns
    accelerometer: Columns | None = None
    units: str | Sequence[str] | None = None
    zeros: Sequence[float] = (0.0, 0.0)
    time: Time | None = None
    interval: float | None = None
    rate: float | None = None
    longest_gap: float = 1.5
    axes: str = ""
    latitude: float | None = None
    gravity: float | None = None
    name: str = ""
    source: str = ""
    licence: str = ""
    allow: Sequence[str] = ()

    def __post_init__(self) -> None:
        for triad in ("gyro", "accelerometer"):
            wanted = getattr(self, triad)
            if triad == "accelerometer" and wanted is None:
                continue
            if not isinstance(wanted, tuple | list) or len(wanted) != 3:
                raise ValueError(f"{triad}: expected three columns, got {shown(wanted)}.")
            keep(self, **{triad: tuple(wanted)})
        if self.units is not None:
            several = self.units if isinstance(self.units, tuple | list) else [self.units]
            units = tuple(checked_text(unit, "units") for unit in several)
            if len(units) != len(self.triads):
                raise ValueError(
                    f"units: expected one for each of {', '.join(self.triads)}, "
                    f"got {shown(self.units)}."
                )
            for meaning, unit in zip((gyro_unit, accelerometer_unit), units, strict=False):
                meaning(unit)
            keep(self, units=units)
        zeros = finite_array(self.zeros, "zeros", 2)
        if zeros.ndim > 1:
            raise ValueError(f"zeros: expected shape (2,), got shape {zeros.shape}.")
        if sum(value is not None for value in (self.time, self.interval, self.rate)) > 1:
            raise self.not_one_clock()
        if self.time is not None:
            column, unit = self.stamps
            if not isinstance(column, str | int) or not isinstance(unit, str):
                raise ValueError(
                    "time: expected the name or number of a column, or it and its unit, got "
                    f"{shown(self.time)}."
                )
            if unit not in ("", "iso"):
                time_unit(unit)
        for field in ("interval", "rate"):
            if (value := getattr(self, field)) is not None:
                keep(self, **{field: positive_number(value, field)})
        keep(self, zeros=tuple(zeros.tolist()), allow=some_of(self.allow, RULES, "allow"))
        _keep_known(self)

    @property
    def triads(self) -> dict[str, Columns]:
        """The columns of each triad that the log has, by its name."""
        triads = {"gyro": self.gyro}
        return (
            triads if self.accelerometer is None else triads | {"accelerometer": self.accelerometer}
        )

    @property
    def stamps(self) -> tuple[Any, Any]:
        """Column of the time stamps, and their unit; "" if the header must tell it."""
        return self.time if type(self.time) is tuple and len(self.time) == 2 else (self.time, "")

    def not_one_clock(self) -> ValueError:
        """The refusal of a log with no time, or with more than one."""
        return ValueError(
            "time, interval, rate: expected one of them, got "
            f"{shown(self.time)}, {shown(self.interval)} and {shown(self.rate)}."
        )


def checked_layout(layout: Layout | None, fields: dict[str, Any], **usual: Any) -> Layout:
    """Return the layout that a reader was given, with fields changed, or that of its fields."""
    if layout is None:
        return Layout(**usual | fields)
    return replace(checked_instance(layout, Layout, "layout"), **fields)
