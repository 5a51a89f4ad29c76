"""A rotation scheme as it is played: how the body stands, and how well its errors are known."""

from functools import lru_cache

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import ERROR_MODELS, linearize_along, standard_deviation_history
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import DIRECTIONS, NINETEEN_POSITIONS, Scheme
from driftlab.motion.turntable import Segment, segments
from driftlab.quaternion import from_rotation_vector, multiply, to_matrix

MOMENTS = 12
"""Of each pause, and of each turn."""


@lru_cache(maxsize=8)
def scheme_run(scheme: Scheme = NINETEEN_POSITIONS) -> DataTable:
    """Follow a scheme, and the covariance of a filter that sees the velocity once a second.

    There are as many moments in a turn as in a pause, though a pause is much longer. The unit has
    the typical spread of errors, the sensors the typical noise. The last runs are kept.
    """
    way = linearize_along(scheme, TABLE_LATITUDE, ERROR_MODELS["averaged"])
    known = standard_deviation_history(way, ImuNoise(), PriorStandardDeviations())
    known_at = np.append(0.0, np.cumsum(way.durations))
    row = segments(scheme, 1e-3)
    begins = np.append(0.0, np.cumsum([segment.duration for segment in row]))
    doing = np.append(np.repeat(np.arange(len(row)), MOMENTS), len(row) - 1)
    step = np.arange(len(doing))
    since = (step - MOMENTS * doing) / MOMENTS * np.diff(begins)[doing]
    turned = np.array([segment.rate * segment.axis for segment in row])[doing]
    at_first = np.array([segment.attitude for segment in row])[doing]
    times = begins[doing] + since
    attitude = multiply(at_first, from_rotation_vector(turned * since[:, np.newaxis]))
    return DataTable(
        {
            # k in the middle of pause k, k + 1/2 in the middle of the turn that follows it
            "place": (0.75 + step / (2 * MOMENTS), "", "in the row of positions"),
            "time": (times, "min", "since the start"),
            "doing": (doing, "", "which of the doings it is"),
        },
        {
            "attitude": (attitude, "", "body to East, North, Up"),
            "doings": ([doing_of(each) for each in row], "", "pauses and turns, one by one"),
            "names": (way.model.names, "", "of the 27 states in averaged axes"),
            "standard_deviations": (
                np.stack([np.interp(times, known_at, column) for column in known.T], axis=-1), "",
                "expected standard deviations of the states, SI units",
            ),
        },
    )  # fmt: skip


def doing_of(segment: Segment) -> str:
    """Say how the body stands in a pause, or what turns it, like "turns by +90° about y"."""
    if segment.rate:
        angle = np.degrees(segment.rate * segment.duration)
        return f"turns by {angle:+.0f}° about {'xyz'[segment.axis.argmax()]}".replace("-", "−")
    axes = to_matrix(segment.attitude).T
    words = [max(DIRECTIONS, key=lambda word: axis @ np.array(DIRECTIONS[word])) for axis in axes]
    return ", ".join(f"{axis} {word}" for axis, word in zip("xyz", words, strict=True))
