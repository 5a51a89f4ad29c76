"""Where constant errors lead: position along hours of rest, by cause and by mode."""

from collections.abc import Sequence

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import static_error_modes
from driftlab.calibration.error_budget import MissionErrors

POINTS = 361
DAY = 86400.0
SETTABLE = {
    7: "gyro bias East", 8: "gyro bias North", 9: "gyro bias Up", 10: "acc. bias East",
    11: "acc. bias North", 0: "tilt East", 1: "tilt North", 2: "azimuth",
}  # fmt: skip
"""Causes that a reader can set: their place in `STATIC_ERROR_SOURCES`, and a short name."""


def mission(causes: Sequence[float], latitude: float, duration: float) -> DataTable:
    """Let a unit with these causes of error rest.

    They are in the order of `STATIC_ERROR_SOURCES`, SI units.
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
    position, heading = states[:, 5:], states[:, 2]
    rate = float(MissionErrors(times, position, heading).radial_error_rate)
    shown = [i for i in SETTABLE if parts[i].any()]
    axes = ("East", "North")
    return DataTable(
        {
            "time": (times, "h", "since the start"),
            "position": (position.T, "nmi", "error along each axis", axes),
            "slow": (slow[:, 5:].T, "nmi", "the same without Schuler's swing", axes),
            "end": (position[-1:].T, "nmi", "position error at the end", axes),
        },
        {
            "heading_error": (heading[-1], "arcmin", "heading error at the end"),
            "rate": (rate, "m_per_s", "slope of the line from the start that fits the distance"),
            "causes": ([SETTABLE[i] for i in shown], "", "that are not zero"),
            # of each of them: the distance at the end, how far a line leads in a day, and the
            # amplitudes of the terms of 24 hours and of Schuler's swing; of an ellipse, the root of
            # the sum of squares of its half axes
            "parts": (parts[shown], "nmi", "of the position error"),
        },
    )
