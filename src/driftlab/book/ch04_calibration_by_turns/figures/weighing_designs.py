"""Yates's weighing against its rivals, with and without an offset common to all turns."""

from typing import Any, NamedTuple

import numpy as np

from driftlab.book.machinery.picture import BLACK, BLUE, ORANGE, Picture
from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import (
    PAIR_AXES,
    YATES_AXES,
    fit_turns,
    weighing,
)

METHODS = (
    "three axes, no weighing",
    "Yates, sum corrected by 3/2",
    "Yates, sum as printed",
    "least squares",
    "least squares with offset",
)
SIGMA: FloatArray = np.array([0.0, 1e-3, 2e-3])
NOISE = 1e-6
OFFSET = 10e-6


class WeighingDesigns(NamedTuple):
    """Root mean square error of sigma1, sigma2, sigma3 together, in units of the noise."""

    measured: FloatArray  # (2, method): without and with the offset
    half_width: FloatArray  # (2, method): of a 95 % interval
    expected: FloatArray  # (2, method): closed form
    runs: int


def compute(runs: int = 20_000, seed: int = 1987) -> WeighingDesigns:
    """Monte Carlo over white noise on each turn estimate, equal for all axes.

    The true sigmas and the sizes of noise and offset are the module's `SIGMA`, `NOISE`, `OFFSET`.
    """
    rng = np.random.default_rng(seed)
    s1, s2, s3 = SIGMA
    true = drift_coefficient(YATES_AXES, np.array([[0, s1, s2], [s1, 0, s3], [s2, s3, 0]]))
    noise = rng.normal(0.0, NOISE, (runs, 4))
    measured, half_width, expected = np.empty((3, 2, len(METHODS)))
    for row, offset in enumerate((0.0, OFFSET)):
        errors = _estimates(true + offset + noise) - SIGMA
        squares = (errors**2).mean(axis=-1) / NOISE**2
        rms = np.sqrt(squares.mean(axis=-1))
        measured[row] = rms
        # The mean of squares is near normal over this many runs; its root divides by 2 rms.
        half_width[row] = 1.96 * squares.std(axis=-1) / np.sqrt(runs) / (2 * rms)
        bias = _estimates((true + offset)[np.newaxis])[:, 0] - SIGMA
        variance = (_responses() ** 2).sum(axis=-1).mean(axis=-1)
        expected[row] = np.sqrt(variance + (bias**2).mean(axis=-1) / NOISE**2)
    return WeighingDesigns(measured, half_width, expected, runs)


def _estimates(turn_estimates: FloatArray) -> FloatArray:
    """Sigmas (method, runs, 3) by every method from four turn estimates (runs, 4)."""
    return np.stack(
        [
            fit_turns(turn_estimates[:, :3], PAIR_AXES).sigma,
            weighing(turn_estimates * [1, 1, 1, 1.5]),
            weighing(turn_estimates),
            fit_turns(turn_estimates, YATES_AXES).sigma,
            fit_turns(turn_estimates, YATES_AXES, "common").sigma,
        ]
    )


def _responses() -> FloatArray:
    """Linear response (method, 3, 4) of each sigma to each turn estimate."""
    return np.swapaxes(_estimates(np.eye(4)), -1, -2)


def columns(data: WeighingDesigns) -> dict[str, Any]:
    """Columns of the figure's CSV: one row a method."""
    names = ("without_offset", "with_offset")
    table: dict[str, Any] = {"method": METHODS}
    for i, name in enumerate(names):
        table |= {f"rms_{name}": data.measured[i], f"expected_{name}": data.expected[i]}
    return table


class WeighingDesignsPicture(Picture[WeighingDesigns]):
    """Two marks a method, with the closed form beside them; drawn once."""

    size = (9.0, 3.6)

    def build(self) -> None:
        self.axes = self.figure.subplots()
        self.figure.subplots_adjust(0.24, 0.15, 0.98, 0.9)
        self.axes.set(title="root mean square error of the three sigmas", xscale="log")
        self.axes.set(xlabel="error in units of the noise of one turn estimate")
        self.axes.set_yticks(range(len(METHODS)), METHODS)
        self.axes.invert_yaxis()

    def update(self, data: WeighingDesigns) -> None:
        rows = np.arange(len(METHODS))
        styles = (
            ("no offset", BLUE, "o", -0.12),
            (f"common offset, {OFFSET / NOISE:.0f} times the noise", ORANGE, "s", 0.12),
        )
        for i, (label, colour, marker, shift) in enumerate(styles):
            self.axes.errorbar(
                data.measured[i],
                rows + shift,
                xerr=data.half_width[i],
                color=colour,
                marker=marker,
                linestyle="none",
                label=label,
            )
            closed = "closed form" if i else None
            self.axes.plot(
                data.expected[i], rows + shift, "|", color=BLACK, markersize=14, label=closed
            )
        self.axes.legend(loc="upper right")
