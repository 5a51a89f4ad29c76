"""Whole turns by hand between rests: found in a record, and made into Larin's numbers.

A hand turns unevenly, which does no harm, and stops a little beside where it began, which looks
like an error of the triad. Neighbouring turns share a stop, so their errors are not independent,
and the fit weighs them by that.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import stdtrit

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_arrays,
    nonzero_vectors,
    positive_number,
    probability,
    shown,
    whole_pairs,
    within,
)

from .recorded_turns import recorded_turn_estimate

_TOLERANCE = 0.05
"""By which part of a turn a move may miss whole turns about an axis, along it and across."""
_STEADY = 0.05
"""A rest at whose rate, as a part of the fastest in the record, the unit turns steadily."""
_NEARLY = 0.75
"""Of a turn: half way between a turn and the half turn that puts a sensor on its head."""


@dataclass(frozen=True)
class HandTurn:
    """Whole turns about one axis, from the middle of a rest to the middle of the next.

    Attributes
    ----------
    axis : int
        Which of the axes.
    turns : int
        How many; the sign is the sense, positive counter-clockwise about the axis.
    begin, end : int
        The first row of the increments, and the first that is left out.
    seconds : float
        From the one to the other, s.
    estimate : float
        Larin's n^T Sigma n with the offset of Earth and bias in it, without unit.
    static_rate : float
        Mean rate along the axis in the two rests, rad/s: Earth and bias, if the axis has turned
        about itself.
    """

    axis: int
    turns: int
    begin: int
    end: int
    seconds: float
    estimate: float
    static_rate: float


def hand_turns(
    increments: ArrayLike, interval: float, static_intervals: ArrayLike, axes: ArrayLike = ()
) -> list[HandTurn]:
    """Find the whole turns about given axes among the moves between rests.

    Parameters
    ----------
    increments : array_like, shape (n, 3)
        Integrals of the rates that the gyros measure, rad.
    interval : float
        Time of a row, s.
    static_intervals : array_like of int, shape (m, 2)
        Of each rest the first row, and the first that is left out; in order, each with four rows
        or more. Steady turns among them are passed over.
    axes : array_like, shape (j, 3)
        Body axes that turns are looked for about; only their directions count. The three of the
        sensor if nothing is said.

    Returns
    -------
    list of HandTurn
        In order. Moves that are no whole turns about an axis, within 5 % of their angle along it
        and across it, are left out; `near_turns` finds those that missed the stop.

    Raises
    ------
    ValueError
        If rests overlap, are too short, or lie outside the record.

    Examples
    --------
    A turn each way about the third axis, by a gyro that says one per cent too much:

    >>> turn = np.tile([0.0, 0.0, 1.01 * np.pi / 50], (100, 1))
    >>> rest = np.zeros((20, 3))
    >>> rows = np.concatenate([rest, turn, rest, -turn, rest])
    >>> found = hand_turns(rows, 0.1, [[0, 20], [120, 140], [240, 260]])
    >>> [(each.axis, each.turns, round(each.estimate, 6)) for each in found]
    [(2, 1, 0.01), (2, -1, 0.01)]
    """
    rows, seconds, directions = _checked(increments, interval, axes)
    found = []
    for begin, end, angle, still in _moves(rows, static_intervals):
        axis, turns = _whole_turns(angle, directions)
        if not turns:
            continue
        n = directions[axis]
        rest_angle = float(still @ n)
        # A bias across the axis does harm by its square, alike in both senses; rests show it.
        turned = rows[begin:end] - (still - rest_angle * n)
        found.append(
            HandTurn(
                axis=axis,
                turns=turns,
                begin=begin,
                end=end,
                seconds=(end - begin) * seconds,
                estimate=float(recorded_turn_estimate(turned, n, abs(turns))),
                static_rate=rest_angle / seconds,
            )
        )
    return found


class NearTurn(NamedTuple):
    """A move that went far about an axis, yet is no whole turn about it.

    Attributes
    ----------
    axis : int
        The one that it went farthest about.
    angle : float
        About the axis when it had ended, rad, with the bias of the gyros.
    reach : float
        Between the two farthest angles about the axis on the way, rad, without bias.
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
    increments: ArrayLike, interval: float, static_intervals: ArrayLike, axes: ArrayLike = ()
) -> list[NearTurn]:
    """Find the moves that `hand_turns` leaves out though they went far about an axis.

    Parameters
    ----------
    increments : array_like, shape (n, 3)
        rad; this and the others as in `hand_turns`.
    interval : float
        s.
    static_intervals : array_like of int, shape (m, 2)
        Rows.
    axes : array_like, shape (j, 3)
        Body axes.

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
    rows, seconds, directions = _checked(increments, interval, axes)
    found = []
    for begin, end, angle, still in _moves(rows, static_intervals):
        if _whole_turns(angle, directions)[1]:
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


def _checked(
    increments: ArrayLike, interval: float, axes: ArrayLike
) -> tuple[FloatArray, float, FloatArray]:
    """Increments (n, 3), rad, their interval, s, and unit axes (j, 3), by default the sensor's."""
    rows = finite_array(increments, "increments", 3)
    seconds = positive_number(interval, "interval")
    none = axes is None or (isinstance(axes, tuple | list) and not axes)
    return rows, seconds, nonzero_vectors(np.eye(3) if none else axes, "axes")[0]


