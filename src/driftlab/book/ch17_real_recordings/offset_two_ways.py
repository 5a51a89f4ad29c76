"""The offset of each gyro told in two ways, and whether chance alone sets the two apart.

The two senses of the turns tell the offset of Earth and bias, and so do the rests between them. All
axes are tried at once, because of three tests of five per cent one fails in every seventh log. And
a whole turn brings the unit back to where it was, so all rests of one axis should say the same, the
Earth included; a unit that corrects itself in the middle does not.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.special import fdtrc, stdtrit

from driftlab.checks import FloatArray
from driftlab.drift.turns_by_hand import HandTurn, HandTurnFit

DOUBT_TWO_WAYS = 0.05
"""The two ways are said to differ if chance sets them so far apart in less than this part of the
logs."""
DOUBT_RESTS = 0.01
"""The same of the rests of one axis. It is less, for a good unit's bias wanders a little too."""


class RestRates(NamedTuple):
    """What the gyros say in the rests between whole turns."""

    axes: tuple[int, ...]  # which were turned about
    # (m, 3) each, for each of these axes, of each rest before, between and after its turns, rad/s
    rates: tuple[FloatArray, ...]
    # standard deviation of one of these numbers, from the two halves of each rest, rad/s
    deviation: float
    degrees_of_freedom: int  # of `deviation`

    @property
    def offset(self) -> FloatArray:
        """Mean rate along each axis in its own rests, rad/s: shape (j,)."""
        pairs = zip(self.axes, self.rates, strict=True)
        return np.array([rates[:, axis].mean() for axis, rates in pairs])

    @property
    def offset_standard_deviation(self) -> FloatArray:
        """Standard deviations of `offset`, rad/s: shape (j,)."""
        return self.deviation / np.sqrt([len(rates) for rates in self.rates])

    def half_widths(self) -> FloatArray:
        """Halves of the intervals in which each offset lies with 95 %, rad/s: shape (j,)."""
        widths: FloatArray = (
            stdtrit(self.degrees_of_freedom, 0.975) * self.offset_standard_deviation
        )
        return widths


def rest_rates(
    increments: FloatArray, interval: float, static_intervals: FloatArray, turns: Sequence[HandTurn]
) -> RestRates:
    """Take from a log what its gyros say in the rests that turns begin and end in."""
    begin, end = np.asarray(static_intervals).T
    axes = tuple(sorted({turn.axis for turn in turns}))
    of_axis = []
    for axis in axes:
        rows = {row for turn in turns if turn.axis == axis for row in (turn.begin, turn.end)}
        of_axis.append([int(np.flatnonzero((begin <= r) & (r < end))[0]) for r in sorted(rows)])
    halves = np.array(
        [
            [increments[b : (b + e) // 2].mean(axis=0), increments[(b + e) // 2 : e].mean(axis=0)]
            for b, e in zip(begin, end, strict=True)
        ]
    )
    halves /= interval
    used = sorted({place for places in of_axis for place in places})
    apart = halves[used, 1] - halves[used, 0]
    return RestRates(
        axes,
        tuple(halves[rows].mean(axis=1) for rows in of_axis),
        float(np.sqrt(np.mean(apart**2))) / 2,
        apart.size,
    )


def chance_of_two_ways(fit: HandTurnFit, at_rest: RestRates) -> float:
    """How often chance sets the two ways as far apart as here, or farther; nan if nobody can tell.

    The squares of the differences, each as a part of its variance, are added up over the axes. The
    variance is the sum of two estimated ones; Welch and Satterthwaite give its degrees of freedom.
    """
    if fit.degrees_of_freedom == 0:
        return float("nan")
    by_turns, by_rests = fit.offset_standard_deviation**2, at_rest.offset_standard_deviation**2
    variance = by_turns + by_rests
    spread = by_turns**2 / fit.degrees_of_freedom + by_rests**2 / at_rest.degrees_of_freedom
    freedom = np.mean(variance**2 / spread)
    apart = np.mean((fit.offset - at_rest.offset) ** 2 / variance)
    return float(fdtrc(len(fit.axes), freedom, apart))


def chance_of_rests(at_rest: RestRates) -> float:
    """How often chance sets the rests of the same axis as far apart as here, or farther."""
    squares = sum(float(np.sum((rates - rates.mean(axis=0)) ** 2)) for rates in at_rest.rates)
    freedom = sum(3 * (len(rates) - 1) for rates in at_rest.rates)
    ratio = squares / freedom / at_rest.deviation**2
    return float(fdtrc(freedom, at_rest.degrees_of_freedom, ratio))


def verdicts(fit: HandTurnFit, at_rest: RestRates) -> str:
    """Two sentences: do the two ways agree, and do the rests of one axis agree among themselves?"""
    chance, steady = chance_of_two_ways(fit, at_rest), chance_of_rests(at_rest)
    if np.isnan(chance):
        first = "No turn too many: whether the two ways agree cannot be told."
    else:
        says = "do not agree" if chance < DOUBT_TWO_WAYS else "agree"
        first = f"The two ways {says}: chance alone sets them so far apart in {_part(chance)}."
    says = "do not agree" if steady < DOUBT_RESTS else "agree"
    second = f"The rests of the same axis {says}: chance does that in {_part(steady)}."
    return f"{first}\n{second}"


def _part(chance: float) -> str:
    hundredths = 100 * chance
    return f"{hundredths:.0f} of 100 logs" if hundredths >= 1 else "less than 1 of 100 logs"
