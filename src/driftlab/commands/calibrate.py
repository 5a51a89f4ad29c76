"""``python -m driftlab calibrate``: errors of a unit that was turned by hand from rest to rest."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.constants import arcminute, g, milli

from driftlab.calibration import calibrate_by_poses, to_json
from driftlab.calibration.body_axes import POSE_AXES
from driftlab.calibration.poses import PoseCalibration
from driftlab.checks import FloatArray
from driftlab.recordings.recording import Recording
from driftlab.recordings.rest_detection import Rests, rests

from .calibration_tables import (
    KINDS,
    consistency_table,
    excess_text,
    rests_table,
    sensitivity_table,
    triad_table,
)
from .example import OPTIONS
from .findings import Curve, Findings, Plot
from .matrix_forms import FORMS, form_tables, form_values
from .numbers import FORCES, RATES, written
from .options import number
from .progress import Steps
from .record import forces, record_plots

STEPS = 3
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    f"python -m driftlab calibrate log.csv {OPTIONS}"
    " --axes FRD --latitude 59.9 --json errors.json"
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what this command alone wants to know."""
    parser.description = (
        f"{parser.description}\n"
        "The log of a unit on a turntable goes to\n"
        "driftlab.calibration.calibrate: chapter 08 of the book."
    )
    group = parser.add_argument_group("rests and axes")
    group.add_argument(
        "--body-axes",
        default="accelerometers",
        choices=[name.replace(" ", "-") for name in POSE_AXES],
        help="what fixes the axes of the result (default: accelerometers: x along the x "
        "accelerometer, y in the plane of x and y)",
    )
    group.add_argument(
        "--closed",
        action="append",
        type=rest_pair,
        default=[],
        metavar="I,J",
        help="rests, by number, with the same attitude; may be given several times",
    )
    group.add_argument(
        "--sensitivity",
        action="store_true",
        help="the gyros may feel force: fit nine numbers more, as many small ones need",
    )
    group.add_argument("--window", type=number, default=1.0, metavar="S", help="that a rest must "
                       "be quiet in (default: 1)")  # fmt: skip
    group.add_argument("--multiple", type=number, default=20.0, help="how much more than in the "
                       "quietest window a rest may scatter (default: 20)")  # fmt: skip
    group.add_argument("--shortest", type=number, default=1.0, metavar="S", help="shortest rest, "
                       "settling cut off (default: 1)")  # fmt: skip
    group.add_argument(
        "--form",
        action="append",
        choices=sorted(FORMS),
        default=[],
        help="show the matrices as another program has them, too; may be given several times",
    )


def rest_pair(text: str) -> tuple[int, int]:
    """Two numbers of rests, which begin with 1, as places."""
    first, last = (int(part) - 1 for part in text.split(","))
    return first, last


def find(recording: Recording, options: argparse.Namespace, step: Steps) -> Findings:
    """Find the rests, fit the errors, and see whether noise explains what is left."""
    forces(recording)  # refuses a log of gyros alone
    step("find the rests")
    found = rests(
        recording, window=options.window, multiple=options.multiple, shortest=options.shortest
    )
    step("fit")
    if recording.gravity is None and recording.latitude is None:
        raise ValueError(
            "--latitude: expected the latitude of the place, degrees, or --gravity, m/s^2, because "
            "gravity is what the accelerometers are held against; got neither."
        )
    fit = calibrate_by_poses(
        recording,
        found,
        body_axes=options.body_axes.replace("-", " "),
        closed=options.closed,
        sensitivity=options.sensitivity,
    )
    step("plots")
    turns = _turns(found, fit, options.closed)
    tables = [
        triad_table(fit, "gyro", RATES),
        triad_table(fit, "accelerometer", FORCES),
        consistency_table(fit),
        *([sensitivity_table(fit)] if options.sensitivity else []),
    ]
    details = [rests_table(found, fit, turns), *form_tables(fit.imu_errors, options.form)]
    shaded = tuple((b * found.interval, e * found.interval) for b, e in found.rows)
    return Findings(
        "Calibration by poses",
        tuple(tables),
        tuple(_in_words(fit)),
        tuple(_doubts(fit)),
        (*record_plots(recording, shaded), *_residual_plots(fit)),
        tuple(details),
        values=_values(fit, found, recording.axes),
        columns=_columns(found, fit, turns),
    )


