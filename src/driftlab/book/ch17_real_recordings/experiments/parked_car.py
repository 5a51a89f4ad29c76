"""Plotnikov Fig. 2 with a real triad: headings of a parked car, found again and again."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, finite_array
from driftlab.core.carried_gravity import (
    carried_velocity,
    cone_velocity,
    earth_turn,
    wahba_rotation,
)
from driftlab.core.quantiles import chi_squared_quantile
from driftlab.core.quaternion import multiply
from driftlab.earth import EARTH_RATE
from driftlab.frames import to_euler_angles
from driftlab.gyrocompass.alignment import Alignment, align
from driftlab.gyrocompass.inertial_alignment import align_in_inertial_frame
from driftlab.increments import Increments
from driftlab.recordings.publishers import published
from driftlab.vectors import wrap_angle

METHODS = ("means", "two velocities", "all velocities")
"""Rows of the headings. Of the first the heading is that of the mean, of the others at the end."""
HEADER = float(np.radians(-90.6))
"""Heading in the header of the recording, rad, which says of itself "maybe inaccurate".

PSINS counts it from North to West, as Part IV does: in its `a2mat` the forward axis of a level body
is (-sin yaw, cos yaw, 0) in East, North, Up, so a negative yaw looks East.
"""
RESTART, LONGER, STRETCH = 70.0, 180.0, 300.0
"""Seconds of a restart; the record has 26 times the first, ten times the second."""
SHORTEST = 10.0
"""Seconds of a restart that tell a heading at all."""
LEAST = 3
"""Stretches of a length that must fit into the record, to say how far headings spread."""
APART = 0.03
"""Part of a length by which marks of the three methods stand side by side."""
UNREST = 10.0
"""Seconds over which the unrest of the car is taken."""


class Spread(NamedTuple):
    """How far a few headings spread, all in rad."""

    mean: float
    deviation: float
    reach: float  # largest minus least
    low: float  # 95 % interval of the deviation, if the headings are normal and independent
    high: float


def parked_car(lengths: ArrayLike = (RESTART, LONGER, STRETCH)) -> DataTable:
    """Cut the record into stretches and find the heading in each, by three methods.

    The lengths (s) are those of a restart, of longer stretches and of the longest.
    """
    lengths = finite_array(lengths, "lengths", 3)
    recording = published("laser-gyro", download=False).in_axes("FUR")
    if recording.latitude is None:
        raise ValueError("recording: expected one that knows its latitude.")
    longest = recording.duration / LEAST
    if not (SHORTEST <= lengths[0] < lengths[1] < lengths[2] <= longest):
        raise ValueError(
            f"lengths: expected three that grow, from {SHORTEST:g} to {longest:.0f} s, of which "
            f"the record has at least {LEAST}, got {lengths.tolist()}."
        )
    whole, latitude = recording.increments(), recording.latitude
    cuts = [stretches(whole, seconds) for seconds in lengths.tolist()]
    carried = [align_in_inertial_frame(parts, latitude) for parts in cuts]
    means = [_means(parts) for parts in cuts]
    pairs = [two_velocities(parts, latitude) for parts in cuts]
    headings = [
        np.stack([mean.heading, pair, found.heading])
        for mean, pair, found in zip(means, pairs, carried, strict=True)
    ]
    shaken, level = unrest(whole), EARTH_RATE * np.cos(latitude)
    columns: dict[str, tuple[Any, ...]] = {
        "unrest_time": (_middles(UNREST, len(shaken)), "min", "since the start"),
        "unrest": (shaken, "deg_per_h", "deviation of the level rates' means over a second"),
        "level_earth_rate": (np.array([level]), "deg_per_h", "level part of the Earth's rate"),
        "file_header_heading": (np.array([HEADER]), "deg", "heading in the file's header"),
    }
    for name, part in (("restart", 0), ("stretch", 2)):
        (mean, _, found), two = headings[part], 2 * carried[part].deviation
        end = f"{name}_all_velocities"
        columns |= {
            f"{name}_time": (_middles(lengths[part], len(mean)), "min", "since the start"),
            f"{name}_means": (mean, "deg", "heading from means"),
            end: (found, "deg", "heading from all velocities"),
            f"{end}_less_two_deviations": (found - two, "deg", "less two stated deviations"),
            f"{end}_and_two_deviations": (found + two, "deg", "plus two stated deviations"),
        }
    for row, method in enumerate(METHODS):
        word = method.replace(" ", "_")
        spreads = [spread(part[row]) for part in headings]
        middle, low, high = np.transpose([(s.deviation, s.low, s.high) for s in spreads])
        places = lengths * (1 + APART * (row - 1))
        columns |= {
            f"{word}_drawn_at_length": (places, "s", "length of stretches, marks set apart"),
            f"{word}_deviation": (middle, "deg", "standard deviation of the headings"),
            f"{word}_deviation_low": (low, "deg", "lower end of its interval of 95 %"),
            f"{word}_deviation_high": (high, "deg", "upper end of its interval of 95 %"),
        }
    by_method = "headings of {} s, a row for each of the three methods".format
    return DataTable(
        columns,
        {
            "lengths": (lengths, "s", "of restarts, longer and longest stretches"),
            "restarts": (headings[0], "deg", by_method(lengths[0])),
            "longer": (headings[1], "deg", by_method(lengths[1])),
            "stretches": (headings[2], "deg", by_method(lengths[2])),
            "restart_deviations": (carried[0].deviation, "deg", "as all velocities state them"),
            "level_rate": (carried[0].level_rate, "rad_per_s", "at which gravity moves"),
            # the alarm that `align` has in its hand
            "found_latitude": (means[0].latitude, "deg", "from the means of each restart"),
            "latitude": (latitude, "deg", "latitude of the place"),
        },
    )


def _middles(seconds: float, count: int) -> FloatArray:
    """Middles of stretches side by side, s."""
    return seconds * (np.arange(count, dtype=np.float64) + 0.5)


def _means(increments: Increments) -> Alignment:
    # What the means contradict is told in chapter 13; here the headings themselves speak.
    rate, force = increments.mean_rate.mean(axis=-2), increments.velocity.mean(axis=-2)
    return align(rate, force, heading_tolerance=np.inf)


def stretches(increments: Increments, seconds: float) -> Increments:
    """Cut a record into as many stretches of a length as it has, side by side."""
    interval, angle, velocity = increments
    rows = round(seconds / interval)
    count = len(angle) // rows
    return Increments(
        interval, *(part[: count * rows].reshape(count, rows, 3) for part in (angle, velocity))
    )


def two_velocities(increments: Increments, latitude: float) -> FloatArray:
    """Headings (...) at the end, from the velocities at half time and at the end alone.

    The plane of the two tells the heading. PSINS has this in ``aligni0``, besides the same with
    positions.
    """
    interval, angle, velocity = increments
    turn, carried = carried_velocity(CONING_ALGORITHMS["two-step-4"].steps, angle, velocity)
    count = carried.shape[-2]
    times = 2 * interval * np.array([count // 2, count])
    cone = cone_velocity(np.array(latitude), times)
    seen = carried[..., [count // 2 - 1, count - 1], :]
    given, wanted = (rows / np.linalg.norm(rows, axis=-1, keepdims=True) for rows in (seen, cone))
    start = wahba_rotation(given, wanted, np.ones(2))
    end = multiply(multiply(earth_turn(np.array(latitude), float(times[-1])), start), turn)
    return to_euler_angles(end).heading


def unrest(increments: Increments) -> FloatArray:
    """Standard deviation of the level rates' means over a second, in each ten seconds, rad/s."""
    seconds = stretches(increments, 1.0).angle.sum(axis=-2)[:, [0, 2]]
    rows = round(UNREST)
    count = len(seconds) // rows
    parts = seconds[: count * rows].reshape(count, rows, 2)
    return np.sqrt(parts.var(axis=1, ddof=1).mean(axis=-1))


def spread(headings: FloatArray) -> Spread:
    """Spread of headings (n,)."""
    middle = headings[0]
    values = middle + wrap_angle(headings - middle)
    freedom = len(values) - 1
    deviation = float(values.std(ddof=1))
    low, high = deviation * np.sqrt(freedom / chi_squared_quantile([0.975, 0.025], freedom))
    return Spread(float(values.mean()), deviation, float(np.ptp(values)), float(low), float(high))
