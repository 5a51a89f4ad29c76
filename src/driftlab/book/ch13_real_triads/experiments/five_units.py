"""Does a published table follow from its data? Five units, and several ways to try."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d
from scipy.optimize import least_squares

from driftlab.calibration.poses import calibrate_by_poses
from driftlab.checks import FloatArray
from driftlab.recordings.publishers import published
from driftlab.recordings.recording import Recording
from driftlab.recordings.rest_detection import rests

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
"""All ways, `calibrate_by_poses` the last."""
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


class FiveUnits(NamedTuple):
    """First index the way, if there is one; then the unit."""

    # (5, 3, 3), K of measured = (I + K) true + bias, from the authors' table
    published_gyro: FloatArray
    published_accelerometer: FloatArray  # (5, 3, 3), L, likewise
    gyro: FloatArray  # (way, 5, 3, 3), K in the same axes
    # (way, 5, 3, 3), its standard deviations, by the scatter of the residuals
    deviation: FloatArray
    # (way, 5, 3, 3), L, by all three components of what a sample at rest has too much
    accelerometer: FloatArray
    # (5, 3, 3), L in the authors' way with the code of the year of the table, which lost the third
    before_the_fix: FloatArray
    residual: FloatArray  # (way, 5), root mean square of the angles left, rad
    moves: FloatArray  # (way, 5), how many moves were found
    # (5,), with the published matrices and gyro bias, in the authors' way
    published_residual: FloatArray
    # (5,), with the bias that suits these matrices best, because theirs is rounded
    with_own_bias: FloatArray
    shortest: FloatArray  # (5,), samples in the shortest rest that the authors' way finds
    # (m,), of the odd unit: the angle left after each move in the authors' way, rad
    angles: FloatArray
    pause: FloatArray  # (2,), rows of its shortest rest
    rate: FloatArray  # (n,), size of its rate about that rest, rad/s, from the row `rate_begin` on
    rate_begin: FloatArray  # ()

    @property
    def difference(self) -> FloatArray:
        """Largest difference (way, 5) of an entry of K from the table."""
        return np.abs(self.gyro - self.published_gyro).max(axis=(-2, -1))

    @property
    def in_deviations(self) -> FloatArray:
        """Largest difference (way, 5) in units of the entry's own deviation."""
        return (np.abs(self.gyro - self.published_gyro) / self.deviation).max(axis=(-2, -1))

    @property
    def moved(self) -> FloatArray:
        """By how much K (3, 3) of the odd unit moves when its shortest rest alone is dropped."""
        with_it, without = self.gyro[PAUSE, ODD]
        return np.abs(without - with_it)

    @property
    def moved_in_deviations(self) -> FloatArray:
        """The largest of it in units of the entry's own deviation: (2,), with it and without."""
        return (self.moved / self.deviation[PAUSE, ODD]).max(axis=(-2, -1))


def five_units() -> FiveUnits:
    """Fit all five units in all ways."""
    logs = [published(name, download=False) for name in UNITS]
    tables = [imu_calib_triads(unit) for unit in range(len(UNITS))]
    fits = [[fit_unit(log, way) for log in logs] for way in WAYS]
    fits.append([weighted_fit(log) for log in logs])
    own = np.array([_with_table(log, table) for log, table in zip(logs, tables, strict=True)])
    cuts = [authors_rests(log, WAYS[0]) for log in logs]
    pause = min(cuts[ODD], key=lambda rows: rows[1] - rows[0])
    around = slice(pause[0] - 330, pause[1] + 300)
    return FiveUnits(
        np.array([table[1].error for table in tables]),
        np.array([table[0].error for table in tables]),
        np.array([[fit.gyro for fit in row] for row in fits]),
        np.array([[fit.deviation for fit in row] for row in fits]),
        np.array([[fit.accelerometer for fit in row] for row in fits]),
        np.array([_before_the_fix(log, rows) for log, rows in zip(logs, cuts, strict=True)]),
        np.array([[_rms(fit.angles) for fit in row] for row in fits]),
        np.array([[len(fit.angles) for fit in row] for row in fits], float),
        own[:, 0],
        own[:, 1],
        np.array([min(end - begin for begin, end in rows) for rows in cuts], float),
        fits[0][ODD].angles,
        np.array(pause, float),
        np.linalg.norm(logs[ODD].gyro[around], axis=1),
        np.array(float(around.start)),
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
    fit = calibrate_by_poses(log, rests(log), body_axes="lower triangle accelerometers")
    found = fit.imu_errors
    return UnitFit(
        found.accelerometer_error, found.gyro_error, fit.deviations.gyro_error, fit.turn_residuals
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
        size = np.linalg.norm(true, axis=1, keepdims=True)
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
    moving = np.linalg.norm(log.gyro, axis=1) >= way.quiet
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


def _rms(angles: FloatArray) -> float:
    return float(np.sqrt((angles**2).mean()))
