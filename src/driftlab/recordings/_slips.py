"""Slips of units and intervals, each known by the factor by which the numbers come out wrong."""

from __future__ import annotations

import numpy as np
from scipy.constants import g as STANDARD_GRAVITY

from .recording import Recording

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
    g, step = STANDARD_GRAVITY, recording.interval
    if recording.kind == "rates":
        slips = {
            "g taken for m/s^2": 1 / g,
            "m/s^2 taken for g": g,
            "mg taken for m/s^2": 1000 / g,
            "feet taken for metres": 1 / 0.3048,
            "increments of velocity for specific force": step,
            "increments in g*s for specific force": step / g,
        }
    else:
        slips = {
            "specific force taken for increments": 1 / step,
            "specific force in g taken for increments": 1 / (g * step),
            "g*s taken for m/s": 1 / g,
            "m/s taken for g*s": g,
            "half as long an interval": 2.0,
            "twice as long an interval": 0.5,
        }
    return _named(factor, slips)


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
    degree, step = float(np.degrees(1.0)), recording.interval
    slips = {
        "degrees taken for radians": degree,
        "radians taken for degrees": 1 / degree,
        "mrad taken for rad": 1000.0,
        "an hour taken for a second": 3600.0,
        "half as long an interval": 2.0,
        "twice as long an interval": 0.5,
    }
    if recording.kind == "rates":
        slips["increments taken for rates"] = step
        slips["increments in degrees taken for rates in radians"] = degree * step
    else:
        slips["rates taken for increments"] = 1 / step
        slips["rates in degrees taken for increments in radians"] = degree / step
    return _named(factor, slips)


def _named(factor: float, slips: dict[str, float]) -> str:
    close = [slip for slip, one in slips.items() if abs(np.log(factor / one)) < np.log(_CLOSE)]
    return f": {', or '.join(close)}?" if close else "."
