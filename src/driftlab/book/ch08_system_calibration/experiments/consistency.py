"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond

from driftlab.calibration.simulation import TableTrial
from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.monte_carlo import mean_square_bounds, sweep
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES, Scheme

from .schemes import TYPICAL_NOISE

RUNS = 60
"""Calibrations whose errors and innovations are followed over time."""
SEED = 2018
QUICK_TRIAL = TableTrial(
    scheme=replace(NINETEEN_POSITIONS, dwell=63.0),
    sample_interval=0.25,
    update_interval=9.0,
    keep=10_000,
)
"""The nineteen positions with pauses half as long and few samples; only the end is kept."""


def quick_trial(
    scheme: str, installation: float, dwell: float = QUICK_TRIAL.scheme.dwell
) -> TableTrial:
    """Return `QUICK_TRIAL` on a scheme, for a spread of installation errors in arc seconds."""
    return replace(
        QUICK_TRIAL,
        scheme=replace(SCHEMES[scheme], dwell=dwell),
        prior=PriorDeviations(installation=installation * arcsecond),
    )


class FilterConsistency(NamedTuple):
    """Means over the runs, divided by what they should be."""

    runs: int  # calibrations
    size: int  # states of the filter
    times: FloatArray  # (k,), s
    states: FloatArray  # (k,), squared normalised errors of all states
    state_bounds: tuple[float, float]  # between them lie 95 % of the values
    innovation_times: FloatArray  # (u,), s
    innovations: FloatArray  # (u,), squared normalised innovations
    innovation_bounds: tuple[float, float]
    innovation_mean: float  # over all times as well
    innovation_mean_bounds: tuple[float, float]
    inside: float  # part of the innovations inside their bounds


def filter_consistency(
    runs: int = RUNS,
    scheme: Scheme = NINETEEN_POSITIONS,
    noise: ImuNoise = TYPICAL_NOISE,
    assumed_noise: ImuNoise | None = None,
    seed: int = SEED,
) -> FilterConsistency:
    """Calibrate random units repeatedly, and compare the errors with what the filter states.

    The filter assumes the noise of the simulation unless `assumed_noise` is given.
    """
    table = TableTrial(
        scheme, noise=noise, assumed_noise=assumed_noise,
        sample_interval=0.1, update_interval=3.0, keep=7,
    )  # fmt: skip
    found = sweep(table.run, runs, seed=seed, batch=runs)[0]
    size = found.calibration.model.size
    nis = found.calibration.nis
    innovations = nis.mean(axis=0) / 3
    low, high = (bound / 3 for bound in mean_square_bounds(3, runs))
    updates = np.arange(1.0, nis.shape[-1] + 1) * table.update_interval
    return FilterConsistency(
        runs,
        size,
        found.calibration.times,
        found.nees.mean(axis=0) / size,
        _each(mean_square_bounds(size, runs), size),
        updates,
        innovations,
        (low, high),
        float(nis.mean() / 3),
        _each(mean_square_bounds(3, nis.size), 3),
        float(np.mean((innovations > low) & (innovations < high))),
    )


def _each(bounds: tuple[float, float], freedom: int) -> tuple[float, float]:
    return bounds[0] / freedom, bounds[1] / freedom
