"""The bracket of the puzzle as it runs, and the square of small turns that does not close."""

import numpy as np

from driftlab.attitude.integration import integrate
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import finite_number, positive_number
from driftlab.motion.profiles import Coning
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)

from .coning import BRACKET, BRACKET_SAMPLE_RATE, coning_area

ROUNDS = 5
"""Rounds of the cone in a run, one second on the bracket of the puzzle."""
FINE = 24
"""Points of the circle of `coning_area` in a sample."""
MOST_MOMENTS = 480
"""Of a run."""


def bracket_run(
    half_angle: float = BRACKET.half_angle, rate: float = BRACKET_SAMPLE_RATE
) -> DataTable:
    """Run the bracket for `ROUNDS` rounds, and compute its attitude in two ways.

    An even number of samples, four at least, must make a round.
    """
    motion = Coning(positive_number(half_angle, "half_angle"), BRACKET.frequency)
    samples = round(positive_number(rate, "rate") / motion.frequency)
    area = coning_area(samples)
    in_a_sample = next(
        d for d in (24, 12, 8, 6, 4, 3, 2, 1) if ROUNDS * samples * d <= MOST_MOMENTS
    )
    count = ROUNDS * samples
    moments = np.arange(count * in_a_sample + 1)
    increments = motion.increments(1 / rate, count)
    missed = []
    for algorithm, length in (("picard-1", 1), ("two-step-4", 2)):
        found = integrate(increments, algorithm, start=motion.attitude(0.0))
        there = np.arange(1, count // length + 1) * length
        error = to_rotation_vector(multiply(found, conjugate(motion.attitude(there / rate))))[:, 2]
        known = np.concatenate([[0.0], -error])
        missed.append(known[moments // (in_a_sample * length)])
    times = moments / (in_a_sample * rate)
    slivers = (area.circle_area - area.polygon_area) * np.sin(motion.half_angle) ** 2
    places = moments * (FINE // in_a_sample) % (samples * FINE)
    missed_part = 1 - area.polygon_area / area.circle_area
    return DataTable(
        {
            "time": (times, "s", "since the start"),
            "slivers": (slivers * motion.frequency * times, "arcsec", "their area, added up"),
            "one_by_one": (missed[0], "arcsec", "missed about the axis of the cone by picard-1"),
            "with_pairs": (missed[1], "arcsec", "the same by two-step-4"),
        },
        {
            "motion": (motion, "", "of the bracket"),
            "in_a_sample": (in_a_sample, "", "moments in a sample"),
            "circle": (area.circle.T / area.radius, "", "integral of the rate, over its radius"),
            "corners": (area.corners.T / area.radius, "", "the same, summed from increments"),
            "places": (places, "", "where on the circle the run is at each moment"),
            "drift_one_by_one": (missed[0][-1] / times[-1], "deg_per_h", "drift, one by one"),
            "drift_with_pairs": (missed[1][-1] / times[-1], "deg_per_h", "drift, with pairs"),
            "samples": (samples, "", "samples in a round"),
            "missed_part": (missed_part, "percent", "missed part of the circle"),
        },
    )


def square_of_turns(first: float, second: float, samples: int = 75) -> DataTable:
    """Turn a body about axis 1, about axis 2, back about axis 1, and back about axis 2."""
    sides = np.array([finite_number(first, "first"), finite_number(second, "second")])
    corners = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]) * sides
    turns = np.arange(4 * samples + 1) / samples
    summed = np.stack([np.interp(turns, np.arange(5), corner) for corner in corners.T], axis=-1)
    attitude = np.empty((len(turns), 4))
    attitude[0] = 0.0, 0.0, 0.0, 1.0
    for side in range(4):
        now = slice(side * samples, (side + 1) * samples + 1)
        turned = np.zeros((samples + 1, 3))
        turned[:, :2] = summed[now] - summed[side * samples]
        attitude[now] = multiply(attitude[side * samples], from_rotation_vector(turned))
    x, y = summed.T
    area = 0.5 * np.append(0.0, np.cumsum(x[:-1] * np.diff(y) - y[:-1] * np.diff(x)))
    vector = to_rotation_vector(attitude)
    return DataTable(
        {
            "turns": (turns, "", "made"),
            # rad², to be compared with an angle
            "area": (area, "deg", "that the way has gone round as seen from its start"),
            "about_third": (vector[:, 2], "deg", "the body has turned about its third axis"),
            "angle": (np.linalg.norm(vector, axis=-1), "deg", "it has turned in all"),
        },
        {
            "summed": (summed, "rad", "sums of the increments about two axes: the way round"),
            "attitude": (attitude, "", "from the body to where it began"),
            "vector": (vector, "rad", "rotation vector of the attitude"),
            "tips": (rotate(attitude[:, np.newaxis], np.eye(3)), "", "body axes, as rows"),
        },
    )
