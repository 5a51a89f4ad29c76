"""How far the rates of a body at rest contradict the Earth's, and what of the heading that spoils.

At rest the gyros feel the Earth and nothing else. Its whole rate is known, and with the latitude
its part along the level and its part about Up. A spurious rate, of a body that leans meanwhile or
of a gyro that drifts, shows in those. Across the meridian it does not show: there it turns the
heading. So the size of what shows is the only thing that tells of the size of what does not.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, shown
from driftlab.earth import EARTH_RATE, checked_latitude

NOT_KNOWN = np.array(np.nan)
NOT_KNOWN.setflags(write=False)  # what all results without a value share
NOTHING_KNOWN = np.pi / np.sqrt(3)
"""Standard deviation of a heading of which nothing is known, rad: 104 degrees."""


class RateContradiction(NamedTuple):
    """How far rates contradict what is known of them; NaN where nothing is known. Each (...)."""

    rate_discrepancy: FloatArray  # whole rate less the Earth's, rad/s
    latitude_discrepancy: FloatArray  # latitude found less the known one, rad
    spurious_rate: FloatArray  # root mean square over the directions that are known, rad/s
    heading_uncertainty: FloatArray  # how far such a rate can turn the heading, rad, at most pi/2


def rate_contradiction(
    level: FloatArray,
    up: FloatArray | None = None,
    latitude: ArrayLike | None = None,
    *,
    size_known: bool = True,
) -> RateContradiction:
    """Compare the level and the vertical rate found, rad/s (...), with the Earth's.

    Without `size_known` only their ratio counts, the latitude found.
    """
    # A level rate s across what is found, L, turns the heading by arcsin(s/L), and no rate of this
    # size turns it farther. With no unit the least spurious rate is that across the line of the
    # known latitude, U sin(difference of the latitudes). Without a latitude a level rate alone can
    # only be too large, larger than the whole rate of the Earth.
    excess = turned = NOT_KNOWN
    known = None if latitude is None else checked_latitude(latitude)
    earth_level = EARTH_RATE * np.cos(known) if known is not None else np.minimum(level, EARTH_RATE)
    seen = [NOT_KNOWN]
    if up is not None and size_known:
        excess = np.hypot(level, up) - EARTH_RATE
    if up is not None and known is not None:
        turned = np.arctan2(up, level) - known
    if size_known and known is not None:
        seen = [level - earth_level]
        if up is not None:
            seen.append(up - EARTH_RATE * np.sin(known))
    elif size_known and up is not None:
        seen = [excess]
    elif size_known:
        seen = [np.where(level > EARTH_RATE, level - EARTH_RATE, np.nan)]
    elif known is not None and up is not None:
        seen = [EARTH_RATE * np.sin(np.minimum(np.abs(turned), np.pi / 2))]
    # Like the root of the mean of the squares, but these may be too large for a number.
    spurious = np.hypot.reduce(np.broadcast_arrays(*seen), axis=0) / np.sqrt(len(seen))
    part = spurious / np.maximum(earth_level, np.finfo(float).tiny)
    error = np.arcsin(np.minimum(part, 1.0))
    every = np.broadcast_arrays(excess, turned, spurious, error, level)[:4]
    return RateContradiction(*(np.array(each)[()] for each in every))


def checked_tolerance(value: object) -> float:
    """Return `heading_tolerance`, rad, a positive number; infinity means no warning."""
    array = np.asarray(value) if np.isscalar(value) or isinstance(value, np.ndarray) else None
    if array is None or array.dtype.kind not in "fiu" or array.ndim or not array > 0:
        raise ValueError(
            "heading_tolerance: expected a positive number, rad, or infinity for no warning, "
            f"got {shown(value)}."
        )
    return float(array)


def sign_slip(found: float, told: float, named: str = "latitude") -> str:
    """Say what a latitude found, rad, that is minus the one told may come from, or return ""."""
    if not 3 * abs(found + told) < abs(found - told):
        return ""
    return (
        f"the latitude found, {np.degrees(found):.3g} degrees, is minus the one told: look at the "
        f"sign of {named}; at those of the gyros, by which the heading would be off by half a "
        "turn; and at those of the accelerometers, by which the body would be upside down, as at "
        "rest they show +g upwards"
    )
