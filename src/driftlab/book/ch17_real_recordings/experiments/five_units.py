"""Does a published table follow from its data? Five units, and several ways to try."""

from typing import NamedTuple

import numpy as np
from numpy.linalg import norm
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d
from scipy.optimize import least_squares

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration.multi_position import calibrate_multi_position
from driftlab.checks import FloatArray
from driftlab.recordings.publishers import published
from driftlab.recordings.recording import Recording
from driftlab.recordings.static_detection import static_intervals

from .force_and_gravity import force_and_gravity
from .publishers_numbers import UNITS, imu_calib_triads
from .tilt_fit import Triad, calibrated, fit_accelerometers, fit_gyros

QUIET = 0.13
"""Rate below which the authors' code takes a unit to be at rest, rad/s."""
SETTLED = 60
"""Samples that it leaves out after a move and before the next."""
_WIDENED = 5
"""Samples by which it lengthens each move at both ends."""


class Way(NamedTuple):
    """One way to cut and fit a record."""

    name: str
    quiet: float = QUIET  # rad/s
    settled: int = SETTLED  # samples
    # least number of samples in a rest; a shorter one belongs to the move about it
    shortest: int = 0
    spline: bool = True  # whether angles are integrals of a spline, or the interval times a sample
    bias_sought: bool = True  # whether the gyro bias is fitted, or the mean of the rests


WAYS = (
    Way("as the authors' code has it", spline=False),
    Way("integrals of a spline"),
    Way("without rests under 0.1 s", shortest=10),
    Way("nor under 0.5 s; 1 s to settle", shortest=50, settled=100),
    Way("and quiet below 0.2 rad/s", shortest=50, settled=100, quiet=0.2),
    Way("and the gyro bias of the rests", shortest=50, settled=100, bias_sought=False),
)
"""Ways of the authors' method: the first is their own, the third drops one rest of one unit."""
WAY_NAMES = (*(way.name for way in WAYS), "rests and weights of this book")
"""All ways, `calibrate_multi_position` the last."""
UNIT_NAMES = tuple(f"unit {number}" for number in range(1, 6))
ODD = 1
"""Index of the unit for which ways matter."""
PAUSE = [1, 2]
"""Ways that differ by its shortest rest and by nothing else: with it and without."""


class UnitFit(NamedTuple):
    """One unit in one way: its two matrices, deviations of the gyros', and angles left, rad."""

    accelerometer: FloatArray
    gyro: FloatArray
    deviation: FloatArray
    angles: FloatArray


def five_units() -> DataTable:
    """Fit all five units in all ways."""
    logs = [published(name, download=False) for name in UNITS]
    tables = [imu_calib_triads(unit) for unit in range(len(UNITS))]
    fits = [[fit_unit(log, way) for log in logs] for way in WAYS]
    fits.append([weighted_fit(log) for log in logs])
    own = np.array([*map(_with_table, logs, tables)])
    cuts = [authors_rests(log, WAYS[0]) for log in logs]
    pause = min(cuts[ODD], key=lambda rows: rows[1] - rows[0])
    around = slice(pause[0] - 330, pause[1] + 300)
    shortest = [min(end - begin for begin, end in rows) for rows in cuts]
    log, interval = logs[ODD], logs[ODD].interval
    times = interval * np.arange(around.start, around.stop)
    gyro, deviation = (
        np.array([[getattr(fit, name) for fit in row] for row in fits])
        for name in ("gyro", "deviation")
    )
    theirs = np.array([[triad.error for triad in table] for table in tables])
    off = np.abs(gyro - theirs[:, 1])
    moved, both = np.abs(gyro[PAUSE[1], ODD] - gyro[PAUSE[0], ODD]), deviation[PAUSE, ODD]
    today, then = [fit.accelerometer for fit in fits[0]], [*map(_before_the_fix, logs, cuts)]
    residual = np.array([[_rms(fit.angles) for fit in row] for row in fits])
    moves = np.array([[len(fit.angles) for fit in row] for row in fits])
    authors = "in the authors' way"
    return DataTable(
        {
            "time": (times, "s", "around a rest of unit 2"),
            "rate": (norm(log.gyro[around], axis=1), "rad_per_s", "size of its rate"),
            "quiet_below": ([QUIET], "rad_per_s", "rate below which the authors see a rest"),
            "rest_begins": ([interval * pause[0]], "s", "begin of this rest"),
            "rest_ends": ([interval * pause[1]], "s", "end of this rest"),
            "way": (WAY_NAMES, "", "how a record is cut and fitted"),
            "largest_difference": (_largest(off).T, "", "of K from the table's", UNIT_NAMES),
            "angle_left": (residual.T, "deg", "root mean square after a move", UNIT_NAMES),
        },
        {
            "gyro": (gyro, "", "K of measured = (I + K) true + bias, by way and unit"),
            "deviation": (deviation, "", "its standard deviations"),
            "in_deviations": (_largest(off / deviation), "", "largest difference in these"),
            "published_accelerometer": (theirs[:, 0], "", "L of each unit"),
            "accelerometer": (np.array(today), "", f"L {authors}, by all three components"),
            "before_the_fix": (np.array(then), "", "L with the code of the year of the table"),
            "moves": (moves, "", "number of moves found, by way and unit"),
            "published_residual": (own[:, 0], "deg", f"left by the published numbers, {authors}"),
            "with_own_bias": (own[:, 1], "deg", "the same with the best bias; theirs is rounded"),
            "shortest": (np.array(shortest), "", f"samples in the shortest rest {authors}"),
            "angles": (fits[0][ODD].angles, "deg", f"left after each move of unit 2, {authors}"),
            "pause": (np.array(pause), "", "rows of its shortest rest"),
            "moved": (moved.max(), "", "largest change of unit 2's K without its shortest rest"),
            "moved_in_deviations": (_largest(moved / both), "", "in deviations with and without"),
        },
    )


