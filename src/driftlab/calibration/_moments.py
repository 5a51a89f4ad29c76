"""Times along a rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array


def checked_moments(times: ArrayLike) -> FloatArray:
    """Times (k,) in s as one row of its own, refusing anything else."""
    moments = np.array(finite_array(times, "times"))
    if moments.ndim != 1:
        raise ValueError(f"times: expected shape (k,), got shape {moments.shape}.")
    return moments
