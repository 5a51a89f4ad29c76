"""Calibrated units navigate in place, with two choices of body axes; Wu Figs. 3-5."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond, hour

from driftlab.body_frames import body_frame_rotation
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.body_axes import attitude_of_axes, imu_errors_in_frame
from driftlab.calibration.static_navigation import StaticNavigationErrors, navigate_static
from driftlab.checks import FloatArray
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.imu import TYPICAL_ERRORS, ImuErrors, PriorDeviations
from driftlab.increments import compensate, measure
from driftlab.monte_carlo import sweep
from driftlab.motion.turntable import static_trajectory

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
ALL_STARTS = (STARTS[0], "its own sensors", "its own true axes", STARTS[1])
"""The same; the attitude that each computer finds from its own calibrated sensors; and the exact
attitude of each computer's own axes."""
AT_REST_SIZES = (40, 400)
"""Spreads of the installation errors of the units at rest, arc seconds."""
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


class InPlaceClaim(NamedTuple):
    """Error with averaged axes over that with usual axes, unit by unit.

    Attributes
    ----------
    ratios : dict of (int, str, str) to ndarray, shape (units,)
        By spread of the installation errors in `AT_REST_SIZES`, by start in `ALL_STARTS` and by
        quantity, ascending.
    """

    ratios: dict[tuple[int, str, str], FloatArray]


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
    return InPlaceClaim({
        (size, *key): ratios
        for size in AT_REST_SIZES
        for key, ratios in _ratios(size, units, seed).items()
    })  # fmt: skip


def _ratios(size: int, units: int, seed: int) -> dict[tuple[str, str], FloatArray]:
    """Ratios by start and quantity, for units with installation errors of one size."""
    table = replace(QUICK_TRIAL, prior=PriorDeviations(installation=size * arcsecond))
    trials = {
        frame: sweep(replace(table, frame=frame).run, units, seed=seed, batch=units)[0]
        for frame in FRAMES
    }
    sizes: dict[tuple[str, str, str], FloatArray] = {}
    for frame, trial in trials.items():
        found = trial.calibration.imu_errors
        one = _one_attitude(trial.imu_errors, trials["averaged"].calibration.imu_errors, frame)
        sensed = _self_aligned(trial.imu_errors, found)
        own = _own_axes(trial.imu_errors, frame)
        table_axes = np.broadcast_to(TABLE_ATTITUDE, own.shape)
        believed = (one, sensed, own, table_axes)
        wanted = (one, own, own, table_axes)
        for start, begin, axes in zip(ALL_STARTS, believed, wanted, strict=True):
            run = navigate_static(
                trial.imu_errors, found, TABLE_ATTITUDE, start=begin, reference=axes,
                latitude=TABLE_LATITUDE, duration=REST_DURATION,
                interval=5.0, output_interval=300.0,
            )  # fmt: skip
            for quantity in QUANTITIES:
                squares = (getattr(run, quantity) ** 2).sum(axis=-1)
                sizes[frame, start, quantity] = np.sqrt(squares.mean(axis=-1))
    averaged, usual = FRAMES
    return {
        (start, quantity): np.sort(sizes[averaged, start, quantity] / sizes[usual, start, quantity])
        for start in ALL_STARTS
        for quantity in QUANTITIES
    }


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


def _self_aligned(imu_errors: ImuErrors, found: ImuErrors) -> FloatArray:
    """Attitude (..., 4) that a computer finds from gravity and the Earth's rate, without noise."""
    still = static_trajectory(TABLE_ATTITUDE, TABLE_LATITUDE, 1.0, 2).increments
    sensed = compensate(measure(still, imu_errors), found)
    # `align` counts axes forward, up, right: y, z and x here.
    rate, force = (row.sum(axis=-2)[..., [1, 2, 0]] for row in (sensed.angle, sensed.velocity))
    angles = align(rate, force)
    return from_euler_angles(angles.heading, angles.pitch, angles.roll)[..., [2, 0, 1, 3]]
