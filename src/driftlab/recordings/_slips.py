"""Slips of units and intervals, each known by the factor by which the numbers come out wrong."""

from __future__ import annotations

import numpy as np
from scipy.constants import g as STANDARD_GRAVITY

from .recording import Kind, Recording

_CLOSE = 1.25
"""A factor so near to that of a slip may be it: errors of sensors and of the estimate."""


def force_slips(factor: float, recording: Recording) -> str:
    """Name the slips that make specific force too large by about a factor.

    Parameters
    ----------
    factor : float
        Found over expected.
    recording : Recording
        Its kind and interval matter.

    Returns
    -------
    str
        The end of a sentence: a colon and the slips, or nothing but the full stop.

    Examples
    --------
    >>> still = Recording(np.zeros((9, 3)), np.ones((9, 3)), 0.01, "rates")
    >>> force_slips(0.1, still)
    ': g taken for m/s^2?'
    """
    return _named(factor, force_factors(recording.kind, recording.interval))


def gyro_slips(factor: float, recording: Recording) -> str:
    """Name the slips that make angular rates or angles too large by about a factor.

    Parameters
    ----------
    factor : float
        Found over expected.
    recording : Recording
        Its kind and interval matter.

    Returns
    -------
    str
        As of `force_slips`.

    Examples
    --------
    >>> log = Recording(np.zeros((9, 3)), None, 0.02, "rates")
    >>> gyro_slips(0.0199, log), gyro_slips(7.0, log)
    (': radians taken for degrees, or increments taken for rates?', '.')
    """
    return _named(factor, gyro_factors(recording.kind, recording.interval))


def force_factors(kind: Kind, interval: float) -> dict[str, float]:
    """Factors by which slips make specific force, or its increments, too large.

    Parameters
    ----------
    kind : {"rates", "increments"}
        What the numbers are taken for.
    interval : float
        s.

    Returns
    -------
    dict of str to float
        Under what was taken for what.

    Examples
    --------
    >>> force_factors("increments", 0.01)["specific force taken for increments"]
    100.0
    """
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
    """Factors by which slips make angular rates or angles too large.

    Parameters
    ----------
    kind : {"rates", "increments"}
        What the numbers are taken for.
    interval : float
        s.

    Returns
    -------
    dict of str to float
        Under what was taken for what.

    Examples
    --------
    >>> round(gyro_factors("rates", 0.01)["degrees taken for radians"], 1)
    57.3
    """
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
