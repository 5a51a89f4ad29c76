"""In which body axes is the neglected second order least? In the error equations, and in filters.

The error equations are compared with a nonlinear navigation; a filter shows what it neglects in its
squared errors. It depends on where the equations are linearised, and on which triad is built worse.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcsecond

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import (
    ERROR_MODELS,
    FULL,
    TurntableTrial,
    attitude_error,
    attitude_of_axes,
    calibrate,
    imu_errors_in_frame,
    nees,
)
from driftlab.calibration.error_dynamics import (
    free_transition,
    process_noise,
    transition_of_increments,
)
from driftlab.calibration.error_model import ErrorModel
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.core import kalman, loops
from driftlab.imu import ImuErrors, PriorStandardDeviations, random_imu_errors
from driftlab.increments import Increments, compensate, measure
from driftlab.monte_carlo import run_batches
from driftlab.motion.scheme import SCHEMES
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import from_rotation_vector, multiply
from driftlab.strapdown import ALGORITHM, Navigation, final_state, stationary_state

from .consistency import QUICK_TRIAL, quick_trial
from .verdicts import verdict

UNITS = 600
"""Units in each case: the same ones, with the same noise, for each choice of axes."""
BATCH = 100
"""Units at once; the first batch is the same however many follow."""
SEED = 2018
MOUNTINGS = ("gyros built worse", "both alike", "accelerometers built worse")
EQUATIONS = (
    "own path, velocity", "own path, attitude", "table's path, velocity", "table's path, attitude",
)  # fmt: skip
"""What the error equations leave out, linearised about which path."""
WAYS = (
    *EQUATIONS, "open loop", "fed back, table's path", "fed back, re-linearised", "second pass",
)  # fmt: skip
"""Then the filters, by where they are linearised: the first two about the table's path."""
RIVALS = BODY_FRAMES[1:]
"""Choices of axes with which the averaged ones, the first, are compared."""
COMPARISONS = len(SCHEMES) * len(MOUNTINGS) * len(RIVALS) * len(WAYS)
STEP = 12
"""Increments in a step of the error equations, 3 s; longer steps have errors of their own."""


def neglected_terms(
    units: int = UNITS,
    spread: float = 400 * arcsecond,
    ratio: float = 4.0,
    dwell: float = QUICK_TRIAL.scheme.dwell,
    seed: int = SEED,
) -> DataTable:
    """Run the whole study: some five minutes.

    The installation errors of the triad that is built worse have the `spread`, rad, and are so many
    times (`ratio`) as large as those of the other.
    """
    units = whole_number(units, "units", least=2)
    worse, ratio = positive_number(spread, "spread"), positive_number(ratio, "ratio")
    better = worse / ratio
    found = []
    for scheme in SCHEMES:
        for triads in ((worse, better), (worse, worse), (better, worse)):
            task = partial(neglected, scheme, *triads, dwell)
            found.append(run_batches(task, units, seed=seed, batch_size=BATCH))
    shape = len(SCHEMES), len(MOUNTINGS), len(BODY_FRAMES), len(WAYS), units
    left = np.concatenate(list(zip(*found, strict=True)), axis=-1).reshape(shape)
    ratios = left[:, :, :1] / left[:, :, 1:]
    verdicts = [verdict(each, 1 - 0.05 / COMPARISONS) for each in ratios.reshape(-1, units)]
    parts = np.transpose([each.part for each in verdicts]).reshape(3, *ratios.shape[:-1])
    of_axes, of_rivals = (([*SCHEMES], MOUNTINGS, axes) for axes in (BODY_FRAMES, RIVALS))
    means = left.mean(axis=-1), left[..., :BATCH].mean(axis=-1)
    return DataTable(
        {
            "way": (WAYS, "", "where something is neglected"),
            "size": (means[0], "", "mean over the units: what the error equations leave out of "
                "velocity (m/s) and attitude (rad), root mean square over time; of filters, "
                "squared errors of the 27 states over what they state", of_axes),
            "size_of_first": (means[1], "", f"the same mean, first {BATCH} units", of_axes),
            "better": ((ratios < 1).sum(axis=-1), "",
                "units in which averaged axes leave out less than the rival", of_rivals),
            "part": (parts[0], "", "the same, part of the units", of_rivals),
            "part_low": (parts[1], "", f"95 % interval for all {COMPARISONS} together", of_rivals),
            "part_high": (parts[2], "", "likewise", of_rivals),
        },
        {
            "units": (units, "", "units in each case"),
            "spread": (worse, "arcsec", "spread of the installation errors, triad built worse"),
            "ratio": (ratio, "", "times those of the triad built better"),
        },
    )  # fmt: skip


