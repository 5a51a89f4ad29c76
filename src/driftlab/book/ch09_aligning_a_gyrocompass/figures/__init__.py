"""The published figures of chapter 09, with their captions."""

import numpy as np

from driftlab.book.machinery.publish import FigureDefinition
from driftlab.checks import FloatArray

from . import alignment_budget, alignment_terms, averaging_window, over_the_vertical


def _largest(values: FloatArray) -> float:
    return float(np.degrees(np.abs(values).max()))


def _terms_caption(data: alignment_terms.AlignmentTerms) -> str:
    corrected = max(
        float(np.abs(data.terms[panel].sum(axis=-1) - data.exact[panel]).max())
        for panel in ("heading", "pitch")
    )
    printed = max(
        float(np.abs(data.printed[panel] - data.exact[panel]).max())
        for panel in ("heading", "pitch")
    )
    return (
        "The four terms of the alignment's heading error for one set of sensor errors given in "
        "North, Up, East, and the exact error beside their sum. In the first two panels the "
        f"formula with its misprint is off by up to {printed:.2f} degrees, without it by up to "
        f"{corrected:.1g}; toward the poles the misprint grows without bound."
    )


def _vertical_caption(data: over_the_vertical.OverTheVertical) -> str:
    return (
        "A body turned about its right axis, bow over the vertical. Left: its angles; half a turn "
        "of roll is 180 and −180 degrees at once. Right: errors of "
        f"{over_the_vertical.RUNS} alignments with random sensor errors: heading and roll reach "
        f"{_largest(data.heading_error):.0f} degrees half a degree from the vertical, while the "
        f"attitude stays within {_largest(data.attitude_error):.2f} degrees in root mean square, "
        "and heading plus roll with it."
    )


def _averaging_caption(data: averaging_window.AveragingWindow) -> str:
    gap = float(np.abs(data.simulated / data.formula - 1).max())
    return (
        f"Spread of the heading of {averaging_window.RUNS} alignments over the length of the "
        "averaging window, for the ends of the paper's range of gyro noise. White noise falls with "
        f"the square root; a slow part of {averaging_window.SLOW:g} degrees per hour sets a "
        f"floor. Simulation and closed formula differ by up to {gap:.0%}."
    )


FIGURES = (
    FigureDefinition(
        "09-alignment-budget",
        alignment_budget.compute,
        alignment_budget.AlignmentBudgetPicture,
        alignment_budget.columns,
        lambda data: (
            "Heading error of one aligned compass by term, and of the same compass at all "
            f"headings. The first order misses {_largest(data.bars[-1] - data.bars[-2]):.1g} "
            "degrees of the exact error here."
        ),
    ),
    FigureDefinition(
        "09-alignment-terms",
        alignment_terms.compute,
        alignment_terms.AlignmentTermsPicture,
        alignment_terms.columns,
        _terms_caption,
    ),
    FigureDefinition(
        "09-over-the-vertical",
        over_the_vertical.compute,
        over_the_vertical.OverTheVerticalPicture,
        over_the_vertical.columns,
        _vertical_caption,
    ),
    FigureDefinition(
        "09-averaging-window",
        averaging_window.compute,
        averaging_window.AveragingWindowPicture,
        averaging_window.columns,
        _averaging_caption,
    ),
)
