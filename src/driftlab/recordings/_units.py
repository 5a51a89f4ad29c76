"""Units of gyros, accelerometers and time stamps, as logs and their headers write them.

A unit says what is measured too: deg/s is a rate, deg an increment over one interval; m/s^2 is a
specific force, m/s an increment of velocity.
"""

from __future__ import annotations

import re
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from scipy.constants import g as STANDARD_GRAVITY

from driftlab.checks import checked_text, shown

from .recording import Kind

_ARCSEC = np.pi / 648000
GYRO_UNITS: dict[str, tuple[Kind, float]] = {
    "deg/s": ("rates", np.pi / 180),
    "mdeg/s": ("rates", np.pi / 180e3),
    "rad/s": ("rates", 1.0),
    "mrad/s": ("rates", 1e-3),
    "deg/h": ("rates", _ARCSEC),
    "deg": ("increments", np.pi / 180),
    "rad": ("increments", 1.0),
    "mrad": ("increments", 1e-3),
    "urad": ("increments", 1e-6),
    "arcsec": ("increments", _ARCSEC),
}
"""Kind and size in rad/s or rad of each unit of angular rates and angle increments."""
ACCELEROMETER_UNITS: dict[str, tuple[Kind, float]] = {
    "m/s^2": ("rates", 1.0),
    "g": ("rates", STANDARD_GRAVITY),
    "mg": ("rates", 1e-3 * STANDARD_GRAVITY),
    "m/s": ("increments", 1.0),
    "mm/s": ("increments", 1e-3),
    "g*s": ("increments", STANDARD_GRAVITY),
    "mg*s": ("increments", 1e-3 * STANDARD_GRAVITY),
    "ug*s": ("increments", 1e-6 * STANDARD_GRAVITY),
}
"""Kind and size in m/s^2 or m/s of each unit of specific force and velocity increments."""
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Size of the units of time stamps, s."""
_SPELLINGS = (
    (r"[µμ]", "u"),
    (r"milli-?", "m"),
    (r"micro-?", "u"),
    (r"²|\*\*2", "^2"),
    (r"[·⋅]", "*"),
    (r"°|degrees?", "deg"),
    (r"radians?", "rad"),
    (r"met(er|re)s?", "m"),
    (r"arc-?sec(onds?)?", "arcsec"),
    (r"(?<!arc)sec(onds?)?", "s"),
    (r"(hours?|hr)$", "h"),
    (r"/s/s$|/s2$", "/s^2"),
    (r"^(m?)dps$", r"\1deg/s"),
    (r"(?<=g)s$", "*s"),
)


class Unit(NamedTuple):
    """What a triad delivers, and the size of one unit or count: rad/s, rad, m/s^2 or m/s."""

    kind: Kind
    size: float


def gyro_unit(text: str) -> Unit:
    """Return what a unit of angular rates or angle increments means, in rad/s or rad."""
    return _unit(checked_text(text, "units"), GYRO_UNITS, "gyros")


def accelerometer_unit(text: str) -> Unit:
    """Return what a unit of specific force or velocity increments means, in m/s^2 or m/s."""
    return _unit(checked_text(text, "units"), ACCELEROMETER_UNITS, "accelerometers")


def time_unit(text: str) -> float:
    """Return the size of a unit of time, s."""
    if (size := TIME_UNITS.get(spelled(checked_text(text, "units")))) is None:
        raise ValueError(
            f"units: expected one of {', '.join(TIME_UNITS)} for time, got {shown(text)}."
        )
    return size


def is_unit(text: str) -> bool:
    """Say whether a text, in brackets in a header say, is a unit that is known here."""
    name = spelled(text)
    return any(name in known for known in (GYRO_UNITS, ACCELEROMETER_UNITS, TIME_UNITS))


def spelled(text: str) -> str:
    """Return a unit's name in the one spelling of the tables here."""
    name = re.sub(r"\s+", "", text.strip().lower())
    for pattern, usual in _SPELLINGS:
        name = re.sub(pattern, usual, name)
    return name


def _unit(text: str, known: dict[str, tuple[Kind, float]], triad: str) -> Unit:
    """Kind and size of a unit, which may have the size of a count before it."""
    number = re.match(r"\s*([-+.\d][-+.\deE]*(?:/[.\d]+)?)\s*\*?\s*(?=\D)", text)
    rest = text[number.end() :] if number else text
    try:
        kind, size = known[spelled(rest)]
        count = float(_quotient(number[1])) if number else 1.0
        if count <= 0:
            raise ValueError
    except (KeyError, ValueError, ZeroDivisionError):
        raise ValueError(
            f"units: expected one of {', '.join(known)} for {triad}, perhaps with the size of a "
            f"count before it as in '1/131 deg/s', got {shown(text)}."
        ) from None
    return Unit(kind, count * size)


def _quotient(text: str) -> Fraction:
    above, _, below = text.partition("/")
    return Fraction(above) / Fraction(below or 1)
