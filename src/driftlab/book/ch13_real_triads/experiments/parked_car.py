"""Plotnikov Fig. 2 with a real triad: headings of a parked car, found again and again."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.checks import FloatArray, finite_array
from driftlab.core.carried_gravity import (
    carried_velocity,
    cone_velocity,
    earth_turn,
    wahba_rotation,
)
from driftlab.core.quantiles import chi_squared_quantile
from driftlab.core.quaternion import multiply
from driftlab.frames import to_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.alignment_results import Alignment
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
UNREST = 10.0
"""Seconds over which the unrest of the car is taken."""


class ParkedCar(NamedTuple):
    """Headings from stretches of one record, by the three methods in the order of `METHODS`."""

    # (3,), of the stretches, s: of the restarts, longer and longest. Published for 70, 180 and 300
    # s, of which the record has 26, 10 and 6
    lengths: FloatArray
    restarts: FloatArray  # (3, 26), headings, rad
    longer: FloatArray  # (3, 10), headings, rad
    stretches: FloatArray  # (3, 6), headings, rad
    restart_deviations: FloatArray  # (26,), standard deviations as all velocities state them, rad
    longer_deviations: FloatArray  # (10,), likewise
    stretch_deviations: FloatArray  # (6,), likewise
    # (26,), from the means of each restart, rad: the alarm that `align` has in its hand
    found_latitude: FloatArray
    level_rate: FloatArray  # (26,), at which gravity is seen to move in each restart, rad/s
    latitude: FloatArray  # (), of the place, rad
    # (184,), standard deviation of the level rates' means over a second, in each ten seconds, rad/s
    unrest: FloatArray


class Spread(NamedTuple):
    """How far a few headings spread, all in rad."""

    mean: float
    deviation: float
    reach: float  # largest minus least
    low: float  # 95 % interval of the deviation, if the headings are normal and independent
    high: float


def parked_car(lengths: ArrayLike = (RESTART, LONGER, STRETCH)) -> ParkedCar:
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
    two = [two_velocities(parts, latitude) for parts in cuts]
    headings = [
        np.stack([mean.heading, pair, found.heading])
        for mean, pair, found in zip(means, two, carried, strict=True)
    ]
    return ParkedCar(
        lengths,
        headings[0],
        headings[1],
        headings[2],
        carried[0].deviation,
        carried[1].deviation,
        carried[2].deviation,
        found_latitude=means[0].latitude,
        level_rate=carried[0].level_rate,
        latitude=np.array(latitude),
        unrest=unrest(whole),
    )


def _means(increments: Increments) -> Alignment:
    # What the means contradict is told in chapter 09; here the headings themselves speak.
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


def chance_of_ratio(first: float, second: float, freedom: int) -> float:
    """Chance that one true deviation gives two samples whose deviations differ by such a factor.

    For samples that have nothing to do with each other; for two methods on the same stretches there
    is `chance_of_paired_ratio`.
    """
    from scipy.stats import f  # takes a third of a second to be loaded

    ratio = max(first / second, second / first) ** 2
    return float(2 * f.sf(ratio, freedom, freedom))


def chance_of_paired_ratio(first: FloatArray, second: FloatArray) -> float:
    """Chance that pairs with one true deviation show so different ones, by Pitman and Morgan.

    The covariance of sums and differences is the difference of the variances, whatever the two have
    in common. Pairs are normal, and as many as the headings (n,) of each.
    """
    from scipy.stats import pearsonr  # takes a third of a second to be loaded

    pairs = wrap_angle(np.stack([first, second]) - first[0])
    return float(pearsonr(pairs[0] + pairs[1], pairs[0] - pairs[1]).pvalue)
