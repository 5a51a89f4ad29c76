"""Tables of a calibration: what the triads are, whether noise explains the rest, which rests."""

from __future__ import annotations

import numpy as np
from scipy.constants import arcminute, degree, g, milli

from driftlab.calibration.poses import Consistency, PoseCalibration
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.recordings.rest_detection import Rests

from .findings import Table
from .numbers import FORCES, RATES, SCALES, SMALL_ANGLES, Unit, fitting, written
from .record import AXES

KINDS = {
    "rests": "force at rest",
    "moves": "gravity after a move",
    "rates": "gyros at rest",
}
NOTE = (
    "measured = (I + K) true + bias: columns are sensors, 'feels of x' is their entry of K for x, "
    "a cross-coupling (misalignment)."
)


def triad_table(fit: PoseCalibration, name: str, units: tuple[Unit, ...]) -> Table:
    """Bias, scale, and what each sensor feels of the other axes; columns are sensors."""
    (bias, error), (bias_spread, error_spread) = (
        (getattr(each, f"{name}_bias"), getattr(each, f"{name}_error"))
        for each in (fit.imu_errors, fit.deviations)
    )
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


def _row(name: str, values: FloatArray, spreads: FloatArray, unit: Unit) -> tuple[str, ...]:
    cells = []
    for value, spread in zip(values / unit.size, spreads / unit.size, strict=True):
        if spread > 1e-6 * spreads.max():
            cells.append(f"{written(value, spread)} ± {written(spread, spread)}")
        else:  # the choice of axes has made it zero
            cells.append("0 by axes")
    return (name, *cells, unit.name)


def sensitivity_table(fit: PoseCalibration) -> Table:
    """What the gyros feel of force, for one g."""
    unit = Unit("deg/s for 1 g", degree / g)
    columns = zip(AXES, fit.sensitivity.T, fit.sensitivity_deviations.T, strict=True)
    rows = [_row(f"feels of {axis}", felt, spread, unit) for axis, felt, spread in columns]
    return Table("Gyros, of force", ("", *AXES, "unit"), tuple(rows))


def consistency_table(fit: PoseCalibration) -> Table:
    rows = []
    earth = {"moves": fit.earth_turn, "rates": EARTH_RATE}
    for kind, name in KINDS.items():
        test = fit.consistency[kind]
        square, freedom, low, high = (written(x, digits=3) for x in test[:4])
        verdict = _verdict(test, earth.get(kind, 0.0))
        rows.append((name, square, freedom, f"{low} to {high}", verdict))
    note = "The sum of the squared residuals over those of the noise, and where 95 of 100 lie."
    head = ("", "chi-square", "freedom", "expected", "")
    return Table("Does noise explain what is left?", head, tuple(rows), note)


def _verdict(test: Consistency, earth: float) -> str:
    if np.isnan(test.upper):
        return "nothing is left to test"
    if test.excess:
        return "no, but no more than the Earth" if test.excess < earth else "no, there is more"
    if test.chi_square > test.upper:
        return "yes, once the others have theirs"
    return "yes" if test.holds else "no, there is less"


def rests_table(found: Rests, fit: PoseCalibration, turns: FloatArray) -> Table:
    rows = []
    for place, ((begin, end), loudest) in enumerate(zip(found.rows, found.loudest, strict=True)):
        rows.append(
            (
                str(place + 1),
                f"{begin * found.interval:.2f}",
                f"{end * found.interval:.2f}",
                written(float(loudest), digits=2),
                written(fit.force_residuals[place] / (milli * g), digits=3),
                written(turns[place] / arcminute, digits=3),
            )
        )
    head = ("rest", "from, s", "to, s", "scatter", "force, mg", "turn, arcmin")
    note = (
        f"{found.why} Scatter: the most in a window, in units of the quietest. Force: size of the "
        "corrected force less gravity. Turn: gravity carried to the next rest, against that found."
    )
    return Table("Rests", head, tuple(rows), note)


def excess_text(kind: str, excess: float) -> str:
    """The deviation that is missing, in the unit of its kind."""
    units = {"rests": FORCES, "moves": SMALL_ANGLES, "rates": RATES}[kind]
    unit = fitting(excess, units)
    return f"{written(excess / unit.size, digits=2)} {unit.name}"