class _Move(NamedTuple):
    """From the middle of a rest to the middle of the next."""

    begin: int
    end: int  # the first row that is left out
    angle: FloatArray  # (3,), what its increments add up to, rad
    still: FloatArray  # (3,), mean increment in the two rests, rad


def _moves(rows: FloatArray, static_intervals: ArrayLike) -> Iterator[_Move]:
    """Yield the moves of a record in order; rests of a steady turn do not part them."""
    within(rows, "increments", 2 * np.pi, "rad", "is it in degrees?")
    stops = _checked_rests(static_intervals, len(rows))
    if len(stops):  # of none there is no usual rate
        stops = _without_steady_turns(rows, stops)
    for first, second in pairwise(stops):
        begin, end = int(first.sum()) // 2, int(second.sum()) // 2
        still = np.concatenate([rows[_middle(*rest)] for rest in (first, second)]).mean(axis=0)
        yield _Move(begin, end, rows[begin:end].sum(axis=0), still)


def _whole_turns(angle: FloatArray, directions: FloatArray) -> tuple[int, int]:
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


def _checked_rests(static_intervals: ArrayLike, count: int) -> np.ndarray:
    stops = whole_pairs(static_intervals, "static_intervals")
    edges = stops.ravel()
    if len(edges) and (edges[0] < 0 or edges[-1] > count or (np.diff(edges) < 0).any()):
        raise ValueError(
            f"static_intervals: expected rows from 0 to {count} in order, "
            f"got {shown(static_intervals)}."
        )
    if (np.diff(stops) < 4).any():
        raise ValueError(
            f"static_intervals: expected four rows or more in each, got {shown(static_intervals)}."
        )
    return stops


@dataclass(frozen=True, eq=False)
class HandTurnFit:
    """Larin's numbers from turns by hand, without the Earth and the bias.

    Attributes
    ----------
    axes : tuple of int
        Which axes were turned about.
    sigma : ndarray, shape (j,)
        Of each of these n^T Sigma n: of a sensor's own axis its scale-factor error, without unit.
    offset : ndarray, shape (j,)
        Earth and bias along each axis, rad/s, as the two senses tell them.
    sigma_standard_deviation, offset_standard_deviation : ndarray, shape (j,)
        Standard deviations, from the scatter of the turns; nan if there is no turn too many.
    stop_standard_deviation : float
        Standard deviation of the stops, rad, if all of the scatter is due to them.
    degrees_of_freedom : int
        Turns less unknowns, two to an axis.
    """

    axes: tuple[int, ...]
    sigma: FloatArray
    offset: FloatArray
    sigma_standard_deviation: FloatArray
    offset_standard_deviation: FloatArray
    stop_standard_deviation: float
    degrees_of_freedom: int

    def half_widths(self, confidence: float = 0.95) -> tuple[FloatArray, FloatArray]:
        """Half widths (j,) of confidence intervals: of sigma, and of offset in rad/s."""
        inside = probability(confidence, "confidence")
        factor = stdtrit(self.degrees_of_freedom, (1 + inside) / 2)
        return factor * self.sigma_standard_deviation, factor * self.offset_standard_deviation