class Record(NamedTuple):
    """What a filter is given of random units, with the truth."""

    trial: TurntableTrial
    true: Trajectory
    measured: Increments
    reference: FloatArray  # (units, updates, 3)
    start: FloatArray  # (units, 4)
    each: int  # increments in an update


def neglected(
    scheme: str,
    gyros: float,
    accelerometers: float,
    dwell: float,
    rng: np.random.Generator,
    size: int,
) -> FloatArray:
    """What is neglected in random units, (axes, ways, units); spreads of installation in rad."""
    trial = quick_trial(scheme, gyros / arcsecond, dwell)
    unit = random_imu_errors(trial.prior, rng, size)
    built = np.where(np.eye(3), 1.0, accelerometers / gyros)
    unit = unit._replace(accelerometer_error_matrix=built * unit.accelerometer_error_matrix)
    each = round(trial.update_interval / trial.sample_interval)
    true = turntable_trajectory(
        trial.scheme, trial.latitude, trial.sample_interval, multiple_of=each
    )
    measured = measure(true.increments, unit, trial.noise, rng)
    updates = measured.angle.shape[-2] // each
    reference = trial.noise.reference_velocity * rng.standard_normal((size, updates, 3))
    tilt = from_rotation_vector(-trial.prior.attitude * rng.standard_normal((size, 3)))
    record = Record(trial, true, measured, reference, multiply(tilt, true.attitude[0]), each)
    found = []
    for frame in BODY_FRAMES:
        in_axes, turn = imu_errors_in_frame(unit, frame)
        model, at_end = _mounted(frame, accelerometers), attitude_of_axes(true.attitude[-1], turn)
        for state, attitude, velocity, covariance in _filters(record, model):
            wrong = model.state(in_axes) - state
            wrong[:, :6] = np.hstack([attitude_error(attitude, at_end), velocity])
            found.append(nees(wrong, covariance) / model.size)
    filtered = np.reshape(found, (len(BODY_FRAMES), -1, size))
    equations = np.swapaxes([*error_equations(true, unit, trial.latitude)], 0, 1)
    return np.concatenate([equations, filtered], axis=1)


def error_equations(true: Trajectory, unit: ImuErrors, latitude: float) -> Iterator[FloatArray]:
    """What the error equations leave out of `EQUATIONS` (axes, units), m/s and rad.

    Root mean square over time of a nonlinear navigation minus the linear equations, without noise.
    On its own path the computer starts with the true attitude of its axes, on the table's with that
    of the table.
    """
    in_axes, turns = zip(*(imu_errors_in_frame(unit, frame) for frame in BODY_FRAMES), strict=True)
    turn, errors = np.stack(turns), np.stack([FULL.state(each) for each in in_axes])
    measured, interval = measure(true.increments, unit), true.increments.interval
    free = free_transition(latitude, STEP * interval)
    axes = attitude_of_axes([0, 0, 0, 1], turn)
    for path_turn, back in ((axes, turn.mT), (np.array([0.0, 0.0, 0.0, 1.0]), np.eye(3))):
        start = multiply(true.attitude[0], path_turn)
        now = home = stationary_state(latitude, start)
        state = errors.copy()
        state[..., :3] = attitude_error(start, multiply(true.attitude[0], axes))
        squares = []
        for begin in range(0, len(true.increments.angle), STEP):
            end = begin + STEP
            now = _navigated(now, home, measured.part(begin, end))
            nodes = multiply(true.attitude[begin : end + 1 : 2], path_turn[..., np.newaxis, :])
            _, *rows = true.increments.part(begin, end)
            along = Increments(interval, *(row @ back for row in rows))
            growth = transition_of_increments(FULL, free, nodes, along)
            state = (growth @ state[..., np.newaxis])[..., 0]
            off = attitude_error(now.attitude, multiply(true.attitude[end], axes))
            squares.append([(now.velocity - state[..., 3:6]) ** 2, (off - state[..., :3]) ** 2])
        yield from np.sqrt(np.sum(squares, axis=-1).mean(axis=0))


