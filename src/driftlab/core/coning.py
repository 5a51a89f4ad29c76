"""What ideal gyros report on a coning motion."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray


def cone_increments(half_angle: FloatArray, around: FloatArray, phase: FloatArray) -> FloatArray:
    """Angle increments (..., 3) while the cone goes round by `around`, its phase halfway `phase`.

    All in rad. At phase zero the body leans by the half angle about its first axis.
    """
    # Differences of cosines and sines as products, which lose no digits.
    chord = 2 * np.sin(half_angle) * np.sin(around / 2)
    along = -2 * around * np.sin(half_angle / 2) ** 2
    parts = np.broadcast_arrays(-chord * np.sin(phase), chord * np.cos(phase), along)
    return np.stack(parts, axis=-1)
