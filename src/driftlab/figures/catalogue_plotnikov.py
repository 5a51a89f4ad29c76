"""The published figures of Part IV."""

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, hour

from ..checks import FloatArray
from ..compass_voyage import TURN, ErrorsUnderWay
from . import (
    alignment_budget,
    alignment_terms,
    averaging_window,
    ballistic_error,
    capstone,
    operating_formula,
    operation,
    over_the_vertical,
    restarts,
    settling,
    static_characteristic,
)
from .entry import Entry


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


def _settling_caption(data: settling.Settling) -> str:
    return (
        "Left: a horizon that is half a degree out of level and does not know where North is "
        f"settles; the heading error ends at {np.degrees(data.settling_heading[-1]):.1g} degrees. "
        f"Right: {settling.RUNS} such runs with gyro noise, left to Schuler's tuning. The noise of "
        "the last moment becomes a swing, and new noise feeds it; the formula says one deviation."
    )


def _operation_caption(data: ErrorsUnderWay) -> str:
    gap = _largest(data.heading_error - data.formula.heading)
    return (
        "A ship gathers way to the North and turns West (shaded); gyros drift by a few hundredths "
        f"of a degree per hour. The heading error reaches {_largest(data.heading_error):.2f} "
        f"degrees, the formula follows within {gap:.1g}. The yaw runs away and the compass angle "
        f"takes it back. The speed deviation, up to {_largest(data.deviation):.1f} degrees, is "
        "counted apart."
    )


def _ballistic_caption(data: ballistic_error.BallisticError) -> str:
    tilts = [np.abs(run.tilt).max() / arcminute for run in data.runs.values()]
    damped = _largest(list(data.runs.values())[-1].heading_error)
    return (
        "One voyage, perfect sensors, five horizons. Schuler's tuning does not feel that the ship "
        f"gathers way; what tilts it by up to {tilts[0]:.1f} arc minutes is the Coriolis force, "
        f"and with a log to take that out {tilts[1]:.1g} are left. Other tunings tilt by up to "
        f"{max(tilts[2:]):.0f}. The damped one answers at once, by {damped:.0f} degrees of "
        "heading, beyond the axes."
    )


def _formula_caption(data: operating_formula.OperatingFormula) -> str:
    before = data.run.times < TURN[0]
    without = [_largest(gap[before]) for gap in data.gaps[1:]]
    return (
        "Everything wrong at once on a fast craft with its bow up. Left: the error of the compass "
        f"angle, up to {_largest(data.run.compass_error):.1f} degrees, and the formula's terms, "
        "given the tilts and the yaw error of the simulation. Right: until the turn at most "
        f"{_largest(data.gaps[0][before]):.2g} degrees are missing with all terms, and "
        f"{min(without):.2g} or more without any one of them. After it the craft goes nearly West, "
        "and the term with the velocity North fades."
    )


def _static_caption(data: static_characteristic.StaticCharacteristic) -> str:
    medians = np.degrees(np.median(data.largest, axis=1))
    lasting = np.interp(static_characteristic.PRINTED, medians, data.lasting)
    return (
        "The paper's Fig. 1, simulated from its description; its own plot is lost. Left: one unit, "
        "three runs around the dial. Right: the largest error of the averaged characteristic over "
        f"random units; the printed {static_characteristic.PRINTED:g} degrees are the median for "
        f"a lasting drift with a deviation of {lasting:.3f} degrees per hour a gyro."
    )


def _restarts_caption(data: restarts.Restarts) -> str:
    ratio = restarts.PRINTED_SPREAD / restarts.PRINTED_DEVIATION
    low, _ = restarts.rounding()
    averaged = data.deviations[:, 1] / (degree / hour)
    return (
        "The paper's Fig. 2, simulated from its description; its own plot is lost. Left: one "
        f"series, with gyro noise of {averaging_window.WHITE[0]:g} degrees per hour a sample, "
        f"averaged. Middle: noise of {averaging_window.WHITE[1]:g} degrees per hour a sample; "
        f"after the average {averaged[1]:.3f}, and {averaged[0]:.3f} where it was "
        f"{averaging_window.WHITE[0]:g}. Right: of "
        f"{restarts.TRIALS} normal samples {np.mean(data.ranges >= ratio):.1%} have a range as "
        f"large as the printed one, {np.mean(data.ranges >= low):.0%} one that could be rounded "
        "to it."
    )


def _capstone_caption(data: capstone.Capstone) -> str:
    turns = np.abs(data.per_turn).max(axis=1) / arcsecond
    headings = [_largest(error) for error in data.under_way.heading_error]
    return (
        "One bent triad through all four papers; f, u, r are its forward, upper and right axis. "
        "Panel 1: turns find what pairs of axes miss of a right angle, half of it here; the filter "
        "also finds how the triad is turned. Panels 2 to 4: what is left of it, in a turn, at rest "
        "and under way. The drift in a turn falls from "
        f"{turns[0]:.0f} to {turns[1]:.1f} and {turns[2]:.0f} arc seconds, the heading error of a "
        f"ship that turns by 90 degrees from {headings[0]:.2f} to {headings[1]:.2f} and "
        f"{headings[2]:.3f} degrees."
    )


ENTRIES = (
    Entry(
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
    Entry(
        "09-alignment-terms",
        alignment_terms.compute,
        alignment_terms.AlignmentTermsPicture,
        alignment_terms.columns,
        _terms_caption,
    ),
    Entry(
        "09-over-the-vertical",
        over_the_vertical.compute,
        over_the_vertical.OverTheVerticalPicture,
        over_the_vertical.columns,
        _vertical_caption,
    ),
    Entry(
        "09-averaging-window",
        averaging_window.compute,
        averaging_window.AveragingWindowPicture,
        averaging_window.columns,
        _averaging_caption,
    ),
    Entry(
        "10-settling",
        settling.compute,
        settling.SettlingPicture,
        settling.columns,
        _settling_caption,
    ),
    Entry(
        "10-ballistic-error",
        ballistic_error.compute,
        ballistic_error.BallisticErrorPicture,
        ballistic_error.columns,
        _ballistic_caption,
    ),
    Entry(
        "10-operation",
        operation.compute,
        operation.OperationPicture,
        operation.columns,
        _operation_caption,
    ),
    Entry(
        "10-operating-formula",
        operating_formula.compute,
        operating_formula.OperatingFormulaPicture,
        operating_formula.columns,
        _formula_caption,
    ),
    Entry(
        "10-static-characteristic",
        static_characteristic.compute,
        static_characteristic.StaticCharacteristicPicture,
        static_characteristic.columns,
        _static_caption,
    ),
    Entry(
        "10-restarts",
        restarts.compute,
        restarts.RestartsPicture,
        restarts.columns,
        _restarts_caption,
    ),
    Entry(
        "11-capstone",
        capstone.compute,
        capstone.CapstonePicture,
        capstone.columns,
        _capstone_caption,
    ),
)
