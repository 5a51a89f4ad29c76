"""Accelerometer biases that vary, and a filter that takes them for constants."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.constants import g, micro

from driftlab.book.ch11_kalman_calibration.experiments import QUICK_TRIAL, STANDING
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import innovation_test
from driftlab.checks import whole_number
from driftlab.imu import ImuNoise

CORRELATION_TIME = 600.0
"""s"""
INSTABILITIES = tuple((micro * g * np.array([0.25, 0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0])).tolist())
"""Standard deviations of the varying parts, m/s^2."""
TABLES = {"1 cm/s": 1e-2, "0.1 mm/s": STANDING}


def varying_biases(
    instabilities: Sequence[float] = INSTABILITIES,
    units: int = 60,
    dwell: float = QUICK_TRIAL.scheme.dwell,
    seed: int = 5,
) -> DataTable:
    """Calibrate units with varying biases by filters of constants and of processes: a minute."""
    units = whole_number(units, "units", least=2)
    trial = replace(QUICK_TRIAL, scheme=replace(QUICK_TRIAL.scheme, dwell=dwell))
    squares, clean = [], []
    for velocity in TABLES.values():
        white = ImuNoise(reference_velocity=velocity)
        for modelled in (False, True):
            rows = []
            for size in instabilities:
                drawn = replace(
                    white,
                    accelerometer_bias_instability=size,
                    accelerometer_correlation_time=CORRELATION_TIME,
                )
                assumed = drawn if modelled else white
                runs = replace(trial, noise=drawn, assumed_noise=assumed).run(
                    np.random.default_rng(seed), units
                )
                verdicts = innovation_test(runs.calibration).verdict
                passed = np.mean(np.asarray(verdicts) == "consistent")
                rows.append((runs.nees[:, -1].mean() / runs.calibration.model.size, passed))
            squares.append([row[0] for row in rows])
            clean.append([row[1] for row in rows])
    names = tuple(f"{kind}, {name}" for name in TABLES for kind in ("constants", "with processes"))
    return DataTable(
        {
            "instability": (np.array(instabilities), "ug", "standard deviation, varying part"),
            "squares": (np.array(squares), "", "squared errors of the states, over expected",
                        names),
            "clean": (np.array(clean), "percent", "calibrations with clean innovations", names),
        },
        {"units": (units, "", "random units each")},
    )  # fmt: skip
