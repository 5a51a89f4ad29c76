"""Angle increments of random motions about three axes, smooth and without any period."""

import numpy as np

from driftlab.checks import FloatArray

WAVES = 6
"""Sines in each component of the rate."""
FREQUENCIES = (0.1, 1.0)
"""Lowest and highest of these sines, Hz."""
WAVE_RATE = 0.5
"""Standard deviation of the amplitude of one sine, rad/s."""


def random_increments(
    rng: np.random.Generator, motions: int, count: int, interval: float
) -> FloatArray:
    """Integrals (motions, count, 3) of random body rates over equal intervals, rad."""
    shape = (motions, 1, WAVES, 3)
    lowest, highest = np.log(FREQUENCIES)
    frequency = 2 * np.pi * np.exp(rng.uniform(lowest, highest, size=shape))
    amplitude = WAVE_RATE * rng.standard_normal(shape)
    phase = rng.uniform(0, 2 * np.pi, size=shape)
    middle = interval * (np.arange(count) + 0.5)[:, np.newaxis, np.newaxis]
    # Each sine is integrated over the interval around its middle, exactly.
    chord = 2 * np.sin(frequency * interval / 2) / frequency
    increments: FloatArray = (amplitude * chord * np.sin(frequency * middle + phase)).sum(axis=-2)
    return increments
