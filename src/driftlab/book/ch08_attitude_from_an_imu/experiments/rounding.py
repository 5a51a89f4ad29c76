"""Gyros that round to a last digit."""

import numpy as np

from driftlab.checks import FloatArray


def rounded(
    increments: FloatArray, quantum: float, start: FloatArray, *, carry: bool
) -> FloatArray:
    """Increments (..., n, 3) as whole multiples of a quantum.

    The counter begins with the angle `start` (..., 3). With `carry` what is cut off counts for the
    next increment, as in a counter that runs on; otherwise each increment is rounded by itself.
    """
    if not carry:
        return np.broadcast_to(
            quantum * np.round(increments / quantum), (*start.shape[:-1], *increments.shape)
        )
    reached = np.concatenate([np.zeros((1, 3)), np.cumsum(increments, axis=0)])
    return np.diff(quantum * np.round((reached + start[..., np.newaxis, :]) / quantum), axis=-2)