def _navigated(now: Navigation, home: Navigation, part: Increments) -> Navigation:
    """Navigate along a part of a record; the place is known, because the table stands."""
    # A thousand such calls and more are worth compiled code.
    way = loops.navigate(now, *part[1:], part.interval, ALGORITHM, calls=1000)
    arrived = final_state(way)
    return home._replace(velocity=arrived.velocity, attitude=arrived.attitude)


def _filters(record: Record, model: ErrorModel) -> Iterator[tuple[FloatArray, ...]]:
    """State, attitude, velocity and covariance at the end, of each filter of `WAYS`."""
    trial, _, measured, reference, start, _ = record
    gains, covariance = _along_the_table(record, model)
    for fed_back in (False, True):
        yield *_on_the_table(record, model, gains, fed_back), covariance
    one_pass = partial(
        calibrate, measured, reference, latitude=trial.latitude, start=start, model=model,
        prior=trial.prior, noise=trial.noise, keep=reference.shape[-2], check=False,
    )  # fmt: skip
    first = one_pass()
    for found in (first, one_pass(linearization_point=first)):
        history = found.state, found.attitude, found.velocity, found.covariance
        yield tuple(each[:, -1] for each in history)


Gains = list[tuple[FloatArray, FloatArray]]  # transition and gain of each update


def _along_the_table(record: Record, model: ErrorModel) -> tuple[Gains, FloatArray]:
    """Transitions and gains along the table's path, the same for all units, and the covariance."""
    trial, (increments, path, *_), each = record.trial, record.true, record.each
    free = free_transition(trial.latitude, trial.update_interval)
    covariance = model.covariance(trial.prior, path[0])
    observed, spread = np.eye(3, model.size, 3), trial.noise.reference_velocity**2 * np.eye(3)
    gains = []
    for begin in range(0, len(increments.angle), each):
        end = begin + each
        growth = transition_of_increments(
            model, free, path[begin : end + 1 : 2], increments.part(begin, end)
        )
        added = process_noise(trial.noise, growth[3:6, :3], np.asarray(trial.update_interval))
        covariance = kalman.predict(covariance, growth[:6], added)
        covariance, gain, _ = kalman.correct_covariance(covariance, observed, spread)
        gains.append((growth, gain))
    return gains, covariance


def _on_the_table(
    record: Record, model: ErrorModel, gains: Gains, fed_back: bool
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """State, attitude and velocity that a filter with these gains finds, fed back or not."""
    _, _, measured, reference, start, each = record
    now = home = stationary_state(record.trial.latitude, start)
    known = mean = np.zeros((len(start), model.size))  # what is compensated, and what is left
    for k, (growth, gain) in enumerate(gains):
        part = compensate(measured.part(k * each, (k + 1) * each), model.imu_errors(known))
        now = _navigated(now, home, part)
        mean = mean @ growth.T
        mean = mean + (now.velocity - reference[:, k] - mean[:, 3:6]) @ gain.T
        velocity = now.velocity - mean[:, 3:6]
        attitude = multiply(from_rotation_vector(mean[:, :3]), now.attitude)
        found = known + mean
        if fed_back:
            known, mean = found, np.zeros_like(mean)
            now = home._replace(velocity=velocity, attitude=attitude)
    return found, attitude, velocity


@dataclass(frozen=True, eq=False)
class _Mounted(ErrorModel):
    """A model whose accelerometers have a spread of their own."""

    accelerometers: float = 0.0  # spread of their installation errors, rad

    def covariance(self, prior: PriorStandardDeviations, attitude: ArrayLike) -> FloatArray:
        """Covariance before a calibration; the prior's `installation` is that of the gyros."""
        installation = self.reduction(attitude)[:, 24:]
        more = self.accelerometers**2 - prior.installation**2
        return super().covariance(prior, attitude) + more * installation @ installation.T


@cache  # a second pass must have the model of the first
def _mounted(frame: str, accelerometers: float) -> _Mounted:
    return _Mounted(**vars(ERROR_MODELS[frame]), accelerometers=accelerometers)
