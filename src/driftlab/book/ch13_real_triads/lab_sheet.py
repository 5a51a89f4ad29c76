"""What the lab sheet shows: a log with its rests and turns, and the table that is handed in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import degree

from driftlab.checks import FloatArray
from driftlab.drift.missed_stops import NearTurn
from driftlab.drift.turns_by_hand import HandTurn, HandTurnFit

from ..machinery.picture import GREY, SERIES, in_style, legend_above, legend_below_all
from ..machinery.publish import FigureDefinition, PublishedFigure
from ..machinery.sheet import Sheet
from ..machinery.table import Table
from .offset_two_ways import RestRates

AXES = "xyz"
DASH = "–"
_MOST_POINTS = 3000
"""Of a line in the picture; more cannot be seen."""


class Log(NamedTuple):
    """A log as it is drawn."""

    seconds: FloatArray  # (n,), s
    rates: FloatArray  # (n, 3), rad/s
    rests: FloatArray  # (m, 2), begin and end of each rest, s
    turns: Sequence[HandTurn]
    near: Sequence[NearTurn]

    @property
    def moves(self) -> list[HandTurn | NearTurn]:
        """The turns, and then what nearly was one."""
        return [*self.turns, *self.near]


def turns_picture(
    increments: FloatArray,
    interval: float,
    rests: FloatArray,
    turns: Sequence[HandTurn],
    near: Sequence[NearTurn] = (),
) -> PublishedFigure:
    """Draw the rates of a log over time, with its rests as bands and its turns by number.

    Moves that nearly were turns have a question mark. The picture's ``save("log.pdf", width=3.5)``
    puts it into a report.
    """
    step = max(1, len(increments) // _MOST_POINTS)
    seconds = interval * np.arange(len(increments), dtype=np.float64)[::step]
    log = Log(
        seconds,
        increments[::step] / interval,
        interval * np.asarray(rests, dtype=float),
        turns,
        near,
    )
    return _LogFigure(FigureDefinition("lab-turns", lambda: log, _draw, _columns, _caption), log)


class _LogFigure(PublishedFigure):
    """The picture of the reader's own log, which `driftlab.figure` does not know."""

    @property
    def call(self) -> str:
        return "turns_picture(increments, interval, rests, turns, near)"


def _columns(log: Log) -> dict[str, Any]:
    """Columns of the picture's CSV: the rates as drawn; begin and end of rests and of turns."""
    spans = np.array([_span(move) for move in log.moves]).reshape(-1, 2)
    rates = log.rates.T / degree
    return {
        "time_s": log.seconds,
        **{f"rate_about_{axis}_deg_per_s": rate for axis, rate in zip(AXES, rates, strict=True)},
        **{f"rest_{end}_s": log.rests[:, k] for k, end in enumerate(("begin", "end"))},
        "turn": _marks(log),
        **{f"turn_{end}_s": spans[:, k] for k, end in enumerate(("begin", "end"))},
    }


def _marks(log: Log) -> list[str]:
    """What stands above each turn, and above each move that nearly was one."""
    return [*map(str, range(1, len(log.turns) + 1)), *("?" for _ in log.near)]


def _span(move: HandTurn | NearTurn) -> FloatArray:
    """Begin and end (2,) of a move, s."""
    return move.seconds / (move.end - move.begin) * np.array([move.begin, move.end])


def _caption(log: Log) -> str:
    names = ", ".join(f"{'+' if t.turns > 0 else '−'}{AXES[t.axis]}" for t in log.turns)
    missed = {
        0: "",
        1: " The question mark is at a move that nearly was a turn.",
    }.get(
        len(log.near), f" The {len(log.near)} question marks are at moves that nearly were turns."
    )
    return (
        f"What the three gyros said in {log.seconds[-1]:.0f} seconds. The bands are the "
        f"{len(log.rests)} stretches that count as rests. Between them are {len(log.turns)} "
        f"whole turns: {names or 'none'}."
        f"{missed}"
    )


