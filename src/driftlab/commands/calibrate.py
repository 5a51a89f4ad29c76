"""``python -m driftlab calibrate``: errors of a unit that was turned by hand from rest to rest."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import fields
from typing import Any

import numpy as np
from scipy.constants import degree, g

from driftlab.calibration import (
    ImucalMatrices,
    ImuTkMatrices,
    KalibrMatrices,
    PsinsMatrices,
    RosMatrices,
    calibrate_multi_position,
    imu_errors_in_frame,
    to_json,
)
from driftlab.calibration.body_axes import POSE_AXES
from driftlab.calibration.multi_position import MultiPositionCalibration
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.imu import ImuErrors
from driftlab.recordings.recording import Recording
from driftlab.recordings.static_detection import StaticIntervals, static_intervals

from .example import OPTIONS
from .findings import (
    AXES,
    FORCES,
    RATES,
    SCALES,
    SMALL_ANGLES,
    Curve,
    Findings,
    Plot,
    Step,
    Table,
    Unit,
    fitting,
    written,
)
from .options import number
from .record import forces, record_plots

STEPS = 3
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    f"python -m driftlab calibrate log.csv {OPTIONS}"
    " --axes FRD --latitude 59.9 --json errors.json"
)
MILLI_G, ARCMIN = FORCES[0], SMALL_ANGLES[0]
TRIADS = {"gyro": RATES, "accelerometer": FORCES}  # and the units of their biases
# Of residuals: their names, and the units of their deviations.
KINDS = {
    "static_intervals": ("force at rest", FORCES),
    "moves": ("gravity after a move", SMALL_ANGLES),
    "rates": ("gyros at rest", RATES),
}
# By program, its matrices, and its body axes if the accelerometers fix them by a triangle.
FORMS: dict[str, tuple[Any, str]] = {
    "imu-tk": (ImuTkMatrices, "lower triangle accelerometers"),
    "imucal": (ImucalMatrices, ""),
    "kalibr": (KalibrMatrices, "accelerometers"),
    "psins": (PsinsMatrices, ""),
    "ros": (RosMatrices, ""),
}
NOTE = (
    "measured = (I + K) true + bias: columns are sensors, 'feels of x' is their entry of K for x, "
    "a cross-coupling (misalignment)."
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what this command alone wants to know."""
    parser.description = (
        f"{parser.description}\n"
        "The log of a unit on a turntable goes to\n"
        "driftlab.calibration.calibrate: chapter 11 of the book."
    )
    add = parser.add_argument_group("rests and axes").add_argument
    seconds: dict[str, Any] = {"type": number, "default": 1.0, "metavar": "S"}
    add(
        "--body-axes",
        default="accelerometers",
        choices=[name.replace(" ", "-") for name in POSE_AXES],
        help="what fixes the axes of the result (default: accelerometers: x along the x "
        "accelerometer, y in the plane of x and y)",
    )
    add(
        "--closed",
        action="append",
        type=rest_pair,
        default=[],
        metavar="I,J",
        help="rests, by number, with the same attitude; may be given several times",
    )
    add(
        "--sensitivity",
        action="store_true",
        help="the gyros may feel force: fit nine numbers more, as many small ones need",
    )
    text = "how much more than in the quietest window a rest may scatter (default: 20)"
    add("--window", **seconds, help="that a rest must be quiet in (default: 1)")
    add("--multiple", type=number, default=20.0, help=text)
    add("--shortest", **seconds, help="shortest rest, settling cut off (default: 1)")
    add(
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


def find(recording: Recording, options: argparse.Namespace, step: Step) -> Findings:
    """Find the rests, fit the errors, and see whether noise explains what is left."""
    forces(recording)  # refuses a log of gyros alone
    step("find the rests")
    found = static_intervals(
        recording, window=options.window, multiple=options.multiple, shortest=options.shortest
    )
    if recording.gravity is None and recording.latitude is None:
        raise ValueError(
            "--latitude: expected the latitude of the place, degrees, or --gravity, m/s^2, because "
            "gravity is what the accelerometers are held against; got neither."
        )
    step("fit")
    fit = calibrate_multi_position(
        recording,
        found,
        body_axes=options.body_axes.replace("-", " "),
        closed=options.closed,
        sensitivity=options.sensitivity,
    )
    step("plots")
    # The angle left after each rest's move, NaN after the last and where a closed path counts.
    turns = np.full(len(found), np.nan)
    moves = [k for k in range(len(found) - 1) if (k, k + 1) not in options.closed]
    turns[moves] = fit.turn_residuals[: len(moves)]
    tables = [_triad_table(fit, name) for name in TRIADS]
    tables.append(_consistency_table(fit))
    if options.sensitivity:
        unit = Unit("deg/s for 1 g", degree / g)
        rows = _matrix_rows(fit.sensitivity, fit.sensitivity_standard_deviations, unit)
        tables.append(Table("Gyros, of force", ("", *AXES, "unit"), tuple(rows)))
    details = [_rests_table(found, fit, turns)]
    details += [_form_table(fit.imu_errors, form) for form in dict.fromkeys(options.form)]
    times = found.interval * np.array(found.rows)
    return Findings(
        "Calibration by poses",
        tuple(tables),
        tuple(_in_words(fit)),
        tuple(_doubts(fit)),
        (*record_plots(recording, tuple(map(tuple, times))), *_residual_plots(fit)),
        tuple(details),
        values=_values(fit, times, recording.axes),
        columns={
            "rest": np.arange(1, len(found) + 1),
            "begin_s": times[:, 0],
            "end_s": times[:, 1],
            "force_residual_m_per_s2": fit.force_residuals,
            "turn_residual_rad": turns,
        },
    )


def _triad_table(fit: MultiPositionCalibration, name: str) -> Table:
    """Bias, scale, and what each sensor feels of the other axes; columns are sensors."""
    (bias, error), (bias_spread, error_spread) = (
        (getattr(each, f"{name}_bias"), getattr(each, f"{name}_error_matrix"))
        for each in (fit.imu_errors, fit.standard_deviations)
    )
    scale, across = np.diag(error), error - np.diag(np.diag(error))
    rows = [
        _row("bias", bias, bias_spread, fitting(bias, TRIADS[name])),
        _row("scale error", scale, np.diag(error_spread), fitting(scale, SCALES)),
    ]
    for place, row in enumerate(_matrix_rows(error, error_spread, fitting(across, SMALL_ANGLES))):
        rows.append((*row[: place + 1], "", *row[place + 2 :]))  # a scale error is no angle
    return Table(f"{name.capitalize()}s", ("", *AXES, "unit"), tuple(rows), NOTE)


def _matrix_rows(matrix: FloatArray, spreads: FloatArray, unit: Unit) -> Iterator[tuple[str, ...]]:
    """What the sensors feel of each axis: the columns of a matrix."""
    for axis, felt, spread in zip(AXES, matrix.T, spreads.T, strict=True):
        yield _row(f"feels of {axis}", felt, spread, unit)


def _row(name: str, values: FloatArray, spreads: FloatArray, unit: Unit) -> tuple[str, ...]:
    """Three numbers; where there is no deviation, the choice of axes has made one zero."""
    known = spreads > 1e-6 * spreads.max()
    cells = (
        unit.pair(value, spread) if free else "0 by axes"
        for value, spread, free in zip(values, spreads, known, strict=True)
    )
    return (name, *cells, unit.name)


def _consistency_table(fit: MultiPositionCalibration) -> Table:
    rows, earth = [], {"static_intervals": 0.0, "moves": fit.earth_turn, "rates": EARTH_RATE}
    for kind, (name, _) in KINDS.items():
        test = fit.consistency[kind]
        if np.isnan(test.upper):
            verdict = "nothing is left to test"
        elif test.excess:
            few = test.excess < earth[kind]
            verdict = "no, but no more than the Earth" if few else "no, there is more"
        elif test.chi_square > test.upper:
            verdict = "yes, once the others have theirs"
        else:
            verdict = "yes" if test.holds else "no, there is less"
        square, freedom, low, high = (written(x, digits=3) for x in test[:4])
        rows.append((name, square, freedom, f"{low} to {high}", verdict))
    note = "The sum of the squared residuals over those of the noise, and where 95 of 100 lie."
    head = ("", "chi-square", "degrees of freedom", "expected", "")
    return Table("Does noise explain what is left?", head, tuple(rows), note)


def _rests_table(found: StaticIntervals, fit: MultiPositionCalibration, turns: FloatArray) -> Table:
    rows = [
        (
            str(place + 1),
            f"{begin * found.interval:.2f}",
            f"{end * found.interval:.2f}",
            written(float(found.loudest[place]), digits=2),
            MILLI_G.text(fit.force_residuals[place], digits=3),
            ARCMIN.text(turns[place], digits=3),
        )
        for place, (begin, end) in enumerate(found.rows)
    ]
    head = ("rest", "from, s", "to, s", "scatter", "force, mg", "turn, arcmin")
    note = (
        f"{found.why} Scatter: the most in a window, in units of the quietest. Force: size of the "
        "corrected force less gravity. Turn: gravity carried to the next rest, against that found."
    )
    return Table("Rests", head, tuple(rows), note)


def matrices(errors: ImuErrors, form: str) -> dict[str, np.ndarray]:
    """The matrices and biases of a program, by their names there, in its own body axes."""
    kind, axes = FORMS[form]
    if axes:
        errors, _ = imu_errors_in_frame(errors, axes)
        # What the rotation leaves of zero; a program may refuse it.
        half = np.tril if axes == "accelerometers" else np.triu
        errors = errors._replace(accelerometer_error_matrix=half(errors.accelerometer_error_matrix))
    made = kind.from_imu_errors(errors)
    names = [field.name for field in fields(made) if field.name != "readings"]
    arrays = {name: np.asarray(getattr(made, name), float) for name in names}
    return {name: array for name, array in arrays.items() if array.any()}


def _form_table(errors: ImuErrors, form: str) -> Table:
    """The matrices of a program, to read: each is three rows."""
    rows = []
    for name, array in matrices(errors, form).items():
        for row, line in enumerate(np.atleast_2d(array)):
            cells = (f"{x + 0.0:.7f}" for x in np.round(np.broadcast_to(line, 3), 7))
            rows.append(("" if row else name, *cells))
    return Table(f"As {form} has it", ("", "1", "2", "3"), tuple(rows), "SI units.")


def _in_words(fit: MultiPositionCalibration) -> Iterator[str]:
    more = []
    for kind, test in fit.consistency.items():
        if test.excess:
            name, units = KINDS[kind]
            unit = fitting(test.excess, units)
            more.append(f"{name} ({unit.text(test.excess, digits=2)} {unit.name})")
    yield (
        f"There is more than noise in: {', '.join(more)}. The deviations have it in them, as if it "
        "were noise."
        if more
        else "Noise explains what is left."
    )
    yield (
        f"Gravity was taken for {fit.gravity:.6g} m/s^2. In the longest move the Earth turned by "
        f"{ARCMIN.text(fit.earth_turn, digits=2)} arcmin: the weights count its rate as one of "
        "unknown direction."
    )


def _doubts(fit: MultiPositionCalibration) -> Iterator[str]:
    errors = fit.imu_errors
    largest = float(np.abs([errors.gyro_error_matrix, errors.accelerometer_error_matrix]).max())
    if largest > 0.2:
        yield (
            f"an entry of the matrices is {largest:.2g}. Triads are seldom so bent: look at the "
            "units, at the order of the columns and at their signs."
        )


def _residual_plots(fit: MultiPositionCalibration) -> Iterator[Plot]:
    for title, across, unit, name, rows, marker in (
        ("force at each rest", "rest", MILLI_G, "force less gravity", fit.force_residuals, "o"),
        ("turn over each move", "move", ARCMIN, "angle of gravity", fit.turn_residuals, "s"),
    ):
        x = np.arange(1.0, len(rows) + 1)
        curve = Curve(name, x, rows / unit.size, marker=marker)
        yield Plot(f"What is left of the {title}", across, unit.name, (curve,))


def _values(fit: MultiPositionCalibration, times: FloatArray, axes: str) -> dict[str, Any]:
    return {
        "model": "measured = (I + K) true + bias; K is gyro_error_matrix or "
        "accelerometer_error_matrix, its rows are sensors, its columns what they feel of",
        "calibration": json.loads(to_json(fit, axes=axes)),
        "imu_errors": fit.imu_errors._asdict(),
        "standard_deviations": fit.standard_deviations._asdict(),
        "body_axes": fit.body_axes,
        "names": fit.names,
        "covariance": fit.covariance,
        "gravity": fit.gravity,
        "sensitivity": fit.sensitivity,
        "sensitivity_standard_deviations": fit.sensitivity_standard_deviations,
        "consistency": {
            kind: {**test._asdict(), "holds": test.holds} for kind, test in fit.consistency.items()
        },
        "static_intervals": times,
        "force_residuals": fit.force_residuals,
        "turn_residuals": fit.turn_residuals,
        "forms": {form: matrices(fit.imu_errors, form) for form in FORMS},
    }
