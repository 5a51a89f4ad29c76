"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond

from driftlab.body_frames import BODY_FRAMES
from driftlab.calibration.simulation import TableTrial
from driftlab.checks import FloatArray
from driftlab.imu import PriorDeviations
from driftlab.monte_carlo import mean_square_bounds, sweep
from driftlab.motion.scheme import NINETEEN_POSITIONS

RUNS = 60
"""Calibrations whose errors and innovations are followed over time."""
RUNS_BY_FRAME = 100
"""Calibrations for each choice of body axes and each spread of the installation errors."""
SEED = 2018
INSTALLATION_ERRORS: FloatArray = np.array([40.0, 100.0, 200.0, 400.0]) * arcsecond
"""Spreads of the installation errors, rad."""
QUICK_TRIAL = TableTrial(
    scheme=replace(NINETEEN_POSITIONS, dwell=63.0),
    sample_interval=0.25,
    update_interval=9.0,
    keep=10_000,
)
"""The nineteen positions with pauses half as long and few samples; only the end is kept."""


class FilterConsistency(NamedTuple):
    """Means over the runs, divided by what they should be.

    Attributes
    ----------
    times : ndarray, shape (k,)
        s.
    states : ndarray, shape (k,)
        Squared normalised errors of the 27 states.
    state_bounds : tuple of float
        Between them lie 95 % of the values.
    innovation_times : ndarray, shape (u,)
        s.
    innovations : ndarray, shape (u,)
        Squared normalised innovations.
    innovation_bounds : tuple of float
    innovation_mean : float
        Over all times as well.
    innovation_mean_bounds : tuple of float
    inside : float
        Part of the innovations inside their bounds.
    sizes : ndarray, shape (m,)
        Spreads of the installation errors, rad.
    by_frame : ndarray, shape (4, m)
        States at the end of a quick calibration, by choice of body axes.
    """

    times: FloatArray
    states: FloatArray
    state_bounds: tuple[float, float]
    innovation_times: FloatArray
    innovations: FloatArray
    innovation_bounds: tuple[float, float]
    innovation_mean: float
    innovation_mean_bounds: tuple[float, float]
    inside: float
    sizes: FloatArray
    by_frame: FloatArray


def filter_consistency(runs: int = RUNS, seed: int = SEED) -> FilterConsistency:
    """Calibrate random units again and again, and compare the errors with what the filter states.

    Parameters
    ----------
    runs : int
        Calibrations that are followed over time.
    seed : int
    """
    table = TableTrial(sample_interval=0.1, update_interval=3.0, keep=7)
    found = sweep(table.run, runs, seed=seed, batch=runs)[0]
    size = found.calibration.model.size
    nis = found.calibration.nis
    innovations = nis.mean(axis=0) / 3
    low, high = (bound / 3 for bound in mean_square_bounds(3, runs))
    by_frame = np.empty((len(BODY_FRAMES), len(INSTALLATION_ERRORS)))
    for i, frame in enumerate(BODY_FRAMES):
        for j, prior in enumerate(INSTALLATION_ERRORS):
            quick = replace(
                QUICK_TRIAL, frame=frame, prior=PriorDeviations(installation=float(prior))
            )
            # The same units and noise for each choice of axes.
            last = sweep(quick.run, RUNS_BY_FRAME, seed=seed, batch=RUNS_BY_FRAME)[0]
            by_frame[i, j] = last.nees[:, -1].mean() / size
    updates = np.arange(1.0, nis.shape[-1] + 1) * table.update_interval
    return FilterConsistency(
        found.calibration.times,
        found.nees.mean(axis=0) / size,
        _each(mean_square_bounds(size, runs), size),
        updates,
        innovations,
        (low, high),
        float(nis.mean() / 3),
        _each(mean_square_bounds(3, nis.size), 3),
        float(np.mean((innovations > low) & (innovations < high))),
        INSTALLATION_ERRORS,
        by_frame,
    )


def _each(bounds: tuple[float, float], freedom: int) -> tuple[float, float]:
    return bounds[0] / freedom, bounds[1] / freedom
