"""Allan deviation of ten million samples."""

from collections.abc import Iterator

import numpy as np

from driftlab.allan import allan_deviation

from .contenders import floors_here, those_here
from .measuring import Contender, Row

COUNT, INTERVAL = 10**7, 0.01
_HELD = [0, 15, -1]
"""Averaging times whose deviations are held against sums in longer numbers."""


def record(count: int) -> np.ndarray:
    """White noise on a bias, as of a gyro in rad/s."""
    return 1e-3 + 1e-4 * np.random.default_rng(7).normal(size=count)


def rows() -> Iterator[Row]:
    samples = record(COUNT)
    times = allan_deviation(samples, INTERVAL).averaging_times
    counts = np.round(times / INTERVAL).astype(int)
    exact = extended_deviations(samples, counts[_HELD])

    def error(found: np.ndarray) -> float:
        return float(np.abs(found[_HELD] / exact - 1).max())

    def allantools() -> Contender:
        import allantools as package

        def run() -> np.ndarray:
            return package.oadev(samples, rate=1 / INTERVAL, data_type="freq", taus=times)[1]

        return Contender("allantools.oadev, without intervals", run, error)

    peers, left_out = those_here({"allantools": allantools})
    copies, without = floors_here(samples)
    yield Row(
        "allan",
        f"overlapping Allan deviation of {COUNT} samples at {len(times)} times",
        Contender(
            "driftlab, with confidence intervals",
            lambda: allan_deviation(samples, INTERVAL).deviation,
            error,
        ),
        peers,
        copies,
        [],
        left_out + without,
        error_in="of the deviation",
        rounding=1e-9,
    )


def extended_deviations(samples: np.ndarray, counts: np.ndarray) -> np.ndarray:
    """The same by its definition, in NumPy's longest floating point."""
    sums = np.concatenate([[0], np.cumsum(samples.astype(np.longdouble))])
    found = []
    for m in counts:
        steps = sums[2 * m :] - 2 * sums[m:-m] + sums[: -2 * m]
        found.append(np.sqrt((steps**2).mean() / 2) / m)
    return np.array(found, dtype=float)
