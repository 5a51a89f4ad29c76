"""Calibrated units navigate in place, with two choices of body axes; Wu Figs. 3-5."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.constants import hour
from scipy.stats import binomtest

from driftlab.body_frames import body_frame_rotation
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.body_axes import attitude_of_axes, imu_errors_in_frame
from driftlab.calibration.static_navigation import StaticNavigationErrors, navigate_static
from driftlab.checks import FloatArray
from driftlab.imu import TYPICAL_ERRORS, ImuErrors
from driftlab.monte_carlo import sweep

from .calibration import typical_trial
from .consistency import QUICK_TRIAL

REST_DURATION = 4 * hour
"""For which the units navigate, s."""
TABLE_ATTITUDE: FloatArray = np.array([0.0, 0.0, 0.0, 1.0])
"""Attitude in which the units stand: the table's axes are East, North, Up."""
FRAMES = {"averaged": "averaged axes", "upper triangle": "usual axes"}
"""Choices of body axes that are compared, with their names."""
STARTS = ("one attitude", "the table's axes")
"""What the computers take for their attitude at the start. One attitude: both believe the same of
the unit, each in its own axes."""
ALL_STARTS = (STARTS[0], "its own true axes", STARTS[1])
"""The same, and the exact attitude of each computer's own axes."""
QUANTITIES = ("attitude", "velocity", "position")
UNITS = 200
SEED = 345


class InPlaceErrors(NamedTuple):
    """Errors of the typical unit at rest.

    Attributes
    ----------
    runs : dict of (str, str) to StaticNavigationErrors
        By choice of body axes in `FRAMES` and by start in `STARTS`.
    """

    runs: dict[tuple[str, str], StaticNavigationErrors]


class Verdict(NamedTuple):
    """How often the averaged axes did better.

    Attributes
    ----------
    better, units : int
    interval : tuple of float
        Of 95 %, for the part of units that does better (Clopper and Pearson).
    median : float
        Of the ratios.
    """

    better: int
    units: int
    interval: tuple[float, float]
    median: float


class InPlaceClaim(NamedTuple):
    """Error with averaged axes over that with usual axes, unit by unit.

    Attributes
    ----------
    ratios : dict of (str, str) to ndarray, shape (units,)
        By start in `ALL_STARTS` and by quantity, ascending.
    """

    ratios: dict[tuple[str, str], FloatArray]


def errors_at_rest() -> InPlaceErrors:
    """Let the typical unit, as `typical_trial` found it, navigate for `REST_DURATION`."""
    found = {frame: typical_trial(frame).calibration.imu_errors for frame in FRAMES}
    runs = {}
    for frame, imu_errors in found.items():
        one = _one_attitude(TYPICAL_ERRORS, found["averaged"], frame)
        for start, axes in zip(STARTS, (one, TABLE_ATTITUDE), strict=True):
            runs[frame, start] = navigate_static(
                TYPICAL_ERRORS, imu_errors, TABLE_ATTITUDE, start=axes, reference=axes,
                latitude=TABLE_LATITUDE, duration=REST_DURATION,
            )  # fmt: skip
    return InPlaceErrors(runs)


def error_ratios_at_rest(units: int = UNITS, seed: int = SEED) -> InPlaceClaim:
    """Calibrate random units with both choices, on the same data, and let them navigate.

    The claim after Wu Figs. 3-5 is that the averaged axes deviate less.

    Parameters
    ----------
    units : int
        How many.
    seed : int
    """
    trials = {
        frame: sweep(replace(QUICK_TRIAL, frame=frame).run, units, seed=seed, batch=units)[0]
        for frame in FRAMES
    }
    sizes: dict[tuple[str, str, str], FloatArray] = {}
    for frame, trial in trials.items():
        one = _one_attitude(trial.imu_errors, trials["averaged"].calibration.imu_errors, frame)
        own = _own_axes(trial.imu_errors, frame)
        starts = (one, own, np.broadcast_to(TABLE_ATTITUDE, own.shape))
        for start, axes in zip(ALL_STARTS, starts, strict=True):
            run = navigate_static(
                trial.imu_errors, trial.calibration.imu_errors, TABLE_ATTITUDE,
                start=axes, reference=axes,
                latitude=TABLE_LATITUDE, duration=REST_DURATION,
                interval=5.0, output_interval=300.0,
            )  # fmt: skip
            for quantity in QUANTITIES:
                squares = (getattr(run, quantity) ** 2).sum(axis=-1)
                sizes[frame, start, quantity] = np.sqrt(squares.mean(axis=-1))
    averaged, usual = FRAMES
    return InPlaceClaim({
        (start, quantity): np.sort(
            sizes[averaged, start, quantity] / sizes[usual, start, quantity]
        )
        for start in ALL_STARTS
        for quantity in QUANTITIES
    })  # fmt: skip


def verdict(ratios: FloatArray) -> Verdict:
    """Count the units for which the averaged axes did better, from ratios (units,)."""
    better = int((ratios < 1).sum())
    interval = binomtest(better, len(ratios)).proportion_ci(0.95, "exact")
    return Verdict(
        better, len(ratios), (float(interval.low), float(interval.high)), float(np.median(ratios))
    )


def _own_axes(imu_errors: ImuErrors, frame: str) -> FloatArray:
    """Exact attitude (..., 4) of a unit's body axes while it stands in `TABLE_ATTITUDE`."""
    _, turn = imu_errors_in_frame(imu_errors, frame)
    return attitude_of_axes(TABLE_ATTITUDE, turn)


def _one_attitude(imu_errors: ImuErrors, found: ImuErrors, frame: str) -> FloatArray:
    """Attitude (..., 4) of body axes that says the same of a unit as that of its averaged axes.

    The way between the two is what the calibration has found in averaged axes; the true errors
    would bring in what it has left over.
    """
    own = _own_axes(imu_errors, "averaged")
    if frame == "averaged":
        return own
    turn = body_frame_rotation(found.gyro_error, found.accelerometer_error, frame)
    return attitude_of_axes(own, turn)
