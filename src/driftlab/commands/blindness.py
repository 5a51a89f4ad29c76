"""Whether gyros see the Earth turn, and what may be the matter if they do not."""

from __future__ import annotations

import numpy as np
from scipy.constants import degree, hour

from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE

from .numbers import DEG_PER_HOUR, written

SLIPS = {
    1 / degree: "degrees taken for radians",
    degree: "radians taken for degrees",
    hour: "deg/h taken for deg/s",
    1 / hour: "deg/s taken for deg/h",
}
"""By the factor that they make of a rate."""
CLOSE = 1.1
"""A factor so near to that of a slip may be it."""
LEVELS = "Pitch and roll come from the accelerometers."


def blindness(rate: FloatArray) -> tuple[str, bool]:
    """Why means (n, 3) of gyros do not see the Earth turn, and whether the gyros are the reason.

    A rate of the wrong size has an error at least as large as the difference: half the Earth's rate
    may turn the heading by half a radian and more. Empty and False if they see it.
    """
    found = float(np.linalg.norm(rate.mean(axis=0)))
    noise = float(rate.std(axis=0, ddof=1).max() / np.sqrt(len(rate)))
    sizes = (found, EARTH_RATE, noise)
    shown, earth, spread = (written(size / DEG_PER_HOUR.size, digits=4) for size in sizes)
    if abs(found - EARTH_RATE) > max(EARTH_RATE / 2, 3 * noise):
        return (
            f"No heading: at rest the gyros show {shown} deg/h, and the Earth turns by {earth} "
            f"deg/h. {_reason(found / EARTH_RATE)} {LEVELS}"
        ), True
    if noise > EARTH_RATE / 5:
        return (
            f"No heading from the means: they are known to {spread} deg/h only, and the Earth "
            f"turns by {earth} deg/h. The base was not still, or the record is too short for such "
            f"gyros. {LEVELS}"
        ), False
    return "", False


def _reason(factor: float) -> str:
    """What makes a rate wrong by a factor."""
    slips = [slip for one, slip in SLIPS.items() if 1 / CLOSE < factor / one < CLOSE]
    ratio = f"{factor:.3g} times" if factor > 1 else f"1/{1 / max(factor, 1e-9):.3g} of"
    named = f"That is {ratio} the Earth's rate: {slips[0]}? Or " if slips else ""
    if factor < 1:
        reason = "the logger has taken the bias off already, and with it the Earth's rate."
    else:
        reason = (
            "their biases hide it; a compass needs gyros whose biases are a small part of the "
            "Earth's rate."
        )
    return f"{named}{reason}" if named else reason[0].upper() + reason[1:]
