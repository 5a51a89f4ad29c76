"""Yates's weighing against its rivals, with and without an offset common to all turns."""

from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns

from .calibrations import AS_COPIED, triad_error, yates_sigma
from .turns import SEED

METHODS = (
    "three axes, no weighing",
    "Yates, sum corrected by 3/2",
    "Yates, sum as in the copy",
    "least squares",
    "least squares with offset",
)
SIGMA: FloatArray = np.array([0.0, 1e-3, 2e-3])
"""True sigma1, sigma2, sigma3."""
NOISE = 1e-6
"""Standard deviation of each turn estimate."""
OFFSET = 10e-6
"""Offset common to all turn estimates."""


class WeighingDesigns(NamedTuple):
    """Root mean square error of sigma1, sigma2, sigma3 together, in units of the noise.

    Attributes
    ----------
    measured : ndarray, shape (2, method)
        Without and with the offset, by the methods of `METHODS`.
    half_width : ndarray, shape (2, method)
        Of a 95 % interval of `measured`.
    expected : ndarray, shape (2, method)
        Closed form of the same.
    runs : int
    """

    measured: FloatArray
    half_width: FloatArray
    expected: FloatArray
    runs: int


def weighing_designs(runs: int = 20_000, seed: int = SEED) -> WeighingDesigns:
    """Monte Carlo over white noise on each turn estimate, equal for all axes.

    The true sigmas and the sizes of noise and offset are `SIGMA`, `NOISE` and `OFFSET`.

    Parameters
    ----------
    runs : int
    seed : int
        Of the noise.
    """
    rng = np.random.default_rng(seed)
    true = drift_coefficient(YATES_AXES, triad_error(SIGMA))
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
            yates_sigma(turn_estimates),
            yates_sigma(turn_estimates, AS_COPIED),
            fit_turns(turn_estimates, YATES_AXES).sigma,
            fit_turns(turn_estimates, YATES_AXES, "common").sigma,
        ]
    )


def _responses() -> FloatArray:
    """Linear response (method, 3, 4) of each sigma to each turn estimate."""
    return np.swapaxes(_estimates(np.eye(4)), -1, -2)