def _turns(found: Rests, fit: PoseCalibration, closed: list[tuple[int, int]]) -> FloatArray:
    """Angle left after each rest's move, NaN after the last and where a closed path counts."""
    turns = np.full(len(found), np.nan)
    moves = [place for place in range(len(found) - 1) if (place, place + 1) not in closed]
    turns[moves] = fit.turn_residuals[: len(moves)]
    return turns


def _in_words(fit: PoseCalibration) -> Iterator[str]:
    excess = {kind: test.excess for kind, test in fit.consistency.items() if test.excess}
    more = [f"{KINDS[kind]} ({excess_text(kind, size)})" for kind, size in excess.items()]
    yield (
        f"There is more than noise in: {', '.join(more)}. The deviations have it in them, as if it "
        "were noise."
        if more
        else "Noise explains what is left."
    )
    yield (
        f"Gravity was taken for {fit.gravity:.6g} m/s^2. In the longest move the Earth turned by "
        f"{written(fit.earth_turn / arcminute, digits=2)} arcmin: the weights count its rate as "
        "one of unknown direction."
    )


def _doubts(fit: PoseCalibration) -> Iterator[str]:
    errors = fit.imu_errors
    largest = float(np.abs([errors.gyro_error, errors.accelerometer_error]).max())
    if largest > 0.2:
        yield (
            f"an entry of the matrices is {largest:.2g}. Triads are seldom so bent: look at the "
            "units, at the order of the columns and at their signs."
        )


def _residual_plots(fit: PoseCalibration) -> tuple[Plot, ...]:
    force = _points("force less gravity", fit.force_residuals / (milli * g), "o")
    turn = _points("angle of gravity", fit.turn_residuals / arcminute, "s")
    return (
        Plot("What is left of the force at each rest", "rest", "mg", force),
        Plot("What is left of the turn over each move", "move", "arcmin", turn),
    )


def _points(name: str, rows: FloatArray, marker: str) -> tuple[Curve, ...]:
    return (Curve(name, np.arange(1.0, len(rows) + 1), rows, marker=marker),)


def _values(fit: PoseCalibration, found: Rests, axes: str) -> dict[str, Any]:
    return {
        "model": "measured = (I + K) true + bias; K is gyro_error or accelerometer_error, its rows "
        "are sensors, its columns what they feel of",
        "calibration": json.loads(to_json(fit, axes=axes)),
        "imu_errors": fit.imu_errors._asdict(),
        "deviations": fit.deviations._asdict(),
        "body_axes": fit.body_axes,
        "names": fit.names,
        "covariance": fit.covariance,
        "gravity": fit.gravity,
        "sensitivity": fit.sensitivity,
        "sensitivity_deviations": fit.sensitivity_deviations,
        "consistency": {
            kind: {**test._asdict(), "holds": test.holds} for kind, test in fit.consistency.items()
        },
        "rests": [[b * found.interval, e * found.interval] for b, e in found.rows],
        "force_residuals": fit.force_residuals,
        "turn_residuals": fit.turn_residuals,
        "forms": form_values(fit.imu_errors),
    }


def _columns(found: Rests, fit: PoseCalibration, turns: FloatArray) -> dict[str, Any]:
    """The rests one by one."""
    return {
        "rest": np.arange(1, len(found) + 1),
        "begin_s": found.begin * found.interval,
        "end_s": found.end * found.interval,
        "force_residual_m_per_s2": fit.force_residuals,
        "turn_residual_rad": turns,
    }
