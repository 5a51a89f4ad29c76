"""What ideal gyros report on a coning motion, and how an algorithm corrects for it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray


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