def fit_unit(log: Recording, way: Way) -> UnitFit:
    """Fit a unit by the authors' method, each move with the same weight, in one way."""
    cuts = authors_rests(log, way)
    rows = _still_rows(cuts, len(log))
    force, gravity = force_and_gravity(log)
    accelerometers = fit_accelerometers(force[rows], gravity)
    bias = None if way.bias_sought else log.gyro[rows].mean(axis=0)
    fit = fit_gyros(log, cuts, accelerometers, fixed_bias=bias, spline=way.spline)
    return UnitFit(accelerometers.error, fit.gyros.error, fit.deviation, fit.residuals)


def weighted_fit(log: Recording) -> UnitFit:
    """Fit a unit by rests and weights of this book, in the authors' body axes."""
    fit = calibrate_multi_position(
        log, static_intervals(log), body_axes="lower triangle accelerometers"
    )
    found = fit.imu_errors
    return UnitFit(
        found.accelerometer_error_matrix,
        found.gyro_error_matrix,
        fit.standard_deviations.gyro_error_matrix,
        fit.turn_residuals,
    )


def _before_the_fix(log: Recording, cuts: list[tuple[int, int]]) -> FloatArray:
    """Error matrix of the accelerometers by two components of what each sample has too much.

    An index of the authors' code stepped by two where there are three numbers, so that the third
    was overwritten; it was mended ten months after the table.
    """
    force, gravity = force_and_gravity(log)
    force = force[_still_rows(cuts, len(log))]

    def triad(unknowns: FloatArray) -> Triad:
        error = np.zeros((3, 3))
        error[np.triu_indices(3)] = unknowns[:6]
        return Triad(error, unknowns[6:])

    def surplus(unknowns: FloatArray) -> FloatArray:
        true = calibrated(force, triad(unknowns))
        size = norm(true, axis=1, keepdims=True)
        return (true[:, :2] * (gravity / size - 1)).ravel()

    return triad(least_squares(surplus, np.zeros(9), method="lm").x).error


def _still_rows(cuts: list[tuple[int, int]], count: int) -> NDArray[np.intp]:
    """Rows of the rests before the moves were widened: all of them count for the accelerometers."""
    return np.concatenate(
        [np.arange(max(begin - _WIDENED, 0), min(end + _WIDENED, count)) for begin, end in cuts]
    )


def authors_rests(log: Recording, way: Way) -> list[tuple[int, int]]:
    """Rests by the rule of the authors' code.

    A row is still if the rate stays below the bound for the time of settling before it and after;
    moves are then widened by a few samples, so that rests lose as many.
    """
    moving = norm(log.gyro, axis=1) >= way.quiet
    still = ~maximum_filter1d(moving, 2 * way.settled + 1)
    edges = np.flatnonzero(np.diff(still, prepend=False, append=False))
    found = [(b + _WIDENED, e - _WIDENED) for b, e in edges.reshape(-1, 2).tolist()]
    first, last = (0, found[0][1]), (found[-1][0], len(log) - 1)
    return [
        (begin, end)
        for begin, end in [first, *found[1:-1], last]
        if end - begin >= max(way.shortest, 1)
    ]


def _with_table(log: Recording, table: tuple[Triad, Triad]) -> tuple[float, float]:
    """Residuals that the published matrices leave, with the published bias and with the best."""
    cuts = authors_rests(log, WAYS[0])
    accelerometers, gyros = table
    as_published, refitted = (
        fit_gyros(log, cuts, accelerometers, fixed_error=gyros.error, fixed_bias=b, spline=False)
        for b in (gyros.bias, None)
    )
    return _rms(as_published.residuals), _rms(refitted.residuals)


def _largest(matrices: FloatArray) -> FloatArray:
    return np.asarray(matrices.max(axis=(-2, -1)))


def _rms(angles: FloatArray) -> float:
    return float(np.sqrt((angles**2).mean()))
