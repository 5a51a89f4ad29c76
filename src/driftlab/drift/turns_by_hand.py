"""Whole turns by hand between rests: found in a record, and made into Larin's numbers.

A hand turns unevenly, which does no harm, and stops a little beside where it began, which does:
that is an error of the angle, and it looks like an error of the triad. Neighbouring turns share a
stop, so their errors are not independent, and the fit weighs them by that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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
)

from ._moves import moves, whole_turns
from .recorded_turns import recorded_turn_estimate


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
    rest_rate : float
        Mean rate along the axis in the two rests, rad/s: Earth and bias, if the axis has turned
        about itself.
    """

    axis: int
    turns: int
    begin: int
    end: int
    seconds: float
    estimate: float
    rest_rate: float


def hand_turns(
    increments: ArrayLike, interval: float, rests: ArrayLike, axes: ArrayLike = ()
) -> list[HandTurn]:
    """Find the whole turns about given axes among the moves between rests.

    Parameters
    ----------
    increments : array_like, shape (n, 3)
        Integrals of the rates that the gyros measure, rad.
    interval : float
        Time of a row, s.
    rests : array_like of int, shape (m, 2)
        Of each rest the first row, and the first that is left out; in order, each with four rows
        or more. A hand that turns steadily for a while looks like a rest, but for its rate; such
        ones are passed over.
    axes : array_like, shape (j, 3)
        Body axes that turns are looked for about; only their directions count. The three of the
        sensor if nothing is said.

    Returns
    -------
    list of HandTurn
        In order. Moves that are no whole turns about an axis, within 5 % of their angle along it
        and across it, are left out: somebody has put the sensor on another side, or has missed the
        stop, which `missed_stops.near_turns` tells.

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
    rows = finite_array(increments, "increments", 3)
    seconds = positive_number(interval, "interval")
    given = None if isinstance(axes, tuple | list) and not axes else axes
    directions, _ = nonzero_vectors(np.eye(3) if given is None else given, "axes")
    found = []
    for begin, end, angle, still in moves(rows, rests):
        axis, turns = whole_turns(angle, directions)
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
                rest_rate=rest_angle / seconds,
            )
        )
    return found


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
    sigma_deviation, offset_deviation : ndarray, shape (j,)
        Standard deviations, from the scatter of the turns; nan if there is no turn too many.
    stop_deviation : float
        Standard deviation of the angle at which a rest begins, rad, if all of the scatter is due
        to the stops.
    degrees_of_freedom : int
        Turns less unknowns, two to an axis.
    """

    axes: tuple[int, ...]
    sigma: FloatArray
    offset: FloatArray
    sigma_deviation: FloatArray
    offset_deviation: FloatArray
    stop_deviation: float
    degrees_of_freedom: int

    def half_widths(self, confidence: float = 0.95) -> tuple[FloatArray, FloatArray]:
        """Halves of the intervals in which the numbers lie with some confidence, by Student's t.

        Parameters
        ----------
        confidence : float
            Between 0 and 1, of each number for itself.

        Returns
        -------
        sigma, offset : ndarray, shape (j,)
            Without unit, and rad/s.

        Examples
        --------
        >>> ONE, ZERO = np.ones(1), np.zeros(1)
        >>> fit = HandTurnFit((2,), ZERO, ZERO, ONE, ONE, stop_deviation=0.1, degrees_of_freedom=6)
        >>> fit.half_widths()[0].round(2)
        array([2.45])
        """
        inside = probability(confidence, "confidence")
        factor = stdtrit(self.degrees_of_freedom, (1 + inside) / 2)
        return factor * self.sigma_deviation, factor * self.offset_deviation


def fit_hand_turns(turns: Sequence[HandTurn]) -> HandTurnFit:
    """Take the Earth and the bias out of turns by hand, by means of the two senses.

    The estimate of a turn is n^T Sigma n + o T / (2 pi k) plus the error of its angle over 2 pi k,
    with the offset o, the time T and the number k of turns, negative in the other sense. The angle
    of a turn errs by the difference of two stops, whose errors are taken for independent and
    alike; a stop between two turns is shared by them. This is generalised least squares.

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
    deviations = scatter * np.sqrt(np.diag(np.linalg.inv(weighed.T @ weighed)))
    count = len(axes)
    return HandTurnFit(
        axes=axes,
        sigma=found[:count],
        offset=found[count:],
        sigma_deviation=deviations[:count],
        offset_deviation=deviations[count:],
        stop_deviation=float(scatter),
        degrees_of_freedom=spare,
    )
