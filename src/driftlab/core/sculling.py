"""Velocity that a body gains in a step of an attitude algorithm, corrected for its turning."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

from .coning import ConingSteps
from .vectors import components_first, components_last, cross


def sculling_correction(
    algorithm: ConingSteps, angle: FloatArray, velocity: FloatArray
) -> FloatArray:
    """Sculling correction (..., n // samples, 3); see `velocity_of_steps`."""
    angles, velocities = _places(algorithm, angle, velocity)
    return components_last(_sculling(algorithm, angles, velocities))


def velocity_of_steps(
    algorithm: ConingSteps, angle: FloatArray, velocity: FloatArray
) -> FloatArray:
    """Velocity increments (..., n // samples, 3) of steps, in the body axes at the start of each.

    With g_i, v_i the increments of a step, p = sum of g + coning correction is its rotation vector
    and v the sum of the v_i. Under a constant rate and force the body's turn adds p×v/2 + p×(p×v)/6
    + ...; where they change there is sculling, s = sum of w_ij (g_i×v_j + v_i×g_j) with the weights
    of the coning correction, which is turned by p/2 in its turn. The algorithm has no memory.
    """
    angles, velocities = _places(algorithm, angle, velocity)
    coning = sum(
        (weight * cross(angles[i], angles[j]) for i, j, weight in algorithm.products()),
        np.zeros_like(angles[0]),
    )
    p = sum(angles[1:], angles[0]) + coning
    v = sum(velocities[1:], velocities[0])
    sculling = _sculling(algorithm, angles, velocities)
    once = cross(p, v)
    twice = cross(p, once)
    steps = v + once / 2 + twice / 6 + cross(p, twice) / 24 + sculling + cross(p, sculling) / 2
    return components_last(steps)


def _places(
    algorithm: ConingSteps, angle: FloatArray, velocity: FloatArray
) -> tuple[list[FloatArray], list[FloatArray]]:
    """Increments (3, ..., n // samples) at each place of a step."""
    # Components first, so that everything but a cross product is plain arithmetic; broadcast
    # before, or the components of one would meet the runs of the other.
    rows = (components_first(row) for row in np.broadcast_arrays(angle, velocity))
    m = algorithm.samples
    angles, velocities = ([row[..., i::m] for i in range(m)] for row in rows)
    return angles, velocities


def _sculling(
    algorithm: ConingSteps, angles: list[FloatArray], velocities: list[FloatArray]
) -> FloatArray:
    return sum(
        (
            weight * (cross(angles[i], velocities[j]) + cross(velocities[i], angles[j]))
            for i, j, weight in algorithm.products()
        ),
        np.zeros_like(angles[0]),
    )
