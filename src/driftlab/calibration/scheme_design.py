"""Scheme design: turns of a table after which the sensor errors are known best."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray, checked_generator, checked_instance, shown, whole_number
from driftlab.motion.scheme import Scheme, checked_scheme

from ._row_covariances import RowCovariances
from ._table_moves import IntArray, Row, TableMoves
from .design_task import DesignTask

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

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> task = DesignTask(positions=3, angles=(90,))
    >>> first = design_scheme(task, rng, draws=9, climbs=1).climbs[0]
    >>> first.after < first.before
    True
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

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> design = design_scheme(DesignTask(positions=3, angles=(90,)), rng, draws=9, climbs=1)
    >>> bool(design.value == design.climbs[0].after <= design.drawn.min())
    True
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
    are the common way to D-optimal plans of experiments: Fedorov, *Theory of Optimal Experiments*,
    Academic Press, 1972.

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
    task: DesignTask, trials: RowCovariances, row: Row, value: float, rng: np.random.Generator
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


def _neighbours(moves: TableMoves, start: int, turns: IntArray) -> list[Row]:
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


def _able(moves: TableMoves, rows: Sequence[Row]) -> NDArray[np.bool_]:
    starts, turns = (np.array(part) for part in zip(*rows, strict=True))
    return moves.on_two_axes(starts, turns)


def _in_order(values: FloatArray | Sequence[float]) -> IntArray:
    """Order of values to nine digits, equal ones as they come."""
    return np.argsort([float(f"{value:.9g}") for value in values], kind="stable")
