"""Plotnikov Fig. 2, simulated from its description: 26 restarts, and what their spread can say."""

from typing import Any, NamedTuple

import numpy as np
from scipy.constants import degree, hour

from driftlab.book.ch09_aligning_a_gyrocompass.experiments import WHITE, gyro_noise
from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture, long_table
from driftlab.book.scenarios import SARATOV_LATITUDE as LATITUDE
from driftlab.checks import FloatArray
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.noise import moving_average
from driftlab.gyrocompass.trials import most_range_over_deviation, normal_ranges
from driftlab.motion.vehicle import sensed_at_rest

RESTARTS = 26
WINDOW = 625
"""Samples of the moving average.

The paper says that 0.06 to 0.5 deg/h become 0.01 to 0.02. White noise and one window cannot do
both: the ratios are 6 and 25. A window of 625 samples takes 0.5 to 0.02; then 0.06 becomes 0.01
only because something slower than the window is left.
"""
PRINTED_SPREAD, PRINTED_DEVIATION = 0.3, 0.054
"""The paper's, degrees."""
TRIALS = 200_000
SEED = 26


class Restarts(NamedTuple):
    """A series of restarts, the noise of one of them, and ranges of normal samples."""

    heading: FloatArray  # (RESTARTS,), rad
    raw: FloatArray  # (n,), rad/s: the east gyro of the first restart, white noise of 0.5 deg/h
    averaged: FloatArray  # (n - WINDOW + 1,), rad/s
    deviations: FloatArray  # (2, 2), rad/s: before and after averaging, for each white noise
    ranges: FloatArray  # (TRIALS,): range over deviation of RESTARTS normal values


def compute() -> Restarts:
    """Switch a compass on again and again, and let it average before it aligns."""
    rng = np.random.default_rng(SEED)
    rate, force = sensed_at_rest([0.0, 0.0, 0.0, 1.0], LATITUDE)
    quiet = gyro_noise(WHITE[0]).samples(WINDOW, rng, RESTARTS, 3)
    heading = align(rate + quiet.mean(axis=-1), force).heading
    raw = gyro_noise(WHITE[1]).samples(10 * WINDOW, rng)
    closed = [
        [np.hypot(gyro.white, gyro.slow), gyro.deviation_of_mean(WINDOW)]
        for gyro in map(gyro_noise, WHITE)
    ]
    return Restarts(
        heading,
        raw,
        moving_average(raw, WINDOW),
        np.array(closed),
        normal_ranges(RESTARTS, TRIALS, rng),
    )


def columns(data: Restarts) -> dict[str, Any]:
    """Columns of the figure's CSV."""
    density, edges = np.histogram(data.ranges, np.arange(2.5, 7.3, 0.1), density=True)
    unit, rows = degree / hour, slice(None, None, 125)
    return long_table(
        {
            "heading, degrees over restart": (
                np.arange(1.0, RESTARTS + 1),
                np.degrees(data.heading).round(8),
            ),
            "mean rate, deg/h over last sample": (
                np.arange(len(data.averaged))[rows] + WINDOW - 1,
                (data.averaged[rows] / unit).round(8),
            ),
            "density over range in deviations": ((edges[1:] - 0.05).round(4), density.round(6)),
        }
    )


class RestartsPicture(Picture[Restarts]):
    """Restarts, noise before and after averaging, and the ratio of spread to deviation."""

    size = (10.5, 3.8)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.065, 0.14, 0.985, 0.91, wspace=0.27)
        first, second, third = self.panels
        first.set(xlabel="restart")
        first.set(ylabel="heading, degrees", ylim=(-0.25, 0.25))
        second.set(title="gyro noise, one restart", xlabel="time, minutes", ylabel="deg/h")
        third.set(title=f"range of {RESTARTS} values over deviation", xlabel="ratio")
        third.set(ylabel="probability density", xlim=(2.5, 7.3), ylim=(0, 1.6))

    def update(self, data: Restarts) -> None:
        first, second, third = self.panels
        heading = np.degrees(data.heading)
        first.plot(np.arange(1, RESTARTS + 1), heading, **SERIES[0], marker="o", markersize=4)
        first.set_title(
            f"{RESTARTS} restarts: spread {np.ptp(heading):.2f}°, "
            f"deviation {heading.std(ddof=1):.3f}°",
            fontsize=9,
            loc="left",
        )
        step = gyro_noise(WHITE[1]).interval / 60
        unit = degree / hour
        second.plot(step * np.arange(0, len(data.raw), 5), data.raw[::5] / unit, color=GREY,
                    linewidth=0.3, label="every fifth sample")  # fmt: skip
        second.plot(step * (np.arange(len(data.averaged)) + WINDOW - 1), data.averaged / unit,
                    color=BLACK, label=f"mean of {WINDOW}")  # fmt: skip
        second.legend(loc="upper right", fontsize=8)
        third.hist(data.ranges, 120, density=True, color=SERIES[6]["color"],
                   label="normal samples")  # fmt: skip
        ratio = PRINTED_SPREAD / PRINTED_DEVIATION
        third.axvline(ratio, **SERIES[1], label="printed: 0.3 over 0.054")
        third.axvspan(*rounding(), color=SERIES[1]["color"], alpha=0.15, label="within rounding")
        third.axvline(most_range_over_deviation(RESTARTS), **SERIES[4], label="largest possible")
        third.legend(loc="upper right", fontsize=7)


def rounding() -> tuple[float, float]:
    """Range over deviation of what could have been rounded to the printed numbers."""
    return (
        (PRINTED_SPREAD - 0.05) / (PRINTED_DEVIATION + 0.0005),
        (PRINTED_SPREAD + 0.05) / (PRINTED_DEVIATION - 0.0005),
    )
