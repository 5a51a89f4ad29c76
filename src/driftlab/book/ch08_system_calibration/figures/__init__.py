"""The published figures of chapter 08, with their captions."""

import numpy as np
from scipy.constants import hour

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.machinery.arrays_table import from_columns, to_columns
from driftlab.book.machinery.publish import FigureDefinition
from driftlab.motion.scheme import SCHEMES

from .. import experiments
from . import (
    calibration_errors,
    choice_of_axes,
    designed_scheme,
    filter_consistency,
    in_place,
    in_place_claim,
    scheme_directions,
    size_effect,
    table_observability,
)


def _consistency_caption(data: experiments.FilterConsistency) -> str:
    low, high = data.state_bounds
    inside = np.mean((data.states > low) & (data.states < high))
    return (
        f"{experiments.RUNS} calibrations of random units. "
        f"Left: squared normalised errors of all states, each value of one; {inside:.0%} of the "
        "values lie within their bounds, and neighbouring values are correlated. Right: the same "
        f"of the innovations, {data.inside:.1%} within theirs."
    )


def _designed_caption(data: experiments.DesignedSchemes) -> str:
    nineteen, eighteen = (each.criteria[0] for each in data.of_kind("published"))
    best, free = (data.named(name).criteria[0] for name in (experiments.BEST, experiments.FREE))
    drawn = np.array([each.criteria[0] for each in data.of_kind("random")])
    first, second = (f"{values.mean():.2f}" for values in data.nees.values())
    return (
        "Rows of eighteen quarter and half turns, all in the time of the nineteen positions. Left: "
        "deviations of the sensor errors over those after the nineteen positions; bars, nine in "
        f"ten of {drawn.size} random rows; hollow, errors of {len(data.nees[experiments.BEST])} "
        "simulated units after the designed row over those of the same units after the nineteen "
        f"positions, with standard errors (NEES / 27: {second} and {first}). Right: how much of "
        "what was unknown before is left of the sensor error that is known worst: "
        f"{nineteen:.2%} after nineteen positions, {eighteen:.2%} after eighteen rotations, "
        f"{best:.2%} after the row designed for two axes, {free:.2%} for three; "
        f"{np.mean(drawn < nineteen):.0%} of the random rows leave less than the nineteen "
        "positions."
    )


def _axes_caption(data: experiments.ChoiceOfAxes) -> str:
    size = experiments.SIZES[-1]
    counts = []
    for rival in BODY_FRAMES[1:]:
        first, second = (data.compared(scheme, size, rival) for scheme in SCHEMES)
        counts.append(f"{rival} {first.better} and {second.better}")
    twice = [values.mean() for case, values in data.squares.items() if case.passes == 2]
    return (
        f"{experiments.UNITS} random units in each case, {first.units} of those bent most; the "
        "same ones for each of five choices of body axes, on the nineteen positions and on "
        "eighteen rotations, commonly quoted as those of Camberlein, whom the paper cites (not "
        "confirmed), with short pauses. "
        "Left and middle: squared normalised errors, means with their standard errors. Right: how "
        "often averaged axes err less in a unit, with 95 % "
        f"intervals. After one pass over the record of units bent by {size}″ they err less than "
        f"{', '.join(counts)} times, on the first scheme and on the second. After a second pass, "
        "linearised about the first, all means lie between "
        f"{min(twice):.2f} and {max(twice):.2f} (hollow)."
    )


def _claim_caption(data: experiments.InPlaceClaim) -> str:
    counted = data.counted()
    units = next(iter(counted.values())).units
    said = []
    for start in experiments.ALL_STARTS:
        these = [each for key, each in counted.items() if key.start == start]
        sure = [each for each in these if each.chance < data.certain]
        wins = sum(each.better > units / 2 for each in sure)
        said.append(f"from {start} {wins} and {len(sure) - wins}")
    return (
        f"Random units, {units} of either size, calibrated in averaged axes and in two triangles "
        "on the same data, on the nineteen positions and on eighteen rotations, then at rest for "
        f"{experiments.REST_DURATION / hour:.0f} hours; the two computers begin from four starts. "
        "Above: root mean square error with averaged axes over that with the upper triangle, on "
        "the nineteen positions; the scales differ. Below: part of the units in which averaged "
        f"axes err less, with 95 % intervals, in all {len(counted)} comparisons. Certain "
        f"(each below 0.05/{len(counted)}) are, in the "
        f"{len(counted) // len(experiments.ALL_STARTS)} comparisons for each start, these gains "
        f"and losses of averaged axes: {', '.join(said)}."
    )


