"""Plotnikov Fig. 2, simulated from its description: 26 restarts, and what their spread can say."""

import numpy as np

from driftlab.book.ch13_finding_north.experiments import MOVING_AVERAGE, WHITE, gyro_noise
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, checked_instance, whole_number
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.motion.vehicle import static_imu

from .trials import (
    largest_range_over_standard_deviation,
    range_over_standard_deviation,
)

RESTARTS = 26
"""The paper's."""
PAPER_SPREAD, PAPER_DEVIATION = 0.3, 0.054
"""The paper's, degrees."""
TRIALS = 200_000
"""Samples of as many normal values."""
NOISES = (gyro_noise(WHITE[0]), gyro_noise(WHITE[1]))
"""The least and the most of the paper's range."""
SEED = 26
EVERY_FIFTH = slice(None, None, 5)
"""Samples of the noise that the figure shows."""


def restart_series(
    restarts: int = RESTARTS,
    noises: tuple[GyroNoise, GyroNoise] = NOISES,
    window: int = MOVING_AVERAGE,
    trials: int = TRIALS,
    latitude: float = SARATOV_LATITUDE,
    seed: int = SEED,
) -> DataTable:
    """Switch a compass on again and again, and let it average before it aligns."""
    restarts = whole_number(restarts, "restarts", least=2)
    rng = np.random.default_rng(whole_number(seed, "seed", least=0))
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], latitude)
    weak, strong = (checked_instance(each, GyroNoise, "noises") for each in noises)
    quiet = weak.samples(window, rng, restarts, 3)
    heading = align(rate + quiet.mean(axis=-1), force).heading
    raw = strong.samples(10 * window, rng)
    standard_deviations = np.array(
        [
            [np.hypot(each.white, each.gauss_markov), each.standard_deviation_of_mean(window)]
            for each in noises
        ]
    )
    sums = np.concatenate([[0.0], np.cumsum(raw)])
    averaged = (sums[window:] - sums[:-window]) / window
    ranges = range_over_standard_deviation(
        rng.standard_normal((whole_number(trials, "trials"), restarts))
    )
    density, edges = np.histogram(ranges, min(120, 10 + len(ranges) // 100), density=True)
    least, most = rounded_ratio_range()
    sampled = strong.interval * np.arange(len(raw))
    return DataTable(
        {
            "restart": (np.arange(1.0, restarts + 1), "", "counted from 1"),
            "aligned_heading": (heading, "deg", "with the weaker noise, averaged"),
            "sample_time": (sampled[EVERY_FIFTH], "min", "since the start"),
            "rate": (raw[EVERY_FIFTH], "deg_per_h", "stronger noise of one gyro"),
            "mean_time": (sampled[window - 1 :][EVERY_FIFTH], "min", "of a mean's last sample"),
            "mean_rate": (averaged[EVERY_FIFTH], "deg_per_h", "the same noise, averaged"),
            "range_over_standard_deviation": (
                (edges[1:] + edges[:-1]) / 2,
                "",
                "middle of a class",
            ),
            "density": (density, "", "of probability in the class"),
            "paper_range_over_deviation": ([PAPER_SPREAD / PAPER_DEVIATION], "", "of the paper"),
            "paper_ratio_rounded_from": ([least], "", "least that rounds to the paper's"),
            "paper_ratio_rounded_to": ([most], "", "largest that rounds to the paper's"),
            "largest_possible_ratio": (
                [largest_range_over_standard_deviation(restarts)],
                "",
                "of any values",
            ),
        },
        {
            "window": (window, "", "samples that are averaged"),
            "white": (np.array([weak.white, strong.white]), "deg_per_h", "noise of a sample"),
            "standard_deviations": (
                standard_deviations,
                "deg_per_h",
                "before and after averaging, by noise",
            ),
            "raw": (raw, "deg_per_h", "all samples of the stronger noise"),
            "ranges": (ranges, "", "over deviation, of as many normal values as restarts"),
            "edges": (edges, "", "of the classes of these"),
        },
    )


def rounded_ratio_range() -> tuple[float, float]:
    """Return the least and the largest ratio of spread to deviation that rounds to the paper's."""
    return (
        (PAPER_SPREAD - 0.05) / (PAPER_DEVIATION + 0.0005),
        (PAPER_SPREAD + 0.05) / (PAPER_DEVIATION - 0.0005),
    )


def spread_readings(ranges: FloatArray) -> dict[str, tuple[float, float]]:
    """Return what a spread of 0.3 degrees may mean: ratio to the deviation, and its probability.

    Probable is how often normal values have at least that ratio of range to deviation. Six
    deviations are not a range: any values have them.
    """
    least, _ = rounded_ratio_range()
    taken = PAPER_SPREAD / PAPER_DEVIATION
    ratios = {
        "largest minus least, 0.3/0.054": taken,
        "the same, 0.25 rounded up, over 0.054": (PAPER_SPREAD - 0.05) / PAPER_DEVIATION,
        "the same, 0.25 over 0.0545": least,
        "plus and minus 0.3, 0.6/0.054": 2 * taken,
    }
    readings = {name: (ratio, float(np.mean(ranges >= ratio))) for name, ratio in ratios.items()}
    return readings | {"six deviations, 0.324 in one digit": (6.0, 1.0)}
