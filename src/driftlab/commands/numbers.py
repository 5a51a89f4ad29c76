"""Numbers as people read them: in a unit of a fitting size, no more digits than are known."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro, milli


class Unit(NamedTuple):
    """A unit for the eye, and its size in SI."""

    name: str
    size: float


DEGREES = Unit("deg", degree)
DEG_PER_HOUR = Unit("deg/h", degree / hour)
RATES = (Unit("deg/s", degree), DEG_PER_HOUR)
FORCES = (Unit("mg", milli * g), Unit("micro-g", micro * g))
SCALES = (Unit("%", 0.01), Unit("ppm", micro))
SMALL_ANGLES = (Unit("arcmin", arcminute), Unit("arcsec", arcsecond))


def fitting(values: ArrayLike, units: tuple[Unit, ...], least: float = 0.1) -> Unit:
    """The largest unit in which the largest value is at least `least`; otherwise the smallest."""
    largest = float(np.nanmax(np.abs(np.asarray(values, float)), initial=0.0))
    return next((unit for unit in units if largest >= least * unit.size), units[-1])


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


def with_deviation(value: float, deviation: float | None, unit: Unit) -> tuple[str, str, str]:
    """A number, its deviation and their unit, as three cells of a table."""
    shown = value / unit.size
    if deviation is None:
        return written(shown), "", unit.name
    spread = deviation / unit.size
    return written(shown, spread), written(spread, spread), unit.name
