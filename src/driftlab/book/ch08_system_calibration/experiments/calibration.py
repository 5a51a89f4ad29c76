"""One calibration of the typical unit by the 27-state filter, and what it says of each error."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.simulation import TableTrial, Trial
from driftlab.checks import FloatArray, whole_number
from driftlab.imu import TYPICAL_ERRORS, ImuErrors
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

SEED = 20180501
"""Of the noise, and of the table's error in setting up."""
PARAMETERS = (
    *(f"gyro bias {axis}" for axis in "xyz"),
    *(f"gyro scale {axis}" for axis in "xyz"),
    *(f"gyro off-diagonal {i}" for i in (1, 2, 3)),
    *(f"accelerometer bias {axis}" for axis in "xyz"),
    *(f"accelerometer scale {axis}" for axis in "xyz"),
    *(f"accelerometer off-diagonal {places}" for places in ("xy", "xz", "yx", "yz", "zx", "zy")),
)
"""The 21 sensor errors of a model whose axes the gyros fix. What the three off-diagonal entries
of the gyros are depends on the axes."""
UNITS = (
    ("gyro bias", degree / hour, "deg/h"),
    ("gyro scale", micro, "ppm"),
    ("gyro", arcsecond, "arc seconds"),
    ("accelerometer bias", micro * g, "µg"),
    ("accelerometer scale", micro, "ppm"),
    ("accelerometer", arcsecond, "arc seconds"),
)
"""Beginning of a state's name, its unit in SI, and the unit's name; the first that fits."""


def unit_of(name: str) -> tuple[float, str]:
    """Size in SI and name of the unit in which a sensor error is usually given."""
    return next((size, unit) for start, size, unit in UNITS if name.startswith(start))


class CalibrationRun(NamedTuple):
    """History of one sensor error; all values in SI units."""

    name: str  # as the error model calls it
    times: FloatArray  # (k,), s
    estimate: FloatArray  # (k,)
    true: float
    before: float  # standard deviation before the calibration
    deviation: FloatArray  # (k,), standard deviation that the filter states
    shown: int  # index of the moment whose numbers are wanted


class CalibrationErrors(NamedTuple):
    """Histories of all sensor errors, in states of the averaged axes and SI units."""

    names: tuple[str, ...]
    positions: int  # pauses of the scheme
    times: FloatArray  # (k,), s
    errors: FloatArray  # (k, 21), true value less estimate
    deviations: FloatArray  # (k, 21), standard deviations that the filter states


@lru_cache(maxsize=8)
def typical_trial(frame: str = "averaged") -> Trial:
    """Calibrate the typical unit on the nineteen positions; the same noise for each frame."""
    return _calibrated(frame, TYPICAL_ERRORS, NINETEEN_POSITIONS, TABLE_LATITUDE, SEED)


def trial_of(
    frame: str, imu_errors: ImuErrors, scheme: Scheme, latitude: float, seed: int
) -> Trial:
    """Calibrate a unit; `typical_trial` is kept for all figures and panels that show it."""
    if imu_errors is TYPICAL_ERRORS and (scheme, latitude, seed) == (
        NINETEEN_POSITIONS, TABLE_LATITUDE, SEED
    ):  # fmt: skip
        return typical_trial(frame)
    return _calibrated(frame, imu_errors, scheme, latitude, seed)


def _calibrated(
    frame: str, imu_errors: ImuErrors, scheme: Scheme, latitude: float, seed: int
) -> Trial:
    table = TableTrial(scheme, latitude, frame, sample_interval=0.1, keep=6)
    rng = np.random.default_rng(whole_number(seed, "seed", least=0))
    return table.run(rng, imu_errors=imu_errors)


def calibration_history(
    parameter: str = "gyro bias x", frame: str = "averaged", minute: float = 40.0
) -> CalibrationRun:
    """Return the history of one sensor error in the calibration of the typical unit.

    The gyros must fix the body axes; the moment nearest to `minute` is the one that is `shown`.
    """
    if parameter not in PARAMETERS:
        raise ValueError(f"parameter: expected one of {', '.join(PARAMETERS)}, got {parameter!r}.")
    found = typical_trial(frame)
    model = ERROR_MODELS[frame]
    state = 6 + PARAMETERS.index(parameter)
    calibration = found.calibration
    estimate = calibration.state[:, state]
    table = TableTrial(frame=frame)
    before = model.covariance(table.prior, table.scheme.start_attitude)
    return CalibrationRun(
        model.names[state],
        calibration.times,
        estimate,
        float(estimate[-1] + found.errors[-1, state]),
        float(np.sqrt(before[state, state])),
        calibration.deviations[:, state],
        int(np.abs(calibration.times / 60 - minute).argmin()),
    )


def calibration_errors(
    imu_errors: ImuErrors = TYPICAL_ERRORS,
    scheme: Scheme = NINETEEN_POSITIONS,
    frame: str = "averaged",
    latitude: float = TABLE_LATITUDE,
    seed: int = SEED,
) -> CalibrationErrors:
    """Return the histories of all sensor errors in one calibration by the filter of 27 states."""
    found = trial_of(frame, imu_errors, scheme, latitude, seed)
    calibration = found.calibration
    return CalibrationErrors(
        calibration.model.names[6:],
        scheme.positions,
        calibration.times,
        found.errors[:, 6:],
        calibration.deviations[:, 6:],
    )
