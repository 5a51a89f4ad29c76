"""What ideal gyros report on a coning motion, and how an algorithm corrects for it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from .quaternion import from_rotation_vector, multiply


class ConingSteps(NamedTuple):
    """An attitude algorithm with cross products g_i × g_j of increments, as numbers.

    A step is made of `samples` increments and `memory` more before it. `pairs` (p, 2) are the
    places i < j by rising j, `weights` (p,) those of the coning correction, `starts` (memory, p)
    those of the first steps. `last_stage` is as of `driftlab.attitude.Algorithm`.
    """

    samples: int
    memory: int
    last_stage: str
    pairs: NDArray[np.int64]
    weights: FloatArray
    starts: FloatArray

    def products(self, start: int | None = None) -> list[tuple[int, int, float]]:
        """Places i, j and weight of each product that counts; of a first step, if its number."""
        weights = self.weights if start is None else self.starts[start]
        rows = zip(self.pairs.tolist(), weights.tolist(), strict=True)
        return [(i, j, weight) for (i, j), weight in rows if weight]


def cone_increments(half_angle: FloatArray, around: FloatArray, phase: FloatArray) -> FloatArray:
    """Angle increments (..., 3) while the cone goes round by `around`, its phase halfway `phase`.

    All in rad. At phase zero the body leans by the half angle about its first axis.
    """
    # Differences of cosines and sines as products, which lose no digits.
    chord = 2 * np.sin(half_angle) * np.sin(around / 2)
    along = -2 * around * np.sin(half_angle / 2) ** 2
    parts = np.broadcast_arrays(-chord * np.sin(phase), chord * np.cos(phase), along)
    return np.stack(parts, axis=-1)


def step_drift(step: FloatArray, half_angle: FloatArray, step_angle: FloatArray) -> FloatArray:
    """Drift (...) of a step about the cone's axis, rad, from its quaternion (..., 4) at phase zero.

    `half_angle` and `step_angle`, how far the cone goes round in the step, are in rad.
    """
    axis = np.stack([np.zeros_like(step_angle), np.zeros_like(step_angle), step_angle], axis=-1)
    turned = multiply(step, from_rotation_vector(axis))
    sine = np.copysign(np.linalg.norm(turned[..., :3], axis=-1), along_axis(turned, half_angle))
    cosine = turned[..., 3]
    expected_sine, expected_cosine = np.sin(step_angle / 2), np.cos(step_angle / 2)
    # The difference of two half angles, without taking either.
    half = np.arctan2(
        sine * expected_cosine - cosine * expected_sine,
        cosine * expected_cosine + sine * expected_sine,
    )
    return np.remainder(2 * half + np.pi, 2 * np.pi) - np.pi


def along_axis(vector: FloatArray, half_angle: FloatArray) -> FloatArray:
    """Part (...) about the cone's axis, in the body at phase zero."""
    return np.asarray(np.sin(half_angle) * vector[..., 1] + np.cos(half_angle) * vector[..., 2])
