"""Where constant residuals lead: position along hours of rest, by cause and by mode."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from driftlab.calibration.error_budget import MissionErrors
from driftlab.calibration.static_error_growth import STATIC_CAUSES, static_error_modes
from driftlab.checks import FloatArray

POINTS = 361
DAY = 86400.0


class Mission(NamedTuple):
    """Errors of a unit at rest, and the parts that they are made of."""

    times: FloatArray  # (k,), s
    position: FloatArray  # (k, 2), East and North, m
    slow: FloatArray  # (k, 2), the same without Schuler's swing
    heading: FloatArray  # (k,), rad
    # (12, 4), position by cause, m: the distance at the end, how far a line leads in a day, and the
    # amplitudes of the terms of 24 hours and of Schuler's swing; of an ellipse, the root of the sum
    # of squares of its half axes
    parts: FloatArray

    @property
    def rate(self) -> float:
        """Slope of the line through the start that fits the distance best, m/s."""
        errors = MissionErrors(self.times, self.position, self.heading)
        return float(errors.radial_error_rate)

    def sizes(self) -> list[tuple[str, FloatArray]]:
        """Parts of the causes that a reader can set, under short names; without those of zero."""
        chosen = [7, 8, 9, 10, 11, 0, 1, 2]
        short = {"accelerometer": "acc.", "attitude": "tilt"}
        names = [" ".join(short.get(word, word) for word in name.split()) for name in STATIC_CAUSES]
        names[2] = "azimuth"
        return [(names[i], self.parts[i]) for i in chosen if self.parts[i].any()]


def mission(causes: Sequence[float], latitude: float, duration: float) -> Mission:
    """Let a unit with these causes of error rest.

    They are in the order of `STATIC_CAUSES`, SI units.
    """
    times = np.linspace(0.0, duration, POINTS)
    modes = static_error_modes(latitude)
    each = modes.at(times) * np.asarray(causes, float)
    whole = each.sum(axis=0)
    states = whole.sum(axis=-1)
    cosine, sine = (part[:, 5:] * np.asarray(causes) for part in (modes.cosine, modes.sine))
    squares = (cosine**2 + sine**2).sum(axis=1)
    parts = np.stack(
        [
            np.linalg.norm(whole[-1, 5:], axis=0),
            DAY * np.linalg.norm(modes.growing[5:] * causes, axis=0),
            np.sqrt(squares[0]),
            np.sqrt(squares[1] + squares[2]),
        ],
        axis=-1,
    )
    slow = each[:3].sum(axis=(0, -1))
    return Mission(times, states[:, 5:], slow[:, 5:], states[:, 2], parts)
