"""Slips of units and intervals, each known by the factor by which the numbers come out wrong."""

from __future__ import annotations

import numpy as np
from scipy.constants import g as STANDARD_GRAVITY

from .recording import Kind, Recording

_CLOSE = 1.25
"""A factor so near to that of a slip may be it: errors of sensors and of the estimate."""


def force_slips(factor: float, recording: Recording) -> str:
    """Name the mistakes that make specific force too large by about a factor.

    The result ends a sentence: a colon and the mistakes, or the full stop alone.
    """
    return _named(factor, force_factors(recording.kind, recording.interval))


def gyro_slips(factor: float, recording: Recording) -> str:
    """Name the mistakes that make angular rates or angles too large by about a factor.

    The result ends a sentence, as for `force_slips`.
    """
    return _named(factor, gyro_factors(recording.kind, recording.interval))


def force_factors(kind: Kind, interval: float) -> dict[str, float]:
    """Return the factors by which mistakes enlarge specific force or its increments, by mistake."""
    g = STANDARD_GRAVITY
    if kind == "rates":
        return {
            "g taken for m/s^2": 1 / g,
            "m/s^2 taken for g": g,
            "mg taken for m/s^2": 1000 / g,
            "feet taken for metres": 1 / 0.3048,
            "increments of velocity for specific force": interval,
            "increments in g*s for specific force": interval / g,
        }
    return {
        "specific force taken for increments": 1 / interval,
        "specific force in g taken for increments": 1 / (g * interval),
        "specific force in mg taken for increments": 1000 / (g * interval),
        "g*s taken for m/s": 1 / g,
        "m/s taken for g*s": g,
        "twice as long an interval": 2.0,
        "half as long an interval": 0.5,
    }


def gyro_factors(kind: Kind, interval: float) -> dict[str, float]:
    """Return the factors by which mistakes enlarge angular rates or angles, by mistake."""
    degree = float(np.degrees(1.0))
    factors = {
        "degrees taken for radians": degree,
        "radians taken for degrees": 1 / degree,
        "mrad taken for rad": 1000.0,
        "an hour taken for a second": 3600.0,
        "half as long an interval": 2.0,
        "twice as long an interval": 0.5,
    }
    if kind == "rates":
        factors["increments taken for rates"] = interval
        factors["increments in degrees taken for rates in radians"] = degree * interval
    else:
        factors["rates taken for increments"] = 1 / interval
        factors["rates in degrees taken for increments in radians"] = degree / interval
    return factors


def _named(factor: float, slips: dict[str, float]) -> str:
    close = [slip for slip, one in slips.items() if one / _CLOSE < factor < one * _CLOSE]
    return f": {', or '.join(close)}?" if close else "."