@in_style
def _draw(log: Log, sheet: Sheet) -> Figure:
    figure, panels = sheet.mosaic("a", (10.0, 3.6), (0.07, 0.15, 0.99, 0.88), column_height=2.6)
    panel = panels["a"]
    for begin, end in log.rests:
        panel.axvspan(begin, end, color=GREY, alpha=0.2, linewidth=0)
    for name, style, rates in zip(AXES, SERIES, log.rates.T / degree, strict=False):
        panel.plot(
            log.seconds,
            rates,
            **style,
            linewidth=0.8 if sheet.on_paper else 1.2,
            label=f"about {name}",
        )
    highest = 1.18 * np.abs(log.rates).max() / degree
    for move, mark in zip(log.moves, _marks(log), strict=True):
        panel.text(
            _span(move).mean(), 0.97 * highest, mark, ha="center", va="top", fontsize="medium"
        )
    panel.set(xlabel="time, s", ylabel="rate, deg/s", ylim=(-highest, highest))
    panel.set_xlim(log.seconds[0], log.seconds[-1])
    if sheet.on_paper:
        legend_below_all(figure, sheet, panel, ncols=3, column=3)
    else:
        legend_above(panel, ncols=3)
    return figure


def turns_table(turns: Sequence[HandTurn], near: Sequence[NearTurn] = ()) -> Table:
    """A row for each turn: axis, sense, time, and what the gyro along the axis says too much.

    Moves that nearly were turns have a row too, with what they missed by.
    """
    head = ("turn", "about", "sense", "time", "Larin's estimate", "the same in degrees a turn")
    rows = [
        (
            turn.begin,
            str(number),
            AXES[turn.axis],
            "counter-clockwise" if turn.turns > 0 else "clockwise",
            f"{turn.seconds:.1f} s",
            f"{turn.estimate:+.5f}",
            f"{360 * turn.estimate:+.2f}°",
        )
        for number, turn in enumerate(turns, 1)
    ]
    rows += [
        (move.begin, "?", AXES[move.axis], _missed(move), f"{move.seconds:.1f} s", DASH, DASH)
        for move in near
    ]
    return Table([head, *(row[1:] for row in sorted(rows))])


def _missed(move: NearTurn) -> str:
    angle, across, reach = (f"{x / degree:.0f}°" for x in (move.angle, move.across, move.reach))
    way = f"reached {reach}, " if move.reach - abs(move.angle) > np.pi / 2 else ""
    return f"left out: {way}the gyros say {angle}, {across} across"


def stop_sentence(fit: HandTurnFit) -> str:
    """How well the hand stops, or that no turn is left to tell it by."""
    if fit.degrees_of_freedom == 0:
        return "no turn more than unknowns: how well you stop cannot be told"
    return (
        f"you stop to ± {fit.stop_deviation / degree:.2f}° (one standard deviation)\n"
        f"turns more than unknowns: {fit.degrees_of_freedom}"
    )


def result_table(fit: HandTurnFit, turns: Sequence[HandTurn], at_rest: RestRates) -> Table:
    """What is handed in: Larin's numbers with their intervals, and the offset in two ways."""
    head = ("axis", "turns", "Larin's number", "95 %", "offset by senses", "offset by rests")
    sigma_widths, offset_widths = fit.half_widths()
    rows = [
        (
            AXES[axis],
            str(sum(abs(turn.turns) for turn in turns if turn.axis == axis)),
            f"{fit.sigma[place]:+.5f}",
            _half_width(sigma_widths[place], 5),
            _rate(fit.offset[place], offset_widths[place]),
            _rate(at_rest.offset[place], at_rest.half_widths()[place]),
        )
        for place, axis in enumerate(fit.axes)
    ]
    return Table([head, *rows])


def rests_table(at_rest: RestRates) -> Table:
    """What each gyro says in the rests of each axis, in the mean: one row to an axis."""
    head = ("rests while turned about", "how many", *(f"gyro {axis} says" for axis in AXES))
    rows = [
        (AXES[axis], str(len(rates)), *(f"{each:+.3f} °/s" for each in rates.mean(axis=0) / degree))
        for axis, rates in zip(at_rest.axes, at_rest.rates, strict=True)
    ]
    return Table([head, *rows])


def _rate(value: float, half_width: float) -> str:
    told = f" {_half_width(half_width / degree, 3)}" if np.isfinite(half_width) else ""
    return f"{value / degree:+.3f}{told} °/s"


def _half_width(half: float, digits: int) -> str:
    """With its sign, or a dash if no turn is left to tell it by."""
    return f"± {half:.{digits}f}" if np.isfinite(half) else DASH
