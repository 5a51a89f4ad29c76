"""Moves between rests in a record of increments, and which of them are whole turns."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, shown, whole_pairs, within

_TOLERANCE = 0.05
"""By which part of a turn a move may miss whole turns about an axis, along it and across."""
_STEADY = 0.05
"""A rest at whose rate, as a part of the fastest in the record, the unit turns steadily."""


class Move(NamedTuple):
    """From the middle of a rest to the middle of the next.

    Attributes
    ----------
    begin, end : int
        The first row, and the first that is left out.
    angle : ndarray, shape (3,)
        What its increments add up to, rad.
    still : ndarray, shape (3,)
        Mean increment in the two rests, rad.
    """

    begin: int
    end: int
    angle: FloatArray
    still: FloatArray


def moves(rows: FloatArray, rests: ArrayLike) -> Iterator[Move]:
    """Yield the moves of a record in order; rests of a steady turn do not part them."""
    within(rows, "increments", 2 * np.pi, "rad", "is it in degrees?")
    stops = _checked_rests(rests, len(rows))
    if len(stops):  # of none there is no usual rate
        stops = _without_steady_turns(rows, stops)
    for first, second in pairwise(stops):
        begin, end = int(first.sum()) // 2, int(second.sum()) // 2
        still = np.concatenate([rows[_middle(*rest)] for rest in (first, second)]).mean(axis=0)
        yield Move(begin, end, rows[begin:end].sum(axis=0), still)


def whole_turns(angle: FloatArray, directions: FloatArray) -> tuple[int, int]:
    """Return the axis that an angle is about most, and how many whole turns it is; 0 if none."""
    axis = int(np.argmax(np.abs(directions @ angle)))
    n, vector = directions[axis], angle / (2 * np.pi)
    along = float(vector @ n)
    turns = round(along)
    limit = min(_TOLERANCE * abs(turns), 0.5)
    missed = abs(along - turns) > limit or np.linalg.norm(vector - along * n) > limit
    return axis, 0 if missed else turns


def _middle(begin: int, end: int) -> slice:
    """The middle half of a rest: at its ends the hand may still be at work."""
    quarter = (end - begin) // 4
    return slice(begin + quarter, end - quarter)


def _without_steady_turns(rows: FloatArray, stops: np.ndarray) -> np.ndarray:
    """The rests whose rate is nearly that of most."""
    means = np.array([rows[_middle(*rest)].mean(axis=0) for rest in stops]).reshape(-1, 3)
    off = np.abs(means - np.median(means, axis=0)).max(axis=1)
    kept: np.ndarray = stops[off < _STEADY * np.abs(rows).max()]
    return kept


def _checked_rests(rests: ArrayLike, count: int) -> np.ndarray:
    stops = whole_pairs(rests, "rests")
    edges = stops.ravel()
    if len(edges) and (edges[0] < 0 or edges[-1] > count or (np.diff(edges) < 0).any()):
        raise ValueError(f"rests: expected rows from 0 to {count} in order, got {shown(rests)}.")
    if (np.diff(stops) < 4).any():
        raise ValueError(f"rests: expected four rows or more in each, got {shown(rests)}.")
    return stops
