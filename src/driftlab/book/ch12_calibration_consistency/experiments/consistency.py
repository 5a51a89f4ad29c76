"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

import numpy as np

from driftlab.book.ch11_kalman_calibration.experiments import TYPICAL_NOISE
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import TurntableTrial
from driftlab.imu import ImuNoise
from driftlab.monte_carlo import mean_square_bounds, run_batches
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

RUNS = 60
"""Calibrations whose errors and innovations are followed over time."""
SEED = 2018


def filter_consistency(
    runs: int = RUNS,
    scheme: Scheme = NINETEEN_POSITIONS,
    noise: ImuNoise = TYPICAL_NOISE,
    assumed_noise: ImuNoise | None = None,
    seed: int = SEED,
) -> DataTable:
    """Calibrate random units repeatedly, and compare the errors with what the filter states.

    The filter assumes the noise of the simulation unless `assumed_noise` is given.
    """
    table = TurntableTrial(
        scheme, noise=noise, assumed_noise=assumed_noise,
        sample_interval=0.1, update_interval=3.0, keep=7,
    )  # fmt: skip
    found = run_batches(table.run, runs, seed=seed, batch_size=runs)[0]
    size = found.calibration.model.size
    nis = found.calibration.nis
    innovations = nis.mean(axis=0) / 3
    low, high = (bound / 3 for bound in mean_square_bounds(3, runs))
    state_low, state_high = (bound / size for bound in mean_square_bounds(size, runs))
    updates = np.arange(1.0, nis.shape[-1] + 1) * table.update_interval
    inside = np.mean((innovations > low) & (innovations < high))
    return DataTable(
        {
            "state_time": (found.calibration.times, "min", "of the states"),
            "states_over_expected": (
                found.nees.mean(axis=0) / size, "", "squared normalised errors, mean over the runs"
            ),
            "innovation_time": (updates, "min", "of the innovations"),
            "innovations_over_expected": (innovations, "", "the same of the innovations"),
            "state_bound_low": ([state_low], "", "95 % of the values lie between the bounds"),
            "state_bound_high": ([state_high], "", "likewise"),
            "innovation_bound_low": ([low], "", "likewise"),
            "innovation_bound_high": ([high], "", "likewise"),
        },
        {
            "runs": (runs, "", "calibrations"),
            "size": (size, "", "states of the filter"),
            "innovation_mean": (nis.mean() / 3, "", "of all times and runs, over expected"),
            "innovation_mean_bounds": (
                [bound / 3 for bound in mean_square_bounds(3, nis.size)], "", "of this mean, 95 %"
            ),
            "inside": (inside, "", "part of the innovations inside their bounds"),
        },
    )  # fmt: skip
