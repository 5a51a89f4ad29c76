"""In which body axes is the neglected second order least? In the error equations, and in filters.

The error equations are compared with a nonlinear navigation; a filter shows what it neglects in its
squared errors. It depends on where the equations are linearised, and on which triad is built worse.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcsecond

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.ch11_kalman_calibration.experiments import (
    QUICK_TRIAL,
    STANDING,
    quick_trial,
    verdict,
)
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
FILTERS = len(WAYS) - len(EQUATIONS)
COMPARISONS = len(SCHEMES) * len(RIVALS) * (len(MOUNTINGS) * len(WAYS) + FILTERS)
"""The filters are tried a second time, on a table that stands, with both triads built alike."""
STEP = 12
"""Increments in a step of the error equations, 3 s; longer steps have errors of their own."""


def neglected_terms(
    units: int = UNITS,
    spread: float = 400 * arcsecond,
    ratio: float = 4.0,
    dwell: float = QUICK_TRIAL.scheme.dwell,
    seed: int = SEED,
) -> DataTable:
    """Run the whole study: some eight minutes.

    The installation errors of the triad that is built worse have the `spread`, rad, and are so many
    times (`ratio`) as large as those of the other.
    """
    units = whole_number(units, "units", least=2)
    worse, ratio = positive_number(spread, "spread"), positive_number(ratio, "ratio")
    better = worse / ratio
    loose = QUICK_TRIAL.noise.reference_velocity
    cases = [(worse, better, loose), (worse, worse, loose), (better, worse, loose)]
    found = []
    for scheme in SCHEMES:
        for case in (*cases, (worse, worse, STANDING)):
            task = partial(neglected, scheme, *case, dwell)
            found.append(run_batches(task, units, seed=seed, batch_size=BATCH))
    shape = len(SCHEMES), len(cases) + 1, len(BODY_FRAMES), len(WAYS), units
    every = np.concatenate(list(zip(*found, strict=True)), axis=-1).reshape(shape)
    left, still = every[:, :-1], every[:, -1, :, len(EQUATIONS) :]
    counts, still_counts = _counted(left), _counted(still)
    of_axes, of_rivals = (([*SCHEMES], MOUNTINGS, axes) for axes in (BODY_FRAMES, RIVALS))
    means = left.mean(axis=-1), left[..., :BATCH].mean(axis=-1)
    return DataTable(
        {
            "way": (WAYS, "", "where something is neglected"),
            "size": (means[0], "", "mean over the units: what the error equations leave out of "
                "velocity (m/s) and attitude (rad), root mean square over time; of filters, "
                "squared errors of the 27 states over what they state", of_axes),
            "size_of_first": (means[1], "", f"the same mean, first {BATCH} units", of_axes),
            "better": (counts[0], "",
                "units in which averaged axes leave out less than the rival", of_rivals),
            "part": (counts[1], "", "the same, part of the units", of_rivals),
            "part_low": (counts[2], "", f"95 % interval for all {COMPARISONS} together", of_rivals),
            "part_high": (counts[3], "", "likewise", of_rivals),
            "filter": (WAYS[len(EQUATIONS) :], "", "on a table that stands, triads built alike"),
            "still_size": (still.mean(axis=-1), "", "as `size`", ([*SCHEMES], BODY_FRAMES)),
            "still_better": (still_counts[0], "", "as `better`", ([*SCHEMES], RIVALS)),
            "still_low": (still_counts[2], "", "as `part_low`", ([*SCHEMES], RIVALS)),
            "still_high": (still_counts[3], "", "as `part_high`", ([*SCHEMES], RIVALS)),
        },
        {
            "units": (units, "", "units in each case"),
            "spread": (worse, "arcsec", "spread of the installation errors, triad built worse"),
            "ratio": (ratio, "", "times those of the triad built better"),
            "reference_velocity": (np.array([loose, STANDING]), "mm_per_s",
                "that of the filters, and that of the table that stands"),
        },
    )  # fmt: skip


def _counted(left: FloatArray) -> FloatArray:
    """How often averaged axes leave out less than each rival, and `part`, low and high (4, ...).

    Of what is left out (..., axes, ways, units).
    """
    ratios = left[..., :1, :, :] / left[..., 1:, :, :]
    units = ratios.shape[-1]
    verdicts = [verdict(each, 1 - 0.05 / COMPARISONS) for each in ratios.reshape(-1, units)]
    rows = np.transpose([(each.better, *each.part) for each in verdicts])
    return rows.reshape(4, *ratios.shape[:-1])


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
    reference_velocity: float,
    dwell: float,
    rng: np.random.Generator,
    size: int,
) -> FloatArray:
    """What is neglected in random units, (axes, ways, units); spreads of installation in rad."""
    trial = quick_trial(scheme, gyros / arcsecond, dwell)
    trial = replace(trial, noise=replace(trial.noise, reference_velocity=reference_velocity))
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


class Path(NamedTuple):
    """About what the error equations are linearised."""

    attitudes: FloatArray  # (..., n + 1, 4); only each second one is used
    increments: Increments  # (..., n, 3)


def error_equations(true: Trajectory, unit: ImuErrors, latitude: float) -> Iterator[FloatArray]:
    """What the error equations leave out of `EQUATIONS` (axes, units), m/s and rad.

    Root mean square over time of a nonlinear navigation minus the linear equations, without noise.
    On its own path the computer starts with the true attitude of its axes, on the table's with that
    of the table.
    """
    in_axes, turns, axes = _in_all_axes(unit)
    errors, measured = (
        np.stack([FULL.state(each) for each in in_axes]),
        measure(true.increments, unit),
    )
    for turn, back in ((axes, turns.mT), (np.array([0.0, 0.0, 0.0, 1.0]), np.eye(3))):
        nodes = multiply(true.attitude, turn[..., np.newaxis, :])
        interval, *rows = true.increments
        along = Increments(interval, *(row @ back for row in rows))
        yield from _left_out(true, measured, axes, errors, Path(nodes, along), latitude)


def on_the_computed_path(
    true: Trajectory, unit: ImuErrors, latitude: float, *, corrections: bool
) -> Iterator[FloatArray]:
    """The same about the path that the computer finds from the table's attitude: measured rates.

    The errors are K and L times what is measured, or, as `corrections`, what takes the measured
    vector to the true one, :math:`I - (I + K)^{-1}`.
    """
    in_axes, _, axes = _in_all_axes(unit)
    if corrections:
        in_axes = [_corrections(each) for each in in_axes]
    errors, measured = (
        np.stack([FULL.state(each) for each in in_axes]),
        measure(true.increments, unit),
    )
    begin = stationary_state(latitude, np.broadcast_to(true.attitude[0], axes.shape))
    nodes = np.empty((*axes.shape[:-1], len(true.attitude), 4))
    nodes[..., 0, :], now = true.attitude[0], begin
    for first in range(0, nodes.shape[-2] - 1, STEP):
        part = measured.part(first, first + STEP)
        way = loops.navigate(now, *part[1:], part.interval, ALGORITHM, calls=1000)
        nodes[..., first + 2 : first + STEP + 1 : 2, :] = way.attitude
        last = final_state(way)
        now = begin._replace(velocity=last.velocity, attitude=last.attitude)
    yield from _left_out(true, measured, axes, errors, Path(nodes, measured), latitude)


def _in_all_axes(unit: ImuErrors) -> tuple[list[ImuErrors], FloatArray, FloatArray]:
    """Errors of units in each choice of axes, turns of these (axes, units, 3, 3) and attitudes."""
    in_axes, each = zip(*(imu_errors_in_frame(unit, frame) for frame in BODY_FRAMES), strict=True)
    turns = np.stack(each)
    return list(in_axes), turns, attitude_of_axes([0, 0, 0, 1], turns)


def _corrections(unit: ImuErrors) -> ImuErrors:
    """The same errors, as they act on what is measured."""
    gyros, accelerometers = (
        np.linalg.inv(np.eye(3) + matrix)
        for matrix in (unit.gyro_error_matrix, unit.accelerometer_error_matrix)
    )
    return ImuErrors(
        (gyros @ unit.gyro_bias[..., np.newaxis])[..., 0],
        np.eye(3) - gyros,
        (accelerometers @ unit.accelerometer_bias[..., np.newaxis])[..., 0],
        np.eye(3) - accelerometers,
    )


def _left_out(
    true: Trajectory,
    measured: Increments,
    axes: FloatArray,
    errors: FloatArray,
    path: Path,
    latitude: float,
) -> FloatArray:
    """What the equations along a path leave out of velocity and attitude."""
    nodes, along = path
    begin, interval = nodes[..., 0, :], true.increments.interval
    free = free_transition(latitude, STEP * interval)
    now = home = stationary_state(latitude, np.broadcast_to(begin, axes.shape))
    state = errors.copy()
    state[..., :3] = attitude_error(begin, multiply(true.attitude[0], axes))
    squares = []
    for first in range(0, len(true.increments.angle), STEP):
        last = first + STEP
        now = _navigated(now, home, measured.part(first, last))
        here = nodes[..., first : last + 1 : 2, :]
        growth = transition_of_increments(FULL, free, here, along.part(first, last))
        state = (growth @ state[..., np.newaxis])[..., 0]
        off = attitude_error(now.attitude, multiply(true.attitude[last], axes))
        squares.append([(now.velocity - state[..., 3:6]) ** 2, (off - state[..., :3]) ** 2])
    found: FloatArray = np.sqrt(np.sum(squares, axis=-1).mean(axis=0))
    return found


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
