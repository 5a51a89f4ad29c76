"""What a command has found: numbers in fitting units, tables, plots, and sentences about them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro, milli

from driftlab.checks import FloatArray

AXES = ("x", "y", "z")
Step = Callable[[str], None]
"""Tells that a step of this name begins."""


class Unit(NamedTuple):
    """A unit for the eye, and its size in SI."""

    name: str
    size: float

    def text(self, value: float, deviation: float | None = None, digits: int = 5) -> str:
        """A number in SI units as `written` in this one."""
        spread = None if deviation is None else deviation / self.size
        return written(value / self.size, spread, digits)

    def pair(self, value: float, deviation: float) -> str:
        """A number and its deviation."""
        return f"{self.text(value, deviation)} ± {self.text(deviation, deviation)}"


DEGREES = Unit("deg", degree)
DEG_PER_HOUR = Unit("deg/h", degree / hour)
RATES = (Unit("deg/s", degree), DEG_PER_HOUR)
FORCES = (Unit("mg", milli * g), Unit("micro-g", micro * g))
SCALES = (Unit("%", 0.01), Unit("ppm", micro))
SMALL_ANGLES = (Unit("arcmin", arcminute), Unit("arcsec", arcsecond))


def fitting(values: ArrayLike, units: tuple[Unit, ...]) -> Unit:
    """The largest unit in which the largest value is at least 0.1; otherwise the smallest."""
    largest = float(np.nanmax(np.abs(np.asarray(values, float)), initial=0.0))
    return next((unit for unit in units if largest >= 0.1 * unit.size), units[-1])


def written(value: float, deviation: float | None = None, digits: int = 5) -> str:
    """A number with the decimals that its deviation leaves it: two digits of that.

    Without a deviation, or one that is zero or not known, it gets `digits` significant digits.
    """
    if not np.isfinite(value):
        return "-"
    if deviation is None or not np.isfinite(deviation) or deviation <= 0:
        size, digits_known = abs(value), digits
    else:
        size, digits_known = deviation, 2
    if size == 0:
        return "0"
    decimals = digits_known - 1 - int(np.floor(np.log10(size)))
    # A deviation of 0.0996 is written 0.10, which is one decimal fewer.
    if deviation is not None and round(size, decimals) >= 10.0 ** (digits_known - decimals):
        decimals -= 1
    if decimals > 9:
        return f"{value:.{digits_known - 1}e}"
    text = f"{round(value, decimals):.{max(decimals, 0)}f}"
    return text.lstrip("-") if float(text) == 0 else text


@dataclass(frozen=True)
class Table:
    """Rows of words under a head; `note` is a sentence below."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""


@dataclass(frozen=True)
class Curve:
    """A line of a plot, or its points if it has a `marker`.

    `low` and `high` bound a band; `fitted` makes `y` points, and is the line.
    """

    name: str
    x: FloatArray
    y: FloatArray
    low: FloatArray | None = None
    high: FloatArray | None = None
    fitted: FloatArray | None = None
    marker: str = ""
    dashed: bool = False


@dataclass(frozen=True)
class Plot:
    """Curves in one pair of axes, in the units that their labels name."""

    title: str
    across: str
    up: str
    curves: tuple[Curve, ...]
    shaded: tuple[tuple[float, float], ...] = ()  # stretches of the abscissa, from and to
    logarithmic: bool = False


@dataclass(frozen=True)
class Findings:
    """What a command has found; `details` are tables which on a page come after the plots."""

    title: str
    tables: tuple[Table, ...]
    sentences: tuple[str, ...] = ()  # what the numbers say, in words
    warnings: tuple[str, ...] = ()  # what speaks against them
    plots: tuple[Plot, ...] = ()  # for the report
    details: tuple[Table, ...] = ()
    # The numbers for other programs, SI units and radians; arrays and numbers, in Mappings.
    values: Mapping[str, Any] = field(default_factory=dict)
    # Columns of equal length for a CSV, by their headings, which name the units.
    columns: Mapping[str, Any] = field(default_factory=dict)
