"""The published figures of chapter 08, with their captions."""

import numpy as np
from scipy.constants import hour

from driftlab.book.machinery.publish import FigureDefinition

from .. import experiments
from . import (
    calibration_errors,
    filter_consistency,
    in_place,
    in_place_claim,
    scheme_directions,
    table_observability,
)


def _consistency_caption(data: experiments.FilterConsistency) -> str:
    low, high = data.state_bounds
    inside = np.mean((data.states > low) & (data.states < high))
    return (
        f"Calibrations of random units, {experiments.RUNS} in the left and middle panels. "
        f"Left: squared normalised errors of all states, each value of one; {inside:.0%} of the "
        "values lie within their bounds, and neighbouring values hang together. Middle: the same "
        f"of the innovations, {data.inside:.1%} within theirs. Right: "
        f"{experiments.RUNS_BY_FRAME} for each dot, at the end of a shorter scheme, for "
        "units bent more and more. The linear filter becomes too sure of itself, and the choice of "
        "body axes decides when."
    )


def _claim_caption(data: experiments.InPlaceClaim) -> str:
    one, own, table = (
        experiments.verdict(data.ratios[start, "velocity"]) for start in experiments.ALL_STARTS
    )
    return (
        f"{own.units} random units, calibrated with both choices of body axes on the same data, "
        f"at rest for {experiments.REST_DURATION / hour:.0f} hours: root mean square error with "
        "averaged axes over that with usual axes. Velocity is better with averaged axes in "
        f"{one.better} units if both start from one attitude, in {own.better} if each starts from "
        f"the exact attitude of its own true axes (by {1 - own.median:.1%} at the median), and in "
        f"{table.better} if both start from the table's axes (by {1 - table.median:.0%})."
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
            "scale errors become known all the same; of the off-diagonal entries only "
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
        "08-filter-consistency",
        experiments.filter_consistency,
        filter_consistency.draw,
        filter_consistency.columns,
        _consistency_caption,
    ),
    FigureDefinition(
        "08-in-place",
        experiments.errors_at_rest,
        in_place.draw,
        in_place.columns,
        lambda _: (
            "The paper's Figs. 3 to 5, simulated from its description: the typical unit of "
            "this chapter, calibrated with either choice of body axes, navigates at rest. If both "
            "computers start from one attitude, each in its own axes, the curves are one. If both "
            "start from the table's axes, each has its own distance to them as initial error."
        ),
    ),
    FigureDefinition(
        "08-in-place-claim",
        experiments.error_ratios_at_rest,
        in_place_claim.draw,
        in_place_claim.columns,
        _claim_caption,
    ),
)
