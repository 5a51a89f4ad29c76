"""One calibration of the typical unit by the 27-state filter, and what it says of each error."""

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.machinery.figure.data_table import UNITS, DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import ERROR_MODELS, TurntableTrial
from driftlab.calibration.simulation import Trial
from driftlab.checks import whole_number
from driftlab.imu import TYPICAL_ERRORS, ImuErrors, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES, Scheme

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
STATE_UNITS = {
    "gyro bias": "deg_per_h", "gyro scale": "ppm", "gyro": "arcsec",
    "accelerometer bias": "ug", "accelerometer scale": "ppm", "accelerometer": "arcsec",
}  # fmt: skip
"""Beginning of a state's name, and its unit in `UNITS`; the first that fits."""
UNIT_NAMES = {"deg_per_h": "deg/h", "arcsec": "arc seconds", "ug": "µg"}


def state_unit(name: str) -> str:
    """Return the unit, one of `UNITS`, in which a sensor error is usually given."""
    return next(unit for start, unit in STATE_UNITS.items() if name.startswith(start))


def unit_of(name: str) -> tuple[float, str]:
    """Size in SI and name of the unit in which a sensor error is usually given."""
    unit = state_unit(name)
    return UNITS[unit][0], UNIT_NAMES.get(unit, unit)


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
    table = TurntableTrial(scheme, latitude, frame, sample_interval=0.1, keep=6)
    rng = np.random.default_rng(whole_number(seed, "seed", least=0))
    return table.run(rng, imu_errors=imu_errors)


def calibration_history(
    parameter: str = "gyro bias x", frame: str = "averaged", minute: float = 40.0
) -> DataTable:
    """Return the history of one sensor error in the calibration of the typical unit.

    The gyros must fix the body axes; the facts are those of the moment nearest to `minute`.
    """
    if parameter not in PARAMETERS:
        raise ValueError(f"parameter: expected one of {', '.join(PARAMETERS)}, got {parameter!r}.")
    found = typical_trial(frame)
    model, calibration = ERROR_MODELS[frame], found.calibration
    state = 6 + PARAMETERS.index(parameter)
    estimate, deviation = calibration.state[:, state], calibration.standard_deviations[:, state]
    true = float(estimate[-1] + found.errors[-1, state])
    error = true - estimate
    table = TurntableTrial(frame=frame)
    before = np.sqrt(model.covariance(table.prior, table.scheme.start_attitude)[state, state])
    at = int(np.abs(calibration.times / 60 - minute).argmin())
    name = model.names[state]
    unit = state_unit(name)
    return DataTable(
        {
            "time": (calibration.times, "min", "since the start"),
            "error": (error, unit, "true value less estimate"),
            "error_over_before": (
                np.abs(error) / before, "", "size of the error, in deviations known before"
            ),
            "bound_over_before": (3 * deviation / before, "", "three deviations, likewise"),
            "error_over_deviation": (error / deviation, "", "error, in deviations stated"),
        },
        {
            "name": (name, "", "in these body axes"),
            "error_now": (error[at], unit, "error at this moment"),
            "true": (true, unit, "true"),
            "estimate": (estimate[at], unit, "estimate"),
            "three_deviations": (3 * deviation[at], unit, "three deviations"),
            "moment": (calibration.times[at], "min", "moment"),
        },
    )  # fmt: skip


def calibration_errors(
    imu_errors: ImuErrors = TYPICAL_ERRORS,
    scheme: Scheme = NINETEEN_POSITIONS,
    frame: str = "averaged",
    latitude: float = TABLE_LATITUDE,
    seed: int = SEED,
) -> DataTable:
    """Return the histories of all sensor errors in one calibration by the filter of 27 states."""
    found = trial_of(frame, imu_errors, scheme, latitude, seed)
    calibration = found.calibration
    names = calibration.model.names
    columns: dict[str, tuple[Any, ...]] = {"time": (calibration.times, "min", "since the start")}
    for i, name in enumerate(names[6:], 6):
        unit, three = state_unit(name), 3 * calibration.standard_deviations[:, i]
        columns[f"error, {name}"] = (np.abs(found.errors[:, i]), unit, "size")
        columns[f"three_deviations, {name}"] = (three, unit, "of the filter")
    return DataTable(columns, {
        "names": (names[6:], "", "of the sensor errors"),
        "positions": (scheme.positions, "", "pauses of the scheme"),
    })  # fmt: skip


QUICK_TRIAL = TurntableTrial(
    scheme=replace(NINETEEN_POSITIONS, dwell=63.0),
    sample_interval=0.25,
    update_interval=9.0,
    keep=10_000,
)
"""The nineteen positions with pauses half as long and few samples; only the end is kept."""


def quick_trial(
    scheme: str, installation: float, dwell: float = QUICK_TRIAL.scheme.dwell
) -> TurntableTrial:
    """Return `QUICK_TRIAL` on a scheme, for a spread of installation errors in arc seconds."""
    return replace(
        QUICK_TRIAL,
        scheme=replace(SCHEMES[scheme], dwell=dwell),
        prior=PriorStandardDeviations(installation=installation * arcsecond),
    )
