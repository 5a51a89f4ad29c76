"""The published figures of chapter 09, with their captions."""

import numpy as np

from driftlab.book.machinery.publish import FigureDefinition
from driftlab.checks import FloatArray

from .. import experiments
from . import (
    alignment_budget,
    alignment_terms,
    averaging_window,
    over_the_vertical,
    two_positions,
)


def _largest(values: FloatArray) -> float:
    return float(np.degrees(np.abs(values).max()))


def _terms_caption(data: experiments.AlignmentTerms) -> str:
    corrected = max(
        float(np.abs(data.terms[panel].sum(axis=-1) - data.exact[panel]).max())
        for panel in ("heading", "pitch")
    )
    in_copy = max(
        float(np.abs(data.in_copy[panel] - data.exact[panel]).max())
        for panel in ("heading", "pitch")
    )
    return (
        "The four terms of the alignment's heading error for one set of sensor errors given in "
        "North, Up, East, and the exact error beside their sum. In the first two panels the "
        f"copy's formula is off by up to {in_copy:.2f} degrees, without its stray factor by up to "
        f"{corrected:.1g}; toward the poles that factor grows without bound."
    )


def _vertical_caption(data: experiments.OverTheVertical) -> str:
    return (
        "A body turned about its right axis, bow over the vertical. First its angles; half a turn "
        "of roll is 180 and −180 degrees at once. Then errors of "
        f"{data.runs} alignments with random sensor errors: heading and roll reach "
        f"{_largest(data.heading_error):.0f} degrees beside the vertical, while the "
        f"attitude stays within {_largest(data.attitude_error):.2f} degrees in root mean square."
    )


def _averaging_caption(data: experiments.AveragingWindow) -> str:
    pairs = ((data.simulated, data.formula), (data.rival_simulated, data.rival_formula))
    gap = max(float(np.abs(simulated / formula - 1).max()) for simulated, formula in pairs)
    long = data.windows == 6000
    apart = float((data.formula[1] / data.rival_formula[1])[long][0])
    return (
        f"Spread of the heading of {data.runs} alignments over the length of the averaging window, "
        "for a quiet and a noisy gyro, published for the ends of the paper's range. Two readings "
        "of the paper's averages. First white noise and a slow part of "
        f"{data.slow / experiments.DEGREE_PER_HOUR:.3g} degrees per hour, which sets a floor. Then "
        "white noise as in the quiet gyro, and a rounded angle, which falls with the "
        f"window itself. After ten minutes the noisy gyro would differ by a factor of {apart:.0f}. "
        f"Simulation and closed formula differ by up to {gap:.0%}."
    )


def _positions_caption(data: experiments.TwoPositions) -> str:
    one, two, carried = np.degrees(data.by_time_formula[:, -1])
    pairs = ((data.by_turn, data.by_turn_formula), (data.by_time, data.by_time_formula))
    gap = max(float(np.abs(simulated / formula - 1).max()) for simulated, formula in pairs)
    return (
        "Spread of the heading of units at rest whose gyros have white noise and a slow part, "
        "published as in the quiet ones of the averaging figure. First a turn between two "
        f"positions, over its angle, {data.duration / 60:g} minutes in all. Then over the time. "
        f"After {data.times[-1] / 60:g} minutes one position has {one:.3f} degrees left, gravity "
        f"in inertial space {carried:.3f}, and two positions half a turn apart {two:.3f}. Marks "
        f"are {data.units} simulated units each, lines the closed "
        f"forms; they differ by up to {gap:.0%}."
    )


FIGURES = (
    FigureDefinition(
        "09-alignment-budget",
        experiments.alignment_budget,
        alignment_budget.AlignmentBudgetPicture.draw,
        alignment_budget.columns,
        lambda data: (
            "Heading error of one aligned compass by term, and of the same compass at all "
            f"headings. The first order misses {_largest(data.bars[-1] - data.bars[-2]):.1g} "
            "degrees of the exact error here."
        ),
    ),
    FigureDefinition(
        "09-alignment-terms",
        experiments.alignment_terms,
        alignment_terms.draw,
        alignment_terms.columns,
        _terms_caption,
    ),
    FigureDefinition(
        "09-over-the-vertical",
        experiments.errors_over_the_vertical,
        over_the_vertical.draw,
        over_the_vertical.columns,
        _vertical_caption,
    ),
    FigureDefinition(
        "09-averaging-window",
        experiments.heading_spread_by_window,
        averaging_window.draw,
        averaging_window.columns,
        _averaging_caption,
    ),
    FigureDefinition(
        "09-two-positions",
        experiments.two_positions,
        two_positions.draw,
        two_positions.columns,
        _positions_caption,
    ),
)
