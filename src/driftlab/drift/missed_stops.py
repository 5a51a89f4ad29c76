"""Moves by hand that nearly were whole turns: passed over by the calibration, but not in silence.

Who stops thirty degrees too early, or does not hold still between two turns, should be told so.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import finite_array, nonzero_vectors, positive_number

from ._moves import moves, whole_turns

_NEARLY = 0.75
"""Of a turn: half way between a turn and the half turn that puts a sensor on its head."""


class NearTurn(NamedTuple):
    """A move that went far about an axis, yet is no whole turn about it.

    Attributes
    ----------
    axis : int
        The one that it went farthest about.
    angle : float
        About the axis when it had ended, rad, as the gyros say it: with their bias, by which a turn
        can be left out too.
    reach : float
        Between the two farthest angles about the axis on the way, rad, without bias: a turn there
        and back without a rest has none left, but reached a turn.
    across : float
        Angle across the axis when it had ended, rad.
    begin, end : int
        The first row of the increments, and the first that is left out.
    seconds : float
        From the one to the other, s.
    """

    axis: int
    angle: float
    reach: float
    across: float
    begin: int
    end: int
    seconds: float


def near_turns(
    increments: ArrayLike, interval: float, rests: ArrayLike, axes: ArrayLike = ()
) -> list[NearTurn]:
    """Find the moves that `turns_by_hand.hand_turns` leaves out though they went far about an axis.

    Parameters
    ----------
    increments : array_like, shape (n, 3)
        rad.
    interval : float
        s.
    rests : array_like of int, shape (m, 2)
        Rows.
    axes : array_like, shape (j, 3)
        All as `hand_turns` takes them.

    Returns
    -------
    list of NearTurn
        In order. Three quarters of a turn on the way count as far.

    Raises
    ------
    ValueError
        If rests overlap, are too short, or lie outside the record.

    Examples
    --------
    A turn that ends thirty degrees before the stop:

    >>> turn = np.tile([0.0, 0.0, np.radians(3.3)], (100, 1))
    >>> rest = np.zeros((20, 3))
    >>> rows = np.concatenate([rest, turn, rest])
    >>> (short,) = near_turns(rows, 0.1, [[0, 20], [120, 140]])
    >>> short.axis, f"{np.degrees(short.angle):.3f}"
    (2, '330.000')
    """
    rows = finite_array(increments, "increments", 3)
    seconds = positive_number(interval, "interval")
    given = None if isinstance(axes, tuple | list) and not axes else axes
    directions, _ = nonzero_vectors(np.eye(3) if given is None else given, "axes")
    found = []
    for begin, end, angle, still in moves(rows, rests):
        if whole_turns(angle, directions)[1]:
            continue
        way = np.cumsum(rows[begin:end] - still, axis=0) @ directions.T
        reach = np.ptp(way, axis=0)
        axis = int(np.argmax(reach))
        if reach[axis] > _NEARLY * 2 * np.pi:
            n = directions[axis]
            along = float(angle @ n)
            across = float(np.linalg.norm(angle - along * n))
            time = (end - begin) * seconds
            found.append(
                NearTurn(axis, along, float(reach[axis]), across, begin, end, seconds=time)
            )
    return found
