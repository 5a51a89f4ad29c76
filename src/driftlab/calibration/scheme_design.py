"""Scheme design: turns of a table after which the sensor errors are known best.

The criteria are those of optimal plans of experiments: V. V. Fedorov, *Theory of Optimal
Experiments*, Academic Press, 1972.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import (
    USUAL_TABLE,
    FloatArray,
    checked_generator,
    checked_instance,
    finite_array,
    finite_number,
    keep,
    one_of,
    positive_number,
    shown,
    table_rate,
    truth_value,
    whole_number,
)
from driftlab.earth import checked_latitude
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import Scheme, checked_scheme

from .covariance import IntArray, Row, _row_covariances, _RowCovariances, _TableMoves
from .error_dynamics import checked_model, checked_noise
from .error_model import ERROR_MODELS, ErrorModel

CRITERIA = ("worst", "mean", "volume")
"""What a design can make small: see `DesignTask`."""


@dataclass(frozen=True)
class DesignTask:
    """What a rotation scheme is to be good at, and what the table can do.

    Attributes
    ----------
    criterion : str
        "worst": the largest deviation of a sensor error at the end, over its requirement. "mean":
        the root of the mean square of these ratios; schemes that make it least are A-optimal.
        "volume": the geometric mean of the half axes of the error ellipsoid, each sensor error
        counted in its requirement; schemes that make it least are D-optimal.
    requirement : tuple of float, optional
        Deviation of each sensor error that counts as one; those before the calibration, in the
        table's axes, if not given. An error that is known before does not count.
    positions : int
        Number of pauses, at least 2.
    duration : float
        Of the whole scheme, s. The pauses are equal and share what the turns leave.
    angles : tuple of int
        Angles of the turns, degrees: of 90, 180, 270, 360.
    two_axes : bool
        Whether the table has two axes: the outer one is level and stays where it is, East or
        North; the inner one is an axis of the body, across the outer one. Otherwise it has three
        that move together, and turns about any axis of the body.
    latitude : float
        Of the table, rad; not a pole.
    model : ErrorModel
        The states.
    noise, prior : ImuNoise, PriorStandardDeviations
        Noise of the sensors and of the reference velocity, and deviations before.
    rate : float
        Of the turns, rad/s.

    Examples
    --------
    The nineteen positions leave one sensor error known to a twenty-eighth of what it was:

    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS
    >>> round(1 / DesignTask().value(NINETEEN_POSITIONS))
    28

    If all is known twice as well as it has to be, the criterion is one half:

    >>> float(DesignTask(requirement=(2.0,) * 21).values(np.eye(27)))
    0.5
    >>> DesignTask(positions=4).random_schemes(np.random.default_rng(1), count=5)[0].positions
    4
    """

    criterion: str = "worst"
    requirement: tuple[float, ...] | None = None
    positions: int = 19
    duration: float = 2442.0
    angles: tuple[int, ...] = (90, 180)
    two_axes: bool = True
    latitude: float = float(np.radians(37.5))
    model: ErrorModel = ERROR_MODELS["averaged"]
    noise: ImuNoise = field(default_factory=ImuNoise)
    prior: PriorStandardDeviations = field(default_factory=PriorStandardDeviations)
    rate: float = float(np.radians(10.0))

    def __post_init__(self) -> None:
        one_of(self.criterion, CRITERIA, "criterion")
        keep(self, model=checked_model(self.model))
        checked_noise(self.noise)
        checked_instance(self.prior, PriorStandardDeviations, "prior")
        keep(
            self,
            latitude=float(checked_latitude(finite_number(self.latitude, "latitude"))),
            two_axes=truth_value(self.two_axes, "two_axes"),
            rate=table_rate(positive_number(self.rate, "rate"), "rate", USUAL_TABLE),
            positions=whole_number(self.positions, "positions", 2),
            duration=positive_number(self.duration, "duration"),
        )
        turns = self.positions - 1
        angles = self.angles if isinstance(self.angles, tuple | list) else ()
        if not angles or not all(np.isscalar(a) and a in (90, 180, 270, 360) for a in angles):
            raise ValueError(
                f"angles: expected some of 90, 180, 270, 360, got {shown(self.angles)}."
            )
        keep(self, angles=tuple(dict.fromkeys(map(int, angles))))
        turning = turns * np.radians(max(angles)) / self.rate
        if self.duration < turning + self.positions:
            raise ValueError(
                f"duration: expected more than {turning + self.positions:g} s, the largest turns "
                f"and pauses of a second, got {shown(self.duration)}."
            )
        if self.requirement is not None:
            sizes = finite_array(self.requirement, "requirement", self.model.size - 6)
            if sizes.ndim != 1 or not (sizes > 0).all():
                raise ValueError("requirement: expected positive deviations, got others.")
            keep(self, requirement=tuple(sizes.tolist()))
        if len(self._unknown) == 0:
            raise ValueError("prior: expected some sensor error that is unknown, got none.")

    def values(self, covariance: FloatArray) -> FloatArray:
        """Criterion (...) of covariances (..., size, size) at the end of schemes; small is good."""
        given = finite_array(covariance, "covariance", self.model.size, self.model.size)
        chosen, sizes = 6 + self._unknown, self._sizes[self._unknown]
        scaled = given[..., chosen[:, np.newaxis], chosen] / np.outer(sizes, sizes)
        if self.criterion == "volume":
            logarithm = np.linalg.slogdet(scaled)[1]
            return np.asarray(np.exp(logarithm / (2 * scaled.shape[-1])))
        squares = np.einsum("...ii->...i", scaled)
        summed = squares.max(-1) if self.criterion == "worst" else squares.mean(-1)
        return np.asarray(np.sqrt(summed))

    def value(self, scheme: Scheme) -> float:
        """Criterion of one scheme, with pauses and rate as the task has them."""
        rows = self._rows
        return float(self.values(rows.after([rows.row(scheme)]))[0])

    def random_schemes(self, rng: np.random.Generator | int, count: int) -> list[Scheme]:
        """Draw `count` random schemes that the table can do, each as long as the task says."""
        rows = self._rows
        drawn = rows.moves.drawn(
            checked_generator(rng),
            whole_number(count, "count"),
            self.positions - 1,
            self.two_axes,
        )
        return [rows.scheme(start, row) for start, row in zip(*drawn, strict=True)]

    @property
    def _rows(self) -> _RowCovariances:
        """Rows of turns that the task allows, with what they show."""
        return _row_covariances(
            moves=_TableMoves(self.angles), duration=self.duration, rate=self.rate,
            latitude=self.latitude, model=self.model, noise=self.noise, prior=self.prior,
        )  # fmt: skip

    @cached_property
    def _sizes(self) -> FloatArray:
        return self._before if self.requirement is None else np.array(self.requirement)

    @cached_property
    def _before(self) -> FloatArray:
        level = self.model.covariance(self.prior, [0.0, 0.0, 0.0, 1.0])
        return np.sqrt(np.diag(level))[6:]

    @cached_property
    def _unknown(self) -> NDArray[np.int_]:
        """Places of the sensor errors that count: what is known before needs no scheme."""
        return np.flatnonzero(self._before)


_GAIN = 1e-6  # relative: less is no gain, so that all processors take the same way
_BLOCK = 48  # schemes that are tried at once


class Climb(NamedTuple):
    """A scheme and what became of it.

    Attributes
    ----------
    begin, end : Scheme
        Before and after the improvements.
    before, after : float
        Their criteria.
    """

    begin: Scheme
    end: Scheme
    before: float
    after: float


class SchemeDesign(NamedTuple):
    """A designed scheme, and those that lost.

    Attributes
    ----------
    scheme : Scheme
        The best that was found.
    value : float
        Its criterion.
    climbs : list of Climb
        All of them, the best first.
    drawn : ndarray, shape (draws,)
        Criteria of all random schemes.
    tried : int
        Number of schemes that were tried in all.
    """

    scheme: Scheme
    value: float
    climbs: list[Climb]
    drawn: FloatArray
    tried: int


def design_scheme(
    task: DesignTask,
    rng: np.random.Generator | int,
    *,
    draws: int = 200,
    climbs: int = 4,
    begin: Scheme | None = None,
) -> SchemeDesign:
    """Search for the rotation scheme that makes a criterion least.

    Parameters
    ----------
    task : DesignTask
        The criterion, and what the table can do.
    rng : numpy.random.Generator or int
        Source of all random draws.
    draws : int
        Number of random schemes.
    climbs : int
        How many of them are improved, the best ones.
    begin : Scheme, optional
        One more scheme to be improved. The design is never worse than it, in the task's duration.

    Returns
    -------
    SchemeDesign
        The best scheme of all climbs, and the others. Nobody says that there is none better.

    Raises
    ------
    ValueError
        If `begin` has other turns or another number of positions than the task, or the table
        cannot do it.

    Notes
    -----
    A climb tries neighbours in random order: another turn in one place, the later ones about the
    same axes of the body or of the room; a turn taken to another place; another start. It goes on
    from the best of a few dozen as soon as one is better, and ends when none is. Such exchanges
    are the common way to D-optimal plans of experiments.

    Examples
    --------
    Five positions in the time of the nineteen. How much better is the darkest sensor error known
    than before, after the best of thirty random rows, and after the designed one?

    >>> task = DesignTask(positions=5)
    >>> design = design_scheme(task, np.random.default_rng(1), draws=30, climbs=2)
    >>> print(f"{1 / design.drawn.min():.1f} and {1 / design.value:.1f} times")
    2.5 and 5.4 times
    """
    checked_instance(task, DesignTask, "task")
    count = whole_number(climbs, "climbs")
    trials, turns = task._rows, task.positions - 1
    number, moves = whole_number(draws, "draws"), trials.moves
    source = checked_generator(rng)
    starts, rows = moves.drawn(source, number, turns, task.two_axes)
    drawn = task.values(trials.covariances(starts, rows))
    best = _in_order(drawn)[:count]
    begun = [((int(starts[i]), rows[i]), float(drawn[i])) for i in best]
    tried = len(drawn)
    if begin is not None:
        begin = checked_scheme(begin, "begin")
        row = trials.row(begin)
        if len(row[1]) != turns or (task.two_axes and not _able(moves, [row])[0]):
            raise ValueError(
                f"begin: expected {task.positions} positions that the table can do, "
                f"got {shown(begin.rotations)} from {', '.join(begin.start)}."
            )
        begun.append((row, float(task.values(trials.after([row]))[0])))
        tried += 1
    found = []
    for row, before in begun:
        end, after, more = _climb(task, trials, row, before, source)
        found.append(Climb(trials.scheme(*row), trials.scheme(*end), before, after))
        tried += more
    found = [found[i] for i in _in_order([climb.after for climb in found])]
    return SchemeDesign(found[0].end, found[0].after, found, drawn, tried)


def _climb(
    task: DesignTask, trials: _RowCovariances, row: Row, value: float, rng: np.random.Generator
) -> tuple[Row, float, int]:
    """Improve a row until no neighbour is better; also, how many were tried."""
    tried, better = 0, True
    while better:
        better = False
        near = _neighbours(trials.moves, *row)
        if task.two_axes:
            near = [near[i] for i in np.flatnonzero(_able(trials.moves, near))]
        order = rng.permutation(len(near))
        for first in range(0, len(near), _BLOCK):
            block = [near[i] for i in order[first : first + _BLOCK]]
            values = task.values(trials.after(block))
            tried += len(block)
            i = _in_order(values)[0]
            if values[i] < value * (1 - _GAIN):
                row, value, better = block[i], float(values[i]), True
                break
    return row, value, tried


def _neighbours(moves: _TableMoves, start: int, turns: IntArray) -> list[Row]:
    """Rows that differ in one turn, in the order of turns, or in the start."""
    found = [(other, turns) for other in range(24) if other != start]
    for place, turn in enumerate(turns):
        for other in range(len(moves.words)):
            if other != turn:
                changed = turns.copy()
                changed[place] = other
                found += [(start, changed), (start, moves.exchanged(start, turns, place, other))]
        left = np.delete(turns, place)
        for other in range(len(turns)):
            moved = np.insert(left, other, turn)
            if (moved != turns).any():
                found.append((start, moved))
    return found


def _able(moves: _TableMoves, rows: Sequence[Row]) -> NDArray[np.bool_]:
    starts, turns = (np.array(part) for part in zip(*rows, strict=True))
    return moves.on_two_axes(starts, turns)


def _in_order(values: FloatArray | Sequence[float]) -> IntArray:
    """Order of values to nine digits, equal ones as they come."""
    return np.argsort([float(f"{value:.9g}") for value in values], kind="stable")
