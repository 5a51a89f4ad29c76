"""What the lab sheet shows: a log with its rests and turns, and the table that is handed in."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.constants import degree

from driftlab.checks import FloatArray
from driftlab.drift.turns_by_hand import HandTurn, HandTurnFit, NearTurn

from ..machinery.figure.data_table import DataTable
from ..machinery.figure.drawing import Drawing, from_table
from ..machinery.figure.picture import GREY, SERIES, legend_above, legend_below_all
from ..machinery.figure.publish import FigureDefinition, PublishedFigure
from ..machinery.table import Table
from .offset_two_ways import RestRates

AXES = "xyz"
_ABOUT = ("about x", "about y", "about z")
DASH = "–"
_MOST_POINTS = 3000
"""Of a line in the picture; more cannot be seen."""


def turns_picture(
    increments: FloatArray,
    interval: float,
    static_intervals: FloatArray,
    turns: Sequence[HandTurn],
    near: Sequence[NearTurn] = (),
) -> PublishedFigure:
    """Draw the rates of a log over time, with its rests as bands and its turns by number.

    Moves that nearly were turns have a question mark. The picture's ``save("log.pdf", width=3.5)``
    puts it into a report.
    """
    step = max(1, len(increments) // _MOST_POINTS)
    seconds = interval * np.arange(len(increments), dtype=np.float64)[::step]
    begin, end = interval * np.asarray(static_intervals, dtype=float).T
    moves: list[HandTurn | NearTurn] = [*turns, *near]
    spans = np.array([_span(move) for move in moves]).reshape(-1, 2)
    table = DataTable(
        {
            "time": (seconds, "s", "since the start"),
            "rate": ((increments[::step] / interval).T, "deg_per_s", "rate measured", _ABOUT),
            "rest_begin": (begin, "s", "begin of each rest"),
            "rest_end": (end, "s", "end of each rest"),
            "turn": (
                [*map(str, range(1, len(turns) + 1)), *("?" for _ in near)], "",
                "number of a turn; a question mark for what nearly was one",
            ),
            "turn_begin": (spans[:, 0], "s", "begin of each turn"),
            "turn_end": (spans[:, 1], "s", "end of each turn"),
        },
        {"turns": ([f"{'+' if t.turns > 0 else '−'}{AXES[t.axis]}" for t in turns],)},
    )  # fmt: skip
    return _LogFigure(FigureDefinition("lab-turns", lambda: table, _draw, _caption), table)


class _LogFigure(PublishedFigure):
    """The picture of the reader's own log, which `driftlab.figure` does not know."""

    @property
    def call(self) -> str:
        return "turns_picture(increments, interval, rests, turns, near)"


def _span(move: HandTurn | NearTurn) -> FloatArray:
    """Begin and end (2,) of a move, s."""
    return move.seconds / (move.end - move.begin) * np.array([move.begin, move.end])


def _caption(table: DataTable) -> str:
    marks = table.turn.count("?")
    missed = {0: "", 1: " The question mark is at a move that nearly was a turn."}.get(
        marks, f" The {marks} question marks are at moves that nearly were turns."
    )
    return (
        f"What the three gyros said in {table.time[-1]:.0f} seconds. The bands are the "
        f"{len(table.rest_begin)} stretches that count as rests. Between them are "
        f"{len(table.turns)} whole turns: {', '.join(table.turns) or 'none'}."
        f"{missed}"
    )


@from_table
def _draw(drawing: Drawing) -> None:
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic("a", (10.0, 3.6), (0.07, 0.15, 0.99, 0.88), column_height=2.6)
    panel = panels["a"]
    drawing.spans(panel, "rest_begin", "rest_end", color=GREY, alpha=0.2, linewidth=0)
    width = 0.8 if sheet.on_paper else 1.2
    for name, style in zip(_ABOUT, SERIES, strict=False):
        drawing.curve(panel, "time", f"rate, {name}", **style, linewidth=width, label=name)
    highest = 1.18 * np.abs(table.rate).max() / degree
    for mark, *span in zip(table.turn, table.turn_begin, table.turn_end, strict=True):
        panel.text(np.mean(span), 0.97 * highest, mark, ha="center", va="top", fontsize="medium")
    panel.set(xlabel="time, s", ylabel="rate, deg/s", ylim=(-highest, highest))
    panel.set_xlim(table.time[0], table.time[-1])
    if sheet.on_paper:
        legend_below_all(drawing.figure, sheet, panel, ncols=3, column=3)
    else:
        legend_above(panel, ncols=3)


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
        f"you stop to ± {fit.stop_standard_deviation / degree:.2f}° (one standard deviation)\n"
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
