"""Yates's weighing against its rivals, with and without an offset common to all turns."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, finite_array, finite_number, positive_number, whole_number
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns

from .calibrations import AS_COPIED, error_matrix, yates_sigma
from .turns import SEED

METHODS = (
    "three axes, no weighing",
    "Yates, sum corrected by 3/2",
    "Yates, sum without a factor",
    "least squares",
    "least squares with offset",
)
SIGMA: FloatArray = np.array([0.0, 1e-3, 2e-3])
"""True sigma1, sigma2, sigma3."""
NOISE = 1e-6
"""Standard deviation of each turn estimate."""
OFFSET = 10e-6
"""Offset common to all turn estimates."""


def weighing_designs(
    runs: int = 20_000,
    seed: int = SEED,
    sigma: ArrayLike = SIGMA,
    noise: float = NOISE,
    offset: float = OFFSET,
) -> DataTable:
    """Monte Carlo over white noise on each turn estimate, equal for all axes."""
    count = whole_number(runs, "runs", least=2)
    sigmas, size = finite_array(sigma, "sigma", 3), positive_number(noise, "noise")
    common = finite_number(offset, "offset")
    rng = np.random.default_rng(seed)
    true = drift_coefficient(YATES_AXES, error_matrix(sigmas))
    noises = rng.normal(0.0, size, (count, 4))
    # Each sigma is linear in the four turn estimates.
    variance = (_estimates(np.eye(4)) ** 2).sum(axis=1).mean(axis=-1)
    columns: dict[str, tuple[Any, ...]] = {"method": (METHODS, "", "how the turns are combined")}
    for name, added in (("without_offset", 0.0), ("with_offset", common)):
        errors = _estimates(true + added + noises) - sigmas
        squares = (errors**2).mean(axis=-1) / size**2
        rms = np.sqrt(squares.mean(axis=-1))
        # The mean of squares is near normal over this many runs; its root divides by 2 rms.
        half_width = 1.96 * squares.std(axis=-1) / np.sqrt(count) / (2 * rms)
        bias = _estimates((true + added)[np.newaxis])[:, 0] - sigmas
        closed = np.sqrt(variance + (bias**2).mean(axis=-1) / size**2)
        columns |= {
            f"rms_{name}": (rms, "", "rms error of the three sigmas, divided by the noise"),
            f"rms_{name}_from": (rms - half_width, "", "its 95 % interval begins"),
            f"rms_{name}_to": (rms + half_width, "", "and ends"),
            f"expected_{name}": (closed, "", "the same in closed form"),
        }
    facts = {
        "runs": (count, "", "runs"),
        "offset": (common / size, "", "offset, divided by the noise"),
    }
    return DataTable(columns, facts)


def _estimates(turn_estimates: FloatArray) -> FloatArray:
    """Sigmas (method, runs, 3) by every method from four turn estimates (runs, 4)."""
    return np.stack([
        fit_turns(turn_estimates[:, :3], PAIR_AXES).sigma,
        yates_sigma(turn_estimates),
        yates_sigma(turn_estimates, AS_COPIED),
        fit_turns(turn_estimates, YATES_AXES).sigma,
        fit_turns(turn_estimates, YATES_AXES, "common").sigma,
    ])  # fmt: skip
