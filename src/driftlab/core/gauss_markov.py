"""First-order Gauss-Markov processes, sample by sample."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray


def gauss_markov(draws: FloatArray, kept: float) -> FloatArray:
    """Stationary process of variance one along the last axis, from independent normal numbers.

    `kept` is the correlation of one sample with the next.
    """
    from scipy.signal import lfilter  # takes a third of a second to be loaded

    # The first value has the spread of all; later ones forget it little by little.
    scaled = draws * np.where(np.arange(draws.shape[-1]), np.sqrt(1 - kept**2), 1.0)
    process: FloatArray = lfilter([1.0], [1.0, -kept], scaled, axis=-1)
    return process