def _size_effect_caption(data: experiments.SizeEffect) -> str:
    rate, arm = experiments.RATES.index(10.0), experiments.ARM_SIZES.index(experiments.ARM)
    at = (slice(None), rate, arm)
    squares, noticed, biases = (
        " and ".join(f"{value:{form}}" for value in rows[at])
        for rows, form in ((data.squares, ".0f"), (data.noticed, ".2f"), (data.worst, ".0f"))
    )
    return (
        f"Each accelerometer lies {100 * experiments.ARM:.0f} cm out on its own axis. Left: one "
        "typical unit on the nineteen positions; the filter of 27 states is wrong by up to "
        f"{np.abs(data.ratios[0]).max():.0f} of its stated deviations, its mean squared innovation "
        f"is {data.innovations[0]:.3f}; with the nine components of the arms as states the largest "
        f"error is {np.abs(data.ratios[1]).max():.1f} deviations. Right: expected squares of the "
        "21 sensor errors and of the innovations, over what they should be; the band ends where "
        "the mean innovation of one calibration would be too large at 95 %. On the nineteen "
        f"positions and on the eighteen rotations {100 * experiments.ARM:.0f} cm make an "
        f"accelerometer bias wrong by {biases} stated deviations and the squares {squares} times "
        f"too large, while the innovations are {noticed} times what they should be."
    )


FIGURES = (
    FigureDefinition(
        "08-scheme-directions",
        experiments.up_in_body_axes,
        scheme_directions.draw,
        scheme_directions.columns,
        lambda data: (
            "Which body axis points up along the two rotation schemes, with pauses of two minutes "
            f"and turns of 10 degrees a second; {data.times[0][-1] / 60:.1f} and "
            f"{data.times[1][-1] / 60:.1f} minutes."
        ),
    ),
    FigureDefinition(
        "08-table-observability",
        experiments.table_observability,
        table_observability.TableObservabilityPicture.draw,
        table_observability.columns,
        lambda data: (
            f"All {len(data.names)} states on the nineteen positions. Left: {data.unobservable} "
            "eigenvalues of the Gramian are zero but for rounding (crosses). Right: biases and "
            "scale errors still become known; of the off-diagonal entries only "
            "combinations do."
        ),
    ),
    FigureDefinition(
        "08-calibration-errors",
        experiments.calibration_errors,
        calibration_errors.draw,
        calibration_errors.columns,
        lambda data: (
            "A typical unit on the nineteen positions: size of the error of each of the "
            f"{len(data.names)} sensor errors, and three standard deviations as the filter states "
            "them. A parameter becomes known when the right axis is turned or points up."
        ),
    ),
    FigureDefinition(
        "08-designed-scheme",
        experiments.designed_schemes,
        designed_scheme.draw,
        designed_scheme.columns,
        _designed_caption,
        designed_scheme.restore,
    ),
    FigureDefinition(
        "08-filter-consistency",
        experiments.filter_consistency,
        filter_consistency.draw,
        filter_consistency.columns,
        _consistency_caption,
    ),
    FigureDefinition(
        "08-size-effect",
        experiments.size_effect,
        size_effect.draw,
        to_columns,
        _size_effect_caption,
        from_columns(experiments.SizeEffect),
    ),
    FigureDefinition(
        "08-choice-of-axes",
        experiments.choice_of_axes,
        choice_of_axes.draw,
        choice_of_axes.columns,
        _axes_caption,
        choice_of_axes.restore,
    ),
    FigureDefinition(
        "08-in-place",
        experiments.errors_at_rest,
        in_place.draw,
        in_place.columns,
        in_place.caption,
    ),
    FigureDefinition(
        "08-in-place-claim",
        experiments.error_ratios_at_rest,
        in_place_claim.draw,
        in_place_claim.columns,
        _claim_caption,
        in_place_claim.restore,
    ),
)
