"""What the lab sheet shows: a log with its rests and turns, and the table that is handed in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import degree

from driftlab.checks import FloatArray
from driftlab.drift.turns_by_hand import HandTurn, HandTurnFit

from ..machinery.picture import GREY, SERIES, in_style, legend_above
from ..machinery.publish import FigureDefinition, PublishedFigure
from ..machinery.table import Table

AXES = "xyz"
_MOST_POINTS = 3000
"""Of a line in the picture; more cannot be seen."""


class Log(NamedTuple):
    """A log as it is drawn.

    Attributes
    ----------
    seconds : ndarray, shape (n,)
        s.
    rates : ndarray, shape (n, 3)
        rad/s.
    rests : ndarray, shape (m, 2)
        Begin and end of each rest, s.
    turns : sequence of HandTurn
    """

    seconds: FloatArray
    rates: FloatArray
    rests: FloatArray
    turns: Sequence[HandTurn]


def turns_picture(
    increments: FloatArray, interval: float, rests: FloatArray, turns: Sequence[HandTurn]
) -> PublishedFigure:
    """Draw the rates of a log over time, with its rests as bands and its turns by number.

    Parameters
    ----------
    increments : ndarray, shape (n, 3)
        rad.
    interval : float
        s.
    rests : array_like of int, shape (m, 2)
        Rows.
    turns : sequence of HandTurn
        As `driftlab.drift.turns_by_hand.hand_turns` found them.
    """
    step = max(1, len(increments) // _MOST_POINTS)
    seconds = interval * np.arange(len(increments), dtype=np.float64)[::step]
    log = Log(
        seconds,
        increments[::step] / interval,
        interval * np.asarray(rests, dtype=float),
        turns,
    )
    return PublishedFigure(FigureDefinition("lab-turns", lambda: log, _draw, None, _caption), log)


def _caption(log: Log) -> str:
    names = ", ".join(f"{'+' if t.turns > 0 else '−'}{AXES[t.axis]}" for t in log.turns)
    return (
        f"What the three gyros said in {log.seconds[-1]:.0f} seconds. The bands are the "
        f"{len(log.rests)} stretches that count as rests. Between them are {len(log.turns)} "
        f"whole turns: {names or 'none'}."
    )


@in_style
def _draw(log: Log) -> Figure:
    figure = Figure(figsize=(10.0, 3.6))
    panel = figure.subplots()
    figure.subplots_adjust(0.07, 0.15, 0.99, 0.88)
    for begin, end in log.rests:
        panel.axvspan(begin, end, color=GREY, alpha=0.2, linewidth=0)
    for name, style, rates in zip(AXES, SERIES, log.rates.T / degree, strict=False):
        panel.plot(log.seconds, rates, **style, linewidth=1.2, label=f"about {name}")
    highest = 1.18 * np.abs(log.rates).max() / degree
    interval = [t.seconds / (t.end - t.begin) for t in log.turns]
    for number, (turn, second) in enumerate(zip(log.turns, interval, strict=True), 1):
        middle = second * (turn.begin + turn.end) / 2
        panel.text(middle, 0.97 * highest, str(number), ha="center", va="top", fontsize=9)
    panel.set(xlabel="time, s", ylabel="rate, deg/s", ylim=(-highest, highest))
    panel.set_xlim(log.seconds[0], log.seconds[-1])
    legend_above(panel, ncols=3)
    return figure


def turns_table(turns: Sequence[HandTurn]) -> Table:
    """A row for each turn: axis, sense, time, and what the gyro along the axis says too much."""
    head = ("turn", "about", "sense", "time", "Larin's estimate", "the same in degrees a turn")
    rows = [
        (
            str(number),
            AXES[turn.axis],
            "counter-clockwise" if turn.turns > 0 else "clockwise",
            f"{turn.seconds:.1f} s",
            f"{turn.estimate:+.5f}",
            f"{360 * turn.estimate:+.2f}°",
        )
        for number, turn in enumerate(turns, 1)
    ]
    return Table([head, *rows])


def result_table(fit: HandTurnFit, turns: Sequence[HandTurn]) -> Table:
    """What is handed in: Larin's numbers with their intervals, and the offset in two ways."""
    head = ("axis", "turns", "Larin's number", "95 %", "offset by senses", "offset by rests")
    sigma_widths, offset_widths = fit.half_widths()
    rows = []
    for place, axis in enumerate(fit.axes):
        own = [turn for turn in turns if turn.axis == axis]
        at_rest = np.mean([turn.rest_rate for turn in own]) / degree
        offset, half = fit.offset[place] / degree, offset_widths[place] / degree
        rows.append(
            (
                AXES[axis],
                str(sum(abs(turn.turns) for turn in own)),
                f"{fit.sigma[place]:+.5f}",
                f"± {sigma_widths[place]:.5f}",
                f"{offset:+.3f} ± {half:.3f} °/s",
                f"{at_rest:+.3f} °/s",
            )
        )
    return Table([head, *rows])
