"""Allan deviation of ten million samples."""

from collections.abc import Iterator

import numpy as np

from driftlab.allan import allan_deviation

from .measuring import Contender, Row, copy_of

COUNT, INTERVAL = 10**7, 0.01
HELD = [0, 15, -1]
"""Averaging times whose deviations are held against sums in extended precision."""


def rows() -> Iterator[Row]:
    # White noise on a bias, as of a gyro in rad/s.
    samples = 1e-3 + 1e-4 * np.random.default_rng(7).normal(size=COUNT)
    times = allan_deviation(samples, INTERVAL).averaging_times
    sums, exact = np.concatenate([[0], np.cumsum(samples.astype(np.longdouble))]), []
    for m in np.round(times[HELD] / INTERVAL).astype(int):
        steps = sums[2 * m :] - 2 * sums[m:-m] + sums[: -2 * m]
        exact.append(float(np.sqrt((steps**2).mean() / 2) / m))

    def error(found: np.ndarray) -> float:
        return float(np.abs(found[HELD] / exact - 1).max())

    def allantools() -> Contender:
        import allantools as package

        def run() -> np.ndarray:
            return package.oadev(samples, rate=1 / INTERVAL, data_type="freq", taus=times)[1]

        return Contender("allantools.oadev, without intervals", run, error)

    yield Row(
        f"overlapping Allan deviation of {COUNT} samples at {len(times)} times",
        Contender(
            "driftlab, with confidence intervals",
            lambda: allan_deviation(samples, INTERVAL).deviation,
            error,
        ),
        [allantools],
        [copy_of(samples)],
        error_in="of the deviation",
        rounding=1e-9,
    )
