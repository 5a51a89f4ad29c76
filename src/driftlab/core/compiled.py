"""The loops of `driftlab.core.loops` by Numba.

They take and return what those of the same name in NumPy do, arrays of any leading axes; the
kernels have one leading axis and no gaps.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from . import _filter_kernels, _kernels, attitude, kalman
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
    lead = _lead(first[..., np.newaxis, :], increments)
    begun, rows = _runs(first[..., np.newaxis, :], lead), _runs(increments, lead)
    found = np.empty((*lead, (increments.shape[-2] - past) // algorithm.samples, 4))
    stage = _STAGES.index(algorithm.last_stage)
    largest = _kernels.attitudes(
        begun, rows, algorithm.samples, algorithm.memory, past, algorithm.pairs,
        algorithm.weights, algorithm.starts, stage, _runs(found, lead),
    )  # fmt: skip
    attitude.refuse_whole_turns(largest)
    return found


def cumulative_product(quaternions: FloatArray) -> FloatArray:
    """As `driftlab.core.quaternion.cumulative_product`."""
    rows = _runs(quaternions, quaternions.shape[:-2])
    found = np.empty(rows.shape)
    _kernels.cumulative_product(rows, found)
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
    largest, lowest = _kernels.navigate(
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


def predict(covariance: FloatArray, transition: FloatArray, noise: FloatArray) -> FloatArray:
    """As `driftlab.core.kalman.predict`."""
    if covariance.ndim == transition.ndim == noise.ndim == 2:
        return _filter_kernels.predict(covariance, transition, noise)
    lead = _lead(covariance, transition, noise)
    given = (_runs(each, lead) for each in (covariance, transition, noise))
    return _filter_kernels.predict_each(*given).reshape(*lead, *covariance.shape[-2:])


def correct_covariance(
    covariance: FloatArray, observation: FloatArray, noise: FloatArray
) -> tuple[FloatArray, NDArray[Any], NDArray[Any]]:
    """As `driftlab.core.kalman.correct_covariance`."""
    lead = _lead(covariance, observation, noise)
    given = (_runs(each, lead) for each in (covariance, observation, noise))
    *found, regular = _filter_kernels.correct_covariance_each(*given)
    if not regular:
        raise _singular()
    after, gain, weights = (each.reshape(*lead, *each.shape[1:]) for each in found)
    return after, gain, weights


def correct(
    covariance: FloatArray, innovation: FloatArray, observation: FloatArray, noise: FloatArray
) -> tuple[FloatArray, FloatArray, Any]:
    """As `driftlab.core.kalman.correct`."""
    if not (innovation.ndim == 1 and covariance.ndim == observation.ndim == noise.ndim == 2):
        return kalman.correct(covariance, innovation, observation, noise, correct_covariance)
    correction, after, nis, regular = _filter_kernels.correct(
        covariance, innovation, observation, noise
    )
    if not regular:
        raise _singular()
    return correction, after, np.float64(nis)


def _singular() -> np.linalg.LinAlgError:
    return np.linalg.LinAlgError("Singular matrix")  # as np.linalg.inv says


def _lead(*values: FloatArray) -> tuple[int, ...]:
    """Leading axes of arrays (..., a, b) together; sooner than NumPy where they are alike."""
    shapes = {each.shape[:-2] for each in values if each.ndim > 2}
    return np.broadcast_shapes(*shapes) if len(shapes) > 1 else shapes.pop() if shapes else ()


def _runs(values: FloatArray, lead: tuple[int, ...]) -> FloatArray:
    """Arrays (..., a, b) as (r, a, b) without gaps: one run, or all that the axes come to."""
    if values.ndim == 2:
        return np.ascontiguousarray(values)[np.newaxis]
    if values.shape[:-2] != lead:
        values = np.broadcast_to(values, (*lead, *values.shape[-2:]))
    return np.ascontiguousarray(values).reshape(-1, *values.shape[-2:])
