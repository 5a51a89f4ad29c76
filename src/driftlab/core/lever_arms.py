"""What a point beside the centre of rotation feels."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

from .vectors import cross_matrix


def lever_matrices(
    interval: float | FloatArray, angle: FloatArray, rate_change: FloatArray
) -> FloatArray:
    """Matrices (..., n, 3, 3) that give the velocity gained at an arm r over intervals (..., n).

    Integrals of ``[w' ×] + [w ×][w ×]``, from angle increments and changes of the rate
    (..., n, 3). The rate within an interval counts as constant in the second part: an error of
    second order.
    """
    turned = cross_matrix(angle)
    seconds = np.asarray(interval)[..., np.newaxis, np.newaxis]
    return cross_matrix(rate_change) + turned @ turned / seconds
