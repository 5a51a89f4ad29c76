"""A record of five kinds of noise, and what its Allan deviation shows of them."""

import numpy as np

from driftlab.allan import allan_deviation
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.noise_terms import NoiseTerms

SAMPLES = 4096
"""In a record, whatever its length."""
TIMES = np.geomspace(1e-2, 1e5, 120)
"""Averaging times of the lines, s."""


def simulated_allan(noise: NoiseTerms, length: float, seed: int = 13) -> DataTable:
    """Simulate a gyro at rest for `length` seconds; averaging times go up to a quarter of it."""
    interval = length / SAMPLES
    rates = noise.samples(SAMPLES, interval, np.random.default_rng(seed))
    found, unit = allan_deviation(rates, interval), "deg_per_h"
    return DataTable(
        {
            "line_time": (TIMES, "s", "averaging time"),
            "line": (noise.lines(TIMES), unit, "what each term makes"),
            "total": (noise.deviation(TIMES), unit, "what all terms make"),
            "time": (found.averaging_times, "s", "averaging time"),
            "deviation": (found.deviation, unit, "Allan deviation of the record"),
            "lower": (found.lower, unit, "lower end of its interval of 68 %"),
            "upper": (found.upper, unit, "upper end of its interval of 68 %"),
        },
        {
            "noise": (noise, "", "of which the record is made"),
            "degrees_of_freedom": (found.degrees_of_freedom, "", "of each Allan deviation"),
        },
    )
