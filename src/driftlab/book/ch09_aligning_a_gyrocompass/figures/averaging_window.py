"""How long to average before an alignment: white noise, a slow part, and the heading they leave."""

from typing import NamedTuple

import numpy as np
from scipy.constants import degree, hour

from driftlab.book.machinery.picture import SERIES, Picture
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.motion.vehicle import sensed_at_rest

from .alignment_budget import LATITUDE

WHITE = (0.06, 0.5)
"""Of a sample, deg/h: the ends of the paper's range."""
WINDOWS: tuple[int, ...] = (1, 3, 10, 36, 100, 300, 625, 2000, 6000, 20000)
"""Lengths of the mean, samples."""
RUNS = 200
SEED = 12
SLOW = 0.01
"""Of the slow part, deg/h; see `driftlab.book.ch10_gyrocompass_at_work.figures.restarts`."""


class AveragingWindow(NamedTuple):
    """By white noise and window: spread of the heading over many alignments."""

    windows: FloatArray  # (n,), samples
    simulated: FloatArray  # (2, n), rad
    formula: FloatArray  # (2, n), rad
    white_alone: FloatArray  # (2, n), rad


def noise(white: float, slow: float = SLOW) -> GyroNoise:
    """Noise of a gyro, from deg/h."""
    return GyroNoise(white * degree / hour, slow * degree / hour)


def compute() -> AveragingWindow:
    """Align with means of the gyros over windows of several lengths."""
    rng = np.random.default_rng(SEED)
    rate, force = sensed_at_rest([0.0, 0.0, 0.0, 1.0], LATITUDE)
    level = EARTH_RATE * np.cos(LATITUDE)
    simulated = np.empty((len(WHITE), len(WINDOWS)))
    formula, white_alone = np.empty_like(simulated), np.empty_like(simulated)
    for i, white in enumerate(WHITE):
        sums = np.cumsum(noise(white).samples(max(WINDOWS), rng, RUNS, 3), axis=-1)
        for j, window in enumerate(WINDOWS):
            means = sums[..., window - 1] / window
            simulated[i, j] = np.std(align(rate + means, force).heading)
            formula[i, j] = noise(white).deviation_of_mean(window) / level
            white_alone[i, j] = noise(white, 0.0).deviation_of_mean(window) / level
    return AveragingWindow(np.array(WINDOWS, float), simulated, formula, white_alone)


def columns(data: AveragingWindow) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees."""
    table = {"samples": data.windows}
    for i, white in enumerate(WHITE):
        for name in ("simulated", "formula", "white_alone"):
            values = np.degrees(getattr(data, name)[i])
            table[f"{name}_deg, white noise {white} deg/h"] = values.round(8)
    return table


class AveragingWindowPicture(Picture[AveragingWindow]):
    """Two families of curves on logarithmic axes."""

    size = (9.0, 3.9)

    def build(self) -> None:
        self.panel = self.figure.subplots()
        self.figure.subplots_adjust(0.085, 0.14, 0.985, 0.92)
        self.panel.set(xscale="log", yscale="log", xlim=(0.9, 22000), ylim=(0.004, 5))
        self.panel.set(xlabel="samples in the mean (ten a second)", ylabel="heading, degrees")
        self.panel.set_title(f"spread of the heading of {RUNS} alignments")

    def update(self, data: AveragingWindow) -> None:
        for i, white in enumerate(WHITE):
            style = SERIES[i]
            self.panel.plot(
                data.windows, np.degrees(data.simulated[i]), color=style["color"],
                marker="os"[i], linestyle="none",
                label=f"simulated, {white:g} deg/h a sample",
            )  # fmt: skip
            self.panel.plot(
                data.windows, np.degrees(data.formula[i]), **style,
                label=f"formula, with a slow part of {SLOW:g} deg/h",
            )  # fmt: skip
            self.panel.plot(
                data.windows, np.degrees(data.white_alone[i]), color=style["color"],
                linestyle=(":", (0, (1, 4)))[i], linewidth=1.0, label="formula, white noise alone",
            )  # fmt: skip
        self.panel.legend(loc="upper right", fontsize=8)
