"""The bracket of the puzzle as it runs, and the square of small turns that does not close."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.attitude.integration import integrate
from driftlab.checks import FloatArray, finite_number, positive_number
from driftlab.motion.profiles import Coning
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)

from .coning import BRACKET, BRACKET_SAMPLE_RATE, ConingArea, coning_area

ROUNDS = 5
"""Rounds of the cone in a run, one second on the bracket of the puzzle."""
FINE = 24
"""Points of `ConingArea.circle` in a sample."""
MOST_MOMENTS = 480
"""Of a run."""


class BracketRun(NamedTuple):
    """`ROUNDS` rounds on a cone, and what two computers make of the same increments."""

    times: FloatArray  # (m,), s
    in_a_sample: int  # moments
    places: NDArray[np.integer]  # (m,), where in `area.circle` the run is at each moment
    # (m,), error of `picard-1` about the axis of the cone, by its last result, rad
    sums_only: FloatArray
    with_pairs: FloatArray  # (m,), the same of `two-step-4`
    area: ConingArea  # one round
    motion: Coning


def bracket_run(
    half_angle: float = BRACKET.half_angle, rate: float = BRACKET_SAMPLE_RATE
) -> BracketRun:
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
    errors = []
    for algorithm, length in (("picard-1", 1), ("two-step-4", 2)):
        found = integrate(increments, algorithm, start=motion.attitude(0.0))
        there = np.arange(1, count // length + 1) * length
        error = to_rotation_vector(multiply(found, conjugate(motion.attitude(there / rate))))[:, 2]
        known = np.concatenate([[0.0], error])
        errors.append(known[moments // (in_a_sample * length)])
    fine = moments * (FINE // in_a_sample) % (samples * FINE)
    times = moments / (in_a_sample * rate)
    return BracketRun(times, in_a_sample, fine, errors[0], errors[1], area, motion)


class SquareOfTurns(NamedTuple):
    """A body that makes four small turns about two of its axes by turns, there and back."""

    turns: FloatArray  # (m,), 0 to 4, how many turns it has made
    # (m, 2), sum of its increments about the two axes, rad: the way round the square
    summed: FloatArray
    attitude: FloatArray  # (m, 4), from the body to where it began
    vector: FloatArray  # (m, 3), rotation vector of `attitude`, rad
    area: FloatArray  # (m,), that the way has gone round as seen from its start, rad²
    tips: FloatArray  # (m, 3, 3), the three body axes, as rows


def square_of_turns(first: float, second: float, samples: int = 75) -> SquareOfTurns:
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
    swept = 0.5 * np.cumsum(x[:-1] * np.diff(y) - y[:-1] * np.diff(x))
    return SquareOfTurns(
        turns,
        summed,
        attitude,
        to_rotation_vector(attitude),
        np.concatenate([[0.0], swept]),
        rotate(attitude[:, np.newaxis], np.eye(3)),
    )
