"""``python -m driftlab calibrate``: errors of a unit that was turned by hand from rest to rest."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
from scipy.constants import arcminute, g, milli

from driftlab.calibration import POSE_AXES, Consistency, PoseCalibration, calibrate_by_poses
from driftlab.checks import FloatArray
from driftlab.earth import gravity as normal_gravity
from driftlab.recordings.recording import Recording
from driftlab.recordings.rests import Rests, rests

from .findings import Curve, Findings, Plot, Table
from .matrix_forms import FORMS, form_tables, form_values
from .numbers import FORCES, RATES, SCALES, SMALL_ANGLES, Unit, fitting, written
from .progress import Steps
from .record import AXES, forces, record_plots

STEPS = 3
EXAMPLE = """\
python -m driftlab example log.csv
python -m driftlab calibrate log.csv --columns gx,gy,gz,ax,ay,az --units deg/s,g --time t,s \
--axes FRD --latitude 59.9 --json errors.json"""
KINDS = {
    "rests": "force at rest",
    "moves": "gravity after a move",
    "rates": "gyros at rest",
}


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what this command alone wants to know."""
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
    group.add_argument("--window", type=float, default=1.0, metavar="S", help="that a rest must be "
                       "quiet in (default: 1)")  # fmt: skip
    group.add_argument("--multiple", type=float, default=20.0, help="how much more than in the "
                       "quietest window a rest may scatter (default: 20)")  # fmt: skip
    group.add_argument("--shortest", type=float, default=1.0, metavar="S", help="shortest rest, "
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
    pull = gravity_of(recording)
    fit = calibrate_by_poses(
        recording,
        found,
        gravity=pull,
        body_axes=options.body_axes.replace("-", " "),
        closed=options.closed,
    )
    step("plots")
    errors, spread = fit.imu_errors, fit.deviations
    tables = [
        _triad_table("gyro", errors.gyro_bias, errors.gyro_error, spread.gyro_bias,
                     spread.gyro_error, RATES),
        _triad_table("accelerometer", errors.accelerometer_bias, errors.accelerometer_error,
                     spread.accelerometer_bias, spread.accelerometer_error, FORCES),
        _consistency_table(fit),
        _rests_table(found, fit),
        *form_tables(errors, options.form),
    ]  # fmt: skip
    shaded = tuple((b * found.interval, e * found.interval) for b, e in found.rows)
    return Findings(
        "Calibration by poses",
        tuple(tables),
        tuple(_in_words(fit, found)),
        tuple(_doubts(fit)),
        (*record_plots(recording, shaded), *_residual_plots(fit)),
        _values(fit, found),
        _columns(found, fit),
    )


def gravity_of(recording: Recording) -> float:
    """Gravity of the place, m/s^2: what was told, or normal gravity of the latitude."""
    if recording.gravity is not None:
        return recording.gravity
    if recording.latitude is None:
        raise ValueError(
            "--latitude: expected the latitude of the place, degrees, or --gravity, m/s^2, because "
            "gravity is what the accelerometers are held against; got neither."
        )
    return float(normal_gravity(recording.latitude))


def _triad_table(
    name: str,
    bias: FloatArray,
    error: FloatArray,
    bias_spread: FloatArray,
    error_spread: FloatArray,
    units: tuple[Unit, ...],
) -> Table:
    """Bias, scale, and what each sensor feels of the other axes; columns are sensors."""
    across = error - np.diag(np.diag(error))
    unit, scale = fitting(bias, units), fitting(np.diag(error), SCALES)
    angle = fitting(across, SMALL_ANGLES)
    rows = [
        _row("bias", bias, bias_spread, unit),
        _row("scale error", np.diag(error), np.diag(error_spread), scale),
    ]
    for place, axis in enumerate(AXES):
        cells = _row(f"feels of {axis}", error[:, place], error_spread[:, place], angle)
        rows.append(tuple("" if i == place + 1 else cell for i, cell in enumerate(cells)))
    return Table(f"{name.capitalize()}s", ("", *AXES, "unit"), tuple(rows), NOTE)


NOTE = (
    "measured = (I + K) true + bias: columns are sensors, 'feels of x' is their entry of K for x."
)


def _row(name: str, values: FloatArray, spreads: FloatArray, unit: Unit) -> tuple[str, ...]:
    cells = []
    for value, spread in zip(values / unit.size, spreads / unit.size, strict=True):
        if spread > 0:
            cells.append(f"{written(value, spread)} ± {written(spread, spread)}")
        else:  # the choice of axes has made it zero
            cells.append("0 by axes" if abs(value) < 1e-9 else written(value))
    return (name, *cells, unit.name)


def _consistency_table(fit: PoseCalibration) -> Table:
    rows = []
    for kind, name in KINDS.items():
        test = fit.consistency[kind]
        rows.append(
            (
                name,
                *(written(x, digits=3) for x in (test.chi_square, test.freedom)),
                f"{written(test.lower, digits=3)} to {written(test.upper, digits=3)}",
                _verdict(test),
            )
        )
    note = "The sum of the squared residuals over those of the noise, and where 95 of 100 lie."
    head = ("", "chi-square", "freedom", "expected", "")
    return Table("Does noise explain what is left?", head, tuple(rows), note)


def _verdict(test: Consistency) -> str:
    if not np.isfinite(test.chi_square) or test.freedom <= 0:
        return "nothing is left to test"
    if test.holds:
        return "yes"
    return "no, there is more" if test.chi_square > test.upper else "no, there is less"


def _rests_table(found: Rests, fit: PoseCalibration) -> Table:
    rows = []
    for place, ((begin, end), loudest) in enumerate(zip(found.rows, found.loudest, strict=True)):
        turn = (
            written(fit.turn_residuals[place] / arcminute, digits=3)
            if place < len(found) - 1
            else ""
        )
        rows.append(
            (
                str(place + 1),
                f"{begin * found.interval:.2f}",
                f"{end * found.interval:.2f}",
                written(float(loudest), digits=2),
                written(fit.force_residuals[place] / (milli * g), digits=3),
                turn,
            )
        )
    head = ("rest", "from, s", "to, s", "scatter", "force left, mg", "turn left, arcmin")
    note = (
        "Scatter: the most in a window, in units of the quietest. Force left: size of the corrected"
        " force less gravity. Turn left: gravity carried to the next rest, against that found."
    )
    return Table("Rests", head, tuple(rows), note)


def _in_words(fit: PoseCalibration, found: Rests) -> list[str]:
    held = [KINDS[kind] for kind in KINDS if fit.consistency[kind].holds]
    failed = [
        f"{KINDS[kind]} ({_excess(kind, fit.consistency[kind].excess)})"
        for kind in KINDS
        if fit.consistency[kind].chi_square > fit.consistency[kind].upper
    ]
    words = [found.why]
    if held:
        words.append(f"Noise explains what is left of: {', '.join(held)}.")
    if failed:
        words.append(
            f"There is more than noise in: {', '.join(failed)}. The deviations above have it in "
            "them, as if it were noise."
        )
    words.append(
        f"Gravity was taken for {fit.gravity:.6g} m/s^2. In the longest move the Earth turned by "
        f"{written(fit.earth_turn / arcminute, digits=2)} arcmin, which the fit leaves out."
    )
    return words


def _excess(kind: str, excess: float) -> str:
    """The deviation that is missing, in the unit of its kind."""
    units = {"rests": FORCES, "moves": SMALL_ANGLES, "rates": RATES}[kind]
    unit = fitting(excess, units)
    return f"{written(excess / unit.size, digits=2)} {unit.name}"


def _doubts(fit: PoseCalibration) -> list[str]:
    doubts = []
    largest = max(
        float(np.abs(matrix).max())
        for matrix in (fit.imu_errors.gyro_error, fit.imu_errors.accelerometer_error)
    )
    if largest > 0.2:
        doubts.append(
            f"an entry of the matrices is {largest:.2g}. Triads are seldom so bent: look at the "
            "units, at the order of the columns and at their signs."
        )
    return doubts


def _residual_plots(fit: PoseCalibration) -> tuple[Plot, ...]:
    force, turn = fit.force_residuals / (milli * g), fit.turn_residuals / arcminute
    return (
        Plot(
            "What is left of the force at each rest",
            "rest",
            "mg",
            (Curve("force less gravity", np.arange(1.0, len(force) + 1), force, marker="o"),),
        ),
        Plot(
            "What is left of the turn over each move",
            "move",
            "arcmin",
            (Curve("angle of gravity", np.arange(1.0, len(turn) + 1), turn, marker="s"),),
        ),
    )


def _values(fit: PoseCalibration, found: Rests) -> dict[str, Any]:
    return {
        "imu_errors": fit.imu_errors._asdict(),
        "deviations": fit.deviations._asdict(),
        "body_axes": fit.body_axes,
        "names": fit.names,
        "covariance": fit.covariance,
        "gravity": fit.gravity,
        "consistency": {
            kind: {**test._asdict(), "holds": test.holds} for kind, test in fit.consistency.items()
        },
        "rests": [[b * found.interval, e * found.interval] for b, e in found.rows],
        "force_residuals": fit.force_residuals,
        "turn_residuals": fit.turn_residuals,
        "forms": form_values(fit.imu_errors),
    }


def _columns(found: Rests, fit: PoseCalibration) -> dict[str, Any]:
    """The rests one by one; no move follows the last."""
    moves = np.full(len(found), np.nan)
    moves[:-1] = fit.turn_residuals[: len(found) - 1]
    return {
        "rest": np.arange(1, len(found) + 1),
        "begin_s": np.array([b for b, _ in found.rows]) * found.interval,
        "end_s": np.array([e for _, e in found.rows]) * found.interval,
        "force_residual_m_per_s2": fit.force_residuals,
        "turn_residual_rad": moves,
    }
