"""The loops of `driftlab.core.loops` by Numba.

They take and return what those of the same name in NumPy do, arrays of any leading axes; the
kernels have one leading axis and no gaps.
"""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

from . import attitude, kernels
from .coning import ConingSteps
from .earth import refuse_inner_earth
from .functional_iteration import WindowSteps
from .strapdown import Navigation, steps_at_once

_STAGES = ("rotation vector", "first iterate", "second iterate", "third iterate", "tangent")


def attitudes(
    algorithm: ConingSteps | WindowSteps,
    increments: FloatArray,
    past: int = 0,
    first: FloatArray = attitude.NO_TURN,
) -> FloatArray:
    """As `driftlab.core.attitude.attitudes`."""
    if isinstance(algorithm, WindowSteps):
        return attitude.attitudes(algorithm, increments, past, first, cumulative_product)
    lead = np.broadcast_shapes(first.shape[:-1], increments.shape[:-2])
    begun, rows = _runs(first[..., np.newaxis, :], lead), _runs(increments, lead)
    found = np.empty((*lead, (increments.shape[-2] - past) // algorithm.samples, 4))
    stage = _STAGES.index(algorithm.last_stage)
    largest = kernels.attitudes(
        begun, rows, algorithm.samples, algorithm.memory, past, algorithm.pairs,
        algorithm.weights, algorithm.starts, stage, _runs(found, lead),
    )  # fmt: skip
    attitude.refuse_whole_turns(largest)
    return found


def cumulative_product(quaternions: FloatArray) -> FloatArray:
    """As `driftlab.core.quaternion.cumulative_product`."""
    rows = _runs(quaternions, quaternions.shape[:-2])
    found = np.empty(rows.shape)
    kernels.cumulative_product(rows, found)
    return found.reshape(quaternions.shape)


def navigate(
    start: Navigation,
    angle: FloatArray,
    velocity: FloatArray,
    interval: float,
    algorithm: ConingSteps,
    *,
    every: int = 2,
    hold_altitude: bool = False,
) -> Navigation:
    """As `driftlab.core.strapdown.navigate`."""
    place = start.latitude, start.longitude, start.altitude
    lead = np.broadcast_shapes(
        *(each.shape for each in place),
        *(each.shape[:-1] for each in (start.velocity, start.attitude)),
        *(each.shape[:-2] for each in (angle, velocity)),
    )
    begun = np.empty((*lead, 10))
    begun[..., 0], begun[..., 1], begun[..., 2] = place
    begun[..., 3:6], begun[..., 6:] = start.velocity, start.attitude
    angles, pushes = _runs(angle, lead), _runs(velocity, lead)
    count = angles.shape[1] // every
    begun = begun.reshape(-1, 10)
    found = np.empty((len(begun), count, 10))
    stage = _STAGES.index(algorithm.last_stage)
    largest, lowest = kernels.navigate(
        begun, angles, pushes, interval, algorithm.samples, algorithm.pairs, algorithm.weights,
        stage, steps_at_once(interval), every // 2, hold_altitude, found,
    )  # fmt: skip
    attitude.refuse_whole_turns(largest)
    refuse_inner_earth(lowest)
    states = found.reshape(*lead, count, 10)
    latitude, longitude, altitude = (states[..., i].copy() for i in range(3))
    return Navigation(
        latitude, longitude, altitude, states[..., 3:6].copy(), states[..., 6:].copy()
    )


def covariances(
    covariance: FloatArray,
    transitions: FloatArray,
    noises: FloatArray,
    observation: FloatArray,
    spreads: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """As `driftlab.core.kalman.covariances`."""
    after = np.array(covariance, order="C")
    variances = np.empty((len(transitions), len(after)))
    given = map(np.ascontiguousarray, (transitions, noises, observation, spreads))
    if not kernels.covariances(after, *given, variances):
        raise np.linalg.LinAlgError("Singular matrix")  # as np.linalg.inv says
    return after, variances


def _runs(values: FloatArray, lead: tuple[int, ...]) -> FloatArray:
    """Arrays (..., a, b) as (r, a, b) without gaps: one run, or all that the axes come to."""
    if values.ndim == 2:
        return np.ascontiguousarray(values)[np.newaxis]
    if values.shape[:-2] != lead:
        values = np.broadcast_to(values, (*lead, *values.shape[-2:]))
    return np.ascontiguousarray(values).reshape(-1, *values.shape[-2:])
