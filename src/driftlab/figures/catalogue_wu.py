"""The published figures of Part III."""

import numpy as np
from scipy.constants import arcsecond, hour

from ..sensors import TYPICAL
from . import (
    calibration_errors,
    equivalent_start,
    filter_consistency,
    in_place,
    in_place_claim,
    plane_axes,
    scheme_directions,
    split_triad,
    table_observability,
)
from .entry import Entry


def _equivalent_start_caption(data: equivalent_start.EquivalentStart) -> str:
    largest = data.tilts.max(axis=1) / arcsecond
    return (
        "A unit on a turntable. Left: scale errors and non-orthogonality drift, the latter to "
        f"{largest[1]:.0f} arc seconds; misalignment comes back, and is what the total derivative "
        f"says to {np.abs(data.tilts[2] - data.tilts[3]).max() / arcsecond:.1g} arc seconds. "
        "Middle: two triads turned together are without effect only if the start is turned as "
        "well. Right: what remains is of second order for a skew matrix, and only rounding for a "
        "true rotation."
    )


def _consistency_caption(data: filter_consistency.FilterConsistency) -> str:
    low, high = data.state_bounds
    inside = np.mean((data.states > low) & (data.states < high))
    return (
        f"Calibrations of random units, {filter_consistency.RUNS} in the left and middle panels. "
        f"Left: squared normalised errors of all states, each value of one; {inside:.0%} of the "
        "values lie within their bounds, and neighbouring values hang together. Middle: the same "
        f"of the innovations, {data.inside:.1%} within theirs. Right: "
        f"{filter_consistency.RUNS_BY_FRAME} for each dot, at the end of a shorter scheme, for "
        "units bent more and more. The linear filter becomes too sure of itself, and the choice of "
        "body axes decides when."
    )


def _claim_caption(data: in_place_claim.InPlaceClaim) -> str:
    one, own, table = (
        in_place_claim.verdict(data.ratios[start, "velocity"])
        for start in in_place_claim.ALL_STARTS
    )
    return (
        f"{own.units} random units, calibrated with both choices of body axes on the same data, "
        f"at rest for {in_place.DURATION / hour:.0f} hours: root mean square error with averaged "
        "axes over that with usual axes. Velocity is better with averaged axes in "
        f"{one.better} units if both start from one attitude, in {own.better} if each starts from "
        f"the exact attitude of its own true axes (by {1 - own.median:.1%} at the median), and in "
        f"{table.better} if both start from the table's axes (by {1 - table.median:.0%})."
    )


ENTRIES = (
    Entry(
        "07-split-triad",
        lambda: split_triad.compute(TYPICAL.gyro_error),
        split_triad.SplitTriadPicture,
        split_triad.columns,
        lambda _: (
            "The gyro triad of a typical unit, and what each part of its error matrix alone would "
            "do: change the lengths (too little here to be seen), close and open the angles, turn "
            "all three axes together. Thin lines are the ideal axes. "
            f"Errors are drawn {split_triad.EXAGGERATION:g} times too large."
        ),
    ),
    Entry(
        "07-plane-axes",
        plane_axes.compute,
        plane_axes.PlaneAxesPicture,
        plane_axes.columns,
        lambda data: (
            "Two gyros and two accelerometers in a plane. The usual body axes go with the x gyro "
            f"and turn by {data.usual:.2f} rad; the averaged ones turn by {data.averaged:.2f} rad, "
            f"the mean of the angles {data.gyros[0]:.2f} and {data.gyros[1]:.2f} of the two gyros."
        ),
    ),
    Entry(
        "07-equivalent-start",
        equivalent_start.compute,
        equivalent_start.EquivalentStartPicture,
        equivalent_start.columns,
        _equivalent_start_caption,
    ),
    Entry(
        "08-scheme-directions",
        scheme_directions.compute,
        scheme_directions.SchemeDirectionsPicture,
        scheme_directions.columns,
        lambda data: (
            "Which body axis points up along the two rotation schemes, with pauses of two minutes "
            f"and turns of 10 degrees a second; {data.times[0][-1] / 60:.1f} and "
            f"{data.times[1][-1] / 60:.1f} minutes."
        ),
    ),
    Entry(
        "08-table-observability",
        table_observability.compute,
        table_observability.TableObservabilityPicture,
        table_observability.columns,
        lambda data: (
            f"All {len(data.names)} states on the nineteen positions. Left: {data.dark} "
            "eigenvalues of the Gramian are zero but for rounding (crosses). Right: biases and "
            "scale errors become known all the same; of the off-diagonal entries only "
            "combinations do."
        ),
    ),
    Entry(
        "08-calibration-errors",
        calibration_errors.compute,
        calibration_errors.CalibrationErrorsPicture,
        calibration_errors.columns,
        lambda data: (
            "A typical unit on the nineteen positions: size of the error of each of the "
            f"{len(data.names)} sensor errors, and three standard deviations as the filter states "
            "them. A parameter becomes known when the right axis is turned or points up."
        ),
    ),
    Entry(
        "08-filter-consistency",
        filter_consistency.compute,
        filter_consistency.FilterConsistencyPicture,
        filter_consistency.columns,
        _consistency_caption,
    ),
    Entry(
        "08-in-place",
        in_place.compute,
        in_place.InPlacePicture,
        in_place.columns,
        lambda _: (
            "The paper's Figs. 3 to 5, simulated from its description: the typical unit of "
            "this chapter, calibrated with either choice of body axes, navigates at rest. If both "
            "computers start from one attitude, each in its own axes, the curves are one. If both "
            "start from the table's axes, each has its own distance to them as initial error."
        ),
    ),
    Entry(
        "08-in-place-claim",
        in_place_claim.compute,
        in_place_claim.InPlaceClaimPicture,
        in_place_claim.columns,
        _claim_caption,
    ),
)
