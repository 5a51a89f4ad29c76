"""A record of five kinds of noise, and what its Allan deviation shows of them."""

from typing import NamedTuple

import numpy as np

from driftlab.allan import AllanDeviation, allan_deviation
from driftlab.noise_terms import NoiseTerms

SAMPLES = 4096
"""In a record, whatever its length."""
TIMES = np.geomspace(1e-2, 1e5, 120)
"""Averaging times of the lines, s."""


class SimulatedAllan(NamedTuple):
    """A simulated record's Allan deviation, and the noise that it was made of."""

    noise: NoiseTerms
    allan: AllanDeviation


def simulated_allan(noise: NoiseTerms, length: float, seed: int = 13) -> SimulatedAllan:
    """Simulate a gyro at rest for `length` seconds; averaging times go up to a quarter of it."""
    interval = length / SAMPLES
    rates = noise.samples(SAMPLES, interval, np.random.default_rng(seed))
    return SimulatedAllan(noise, allan_deviation(rates, interval))
