"""The published figures of chapter 13, with their captions."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition
from driftlab.checks import FloatArray

from .. import experiments
from . import alignment_budget, alignment_terms, averaging_window, over_the_vertical, two_positions


def _largest(values: FloatArray) -> float:
    return float(np.degrees(np.abs(values).max()))


def _terms_caption(data: DataTable) -> str:
    def off(which: str) -> float:
        errors = data.error_over_heading, data.error_over_pitch
        return max(_largest(each[which] - each["exact"]) for each in errors)

    return (
        "The four terms of the alignment's heading error for one set of sensor errors given in "
        "North, Up, East, and the exact error beside their sum. In the first two panels the "
        f"copy's formula is off by up to {off('as in the copy'):.2f} degrees, without its stray "
        f"factor by up to {off('corrected'):.1g}; toward the poles that factor grows without bound."
    )


def _vertical_caption(data: DataTable) -> str:
    return (
        "A body turned about its right axis, bow over the vertical. First its angles; half a turn "
        "of roll is 180 and −180 degrees at once. Then errors of "
        f"{data.runs} alignments with random sensor errors: heading and roll reach "
        f"{_largest(data.heading_error):.0f} degrees beside the vertical, while the "
        f"attitude stays within {_largest(data.attitude_error):.2f} degrees in root mean square."
    )


def _gap(*spreads: FloatArray) -> float:
    """The largest part by which simulation and closed formula differ."""
    return max(float(np.abs(each[:, 0] / each[:, 1] - 1).max()) for each in spreads)


def _averaging_caption(data: DataTable) -> str:
    (apart,) = (data.spread[1, 1] / data.rival_spread[1, 1])[data.samples == 6000]
    return (
        f"Spread of the heading of {data.runs} alignments over the length of the averaging window, "
        "for a quiet and a noisy gyro, published for the ends of the paper's range. Two readings "
        "of the paper's averages. First white noise and a slow part of "
        f"{data.shown('gauss_markov'):.3g} degrees per hour, which sets a floor. Then "
        "white noise as in the quiet gyro, and a rounded angle, which falls with the "
        f"window itself. After ten minutes the noisy gyro would differ by a factor of {apart:.0f}. "
        f"Simulation and closed formula differ by up to {_gap(data.spread, data.rival_spread):.0%}."
    )


def _positions_caption(data: DataTable) -> str:
    one, two, carried = np.degrees(data.by_time[:, 1, -1])
    return (
        "Spread of the heading of units at rest whose gyros have white noise and a slow part, "
        "published as in the quiet ones of the averaging figure. First a turn between two "
        f"positions, over its angle, {data.duration / 60:g} minutes in all. Then over the time. "
        f"After {data.time[-1] / 60:g} minutes one position has {one:.3f} degrees left, gravity "
        f"in inertial space {carried:.3f}, and two positions half a turn apart {two:.3f}. Marks "
        f"are {data.units} simulated units each, lines the closed "
        f"forms; they differ by up to {_gap(data.by_turn, data.by_time):.0%}."
    )


FIGURES = (
    FigureDefinition(
        "13-alignment-budget",
        experiments.alignment_budget,
        alignment_budget.AlignmentBudgetPicture.draw,
        lambda data: (
            "Heading error of one aligned compass by term, and of the same compass at all "
            f"headings. The first order misses {_largest(data.error[-1] - data.error[-2]):.1g} "
            "degrees of the exact error here."
        ),
    ),
    FigureDefinition(
        "13-alignment-terms", experiments.alignment_terms, alignment_terms.draw, _terms_caption
    ),
    FigureDefinition(
        "13-over-the-vertical",
        experiments.errors_over_the_vertical,
        over_the_vertical.draw,
        _vertical_caption,
    ),
    FigureDefinition(
        "13-averaging-window",
        experiments.heading_spread_by_window,
        averaging_window.draw,
        _averaging_caption,
    ),
    FigureDefinition(
        "13-two-positions", experiments.two_positions, two_positions.draw, _positions_caption
    ),
)
