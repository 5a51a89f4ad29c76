"""One calibration of the typical unit by the 27-state filter, and what it says of each error."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro

from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.simulation import TableTrial, Trial
from driftlab.checks import FloatArray
from driftlab.imu import TYPICAL_ERRORS

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
    """History of one sensor error; all values in SI units.

    Attributes
    ----------
    name : str
        As the error model calls it.
    times : ndarray, shape (k,)
        s.
    estimate : ndarray, shape (k,)
    true : float
    before : float
        Standard deviation before the calibration.
    deviation : ndarray, shape (k,)
        Standard deviation that the filter states.
    shown : int
        Index of the moment whose numbers are wanted.
    """

    name: str
    times: FloatArray
    estimate: FloatArray
    true: float
    before: float
    deviation: FloatArray
    shown: int


class CalibrationErrors(NamedTuple):
    """Histories of all sensor errors, in states of the averaged axes and SI units.

    Attributes
    ----------
    names : tuple of str
    times : ndarray, shape (k,)
        s.
    errors : ndarray, shape (k, 21)
        True value less estimate.
    deviations : ndarray, shape (k, 21)
        Standard deviations that the filter states.
    """

    names: tuple[str, ...]
    times: FloatArray
    errors: FloatArray
    deviations: FloatArray


@lru_cache(maxsize=8)
def typical_trial(frame: str = "averaged") -> Trial:
    """Calibrate the typical unit on the nineteen positions; the same noise for each frame."""
    table = TableTrial(frame=frame, sample_interval=0.1, keep=6)
    return table.run(np.random.default_rng(SEED), imu_errors=TYPICAL_ERRORS)


def calibration_history(
    parameter: str = "gyro bias x", frame: str = "averaged", minute: float = 40.0
) -> CalibrationRun:
    """Return the history of one sensor error in the calibration of the typical unit.

    Parameters
    ----------
    parameter : str
        One of `PARAMETERS`.
    frame : str
        Choice of body axes, one that the gyros fix.
    minute : float
        The history's moment nearest to it is `CalibrationRun.shown`, minutes.

    Raises
    ------
    ValueError
        If `parameter` is not one of `PARAMETERS`.
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


def calibration_errors() -> CalibrationErrors:
    """Return the histories of all sensor errors in the calibration with averaged axes."""
    found = typical_trial("averaged")
    calibration = found.calibration
    return CalibrationErrors(
        calibration.model.names[6:],
        calibration.times,
        found.errors[:, 6:],
        calibration.deviations[:, 6:],
    )