def fit_hand_turns(turns: Sequence[HandTurn]) -> HandTurnFit:
    """Take the Earth and the bias out of turns by hand, by means of the two senses.

    The estimate of a turn is n^T Sigma n + o T / (2 pi k) plus the error of its angle over 2 pi k,
    with the offset o, the time T and the number k of turns, negative in the other sense. The angle
    errs by the difference of two stops, whose errors are taken for independent and alike;
    neighbouring turns share one. This is generalised least squares.

    Parameters
    ----------
    turns : sequence of HandTurn
        In both senses about each axis.

    Returns
    -------
    HandTurnFit

    Raises
    ------
    ValueError
        If an axis was turned about in one sense only, there are no turns, a turn has no angle or
        takes no time, or one of them follows from others, as the same one twice.

    Examples
    --------
    Both senses, and a bias that would show as one per cent:

    >>> there = HandTurn(2, 1, 0, 100, 10.0, 0.02, 0.0)
    >>> back = HandTurn(2, -1, 100, 200, 10.0, 0.00, 0.0)
    >>> fit = fit_hand_turns([there, back])
    >>> print(fit.sigma.round(6), np.degrees(fit.offset).round(3))
    [0.01] [0.36]
    """
    if not isinstance(turns, Sequence) or not all(isinstance(turn, HandTurn) for turn in turns):
        raise ValueError(f"turns: expected a list of HandTurn from hand_turns, got {shown(turns)}.")
    if not turns:
        raise ValueError("turns: expected whole turns, got none.")
    for turn in turns:
        if not (turn.turns and turn.seconds > 0 and turn.begin < turn.end):
            raise ValueError(f"turns: expected whole turns that take some time, got {turn}.")
    axes = tuple(sorted({turn.axis for turn in turns}))
    for axis in axes:
        senses = {np.sign(turn.turns) for turn in turns if turn.axis == axis}
        if len(senses) < 2:
            raise ValueError(f"turns: expected both senses about axis {axis}, got one only.")
    angle = 2 * np.pi * np.array([turn.turns for turn in turns], dtype=float)
    seconds, estimates = finite_arrays(
        seconds=([turn.seconds for turn in turns],), estimates=([t.estimate for t in turns],)
    )
    place = np.array([axes.index(turn.axis) for turn in turns])
    on_axis = place[:, np.newaxis] == np.arange(len(axes))
    design = np.hstack([on_axis, on_axis * (seconds / angle)[:, np.newaxis]])
    rows = sorted({row for turn in turns for row in (turn.begin, turn.end)})
    stops = np.zeros((len(turns), len(rows)))
    for i, turn in enumerate(turns):
        stops[i, rows.index(turn.end)] = 1
        stops[i, rows.index(turn.begin)] = -1
    if np.linalg.matrix_rank(stops) < len(turns):
        raise ValueError(
            "turns: expected turns of which none follows from the others, got one twice, or a ring "
            "of turns between the same stops."
        )
    stops /= angle[:, np.newaxis]
    root = np.linalg.cholesky(stops @ stops.T)
    weighed, right = np.linalg.solve(root, design), np.linalg.solve(root, estimates)
    found = np.linalg.lstsq(weighed, right, rcond=None)[0]
    spare = len(turns) - 2 * len(axes)
    scatter = float(np.linalg.norm(right - weighed @ found)) / np.sqrt(spare) if spare else np.nan
    standard_deviations = scatter * np.sqrt(np.diag(np.linalg.inv(weighed.T @ weighed)))
    count = len(axes)
    return HandTurnFit(
        axes=axes,
        sigma=found[:count],
        offset=found[count:],
        sigma_standard_deviation=standard_deviations[:count],
        offset_standard_deviation=standard_deviations[count:],
        stop_standard_deviation=float(scatter),
        degrees_of_freedom=spare,
    )
