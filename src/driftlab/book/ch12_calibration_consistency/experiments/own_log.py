"""A log from a table that does not move, with one reference velocity after another."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import ERROR_MODELS, calibrate, innovation_test
from driftlab.imu import TYPICAL_ERRORS, ImuNoise, PriorStandardDeviations
from driftlab.increments import measure
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme
from driftlab.motion.turntable import turntable_trajectory

QUICK_TABLE = replace(NINETEEN_POSITIONS, dwell=30.0)
ASSUMED = tuple((10.0 ** np.linspace(-5.5, -1.5, 17)).tolist())
"""Reference velocities, m/s."""
BIASES = tuple(f"accelerometer bias {axis}" for axis in "xyz")


def assumed_noise(
    velocities: Sequence[float] = ASSUMED,
    scheme: Scheme = QUICK_TABLE,
    latitude: float = TABLE_LATITUDE,
    seed: int = 3,
) -> DataTable:
    """Calibrate one log with each assumed reference velocity; in truth its table does not move."""
    path = turntable_trajectory(scheme, latitude, interval=0.25)
    log = measure(path.increments, TYPICAL_ERRORS, ImuNoise(), np.random.default_rng(seed))
    model = ERROR_MODELS["averaged"]
    at = [model.names.index(name) for name in BIASES]
    tests, errors, stated = [], [], []
    for velocity in velocities:
        found = calibrate(
            log,
            latitude=latitude,
            start=scheme.start_attitude,
            model=model,
            prior=PriorStandardDeviations(),
            noise=ImuNoise(reference_velocity=velocity),
            update_interval=10.0,
            check=False,
        )
        tests.append(innovation_test(found))
        errors.append(np.abs(found.state[-1, at] - TYPICAL_ERRORS.accelerometer_bias).max())
        stated.append(found.standard_deviations[-1, at].max())
    return DataTable(
        {
            "reference_velocity": (np.array(velocities), "mm_per_s", "that the filter assumes"),
            "squares": (
                np.array([test.squares for test in tests]),
                "",
                "innovations, over expected",
            ),
            "correlation": (np.array([test.correlation for test in tests]), "", "of neighbours"),
            "stated": (np.array(stated), "ug", "largest 1σ of the three accelerometer biases"),
            "error": (np.array(errors), "ug", "largest error of the three"),
            "squares_low": ([float(tests[0].lower)], "", "of a right filter"),
            "squares_high": ([float(tests[0].upper)], "", "likewise"),
        }
    )
