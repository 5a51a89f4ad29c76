"""Rows of the panels of chapter 11."""

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro, milli
from scipy.spatial.transform import Rotation

from driftlab.book.ch11_kalman_calibration.experiments import PARAMETERS, typical_trial
from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_dynamics import linearize_along
from driftlab.calibration.error_model import ERROR_MODELS, FULL
from driftlab.calibration.observability import unobservable_subspace
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

from .values import Rows, Values, three_digits


def observability(values: Values) -> Rows:
    x, y, z = values["start"].split()
    scheme = Scheme(values["rotations"], (x, y, z), values["dwell"], np.radians(values["rate"]))
    states = values["states"]
    model = FULL if states == "all 30" else ERROR_MODELS[states.removeprefix("27, ")]
    way = linearize_along(scheme, np.radians(values["latitude"]), model)
    noise = ImuNoise(
        values["gyro"] * 1e-3 * degree / np.sqrt(hour),
        values["accelerometer"] * micro * g,
        values["velocity"] * milli,
    )
    after = np.sqrt(np.diag(covariance_analysis(way, noise, PriorStandardDeviations())))
    unobservable = unobservable_subspace(way)
    seen = f"{model.size - len(unobservable.directions)} of {model.size}"
    hidden = "; ".join(unobservable.descriptions) or "nothing"
    rows = [("states that this scheme shows", seen), ("not observable", hidden)]
    kinds = dict.fromkeys(name.rpartition(" ")[0] for name in model.names[6:])
    for kind in kinds:
        size, unit = unit_of(kind)
        states = [i for i, name in enumerate(model.names) if name.rpartition(" ")[0] == kind]
        places = ", ".join(model.names[i].rpartition(" ")[2] for i in states)
        found = ", ".join(three_digits(after[i] / size) for i in states)
        rows.append((f"{kind} {places}, {unit.strip()}", found))
    return rows


def unit_of(name: str) -> tuple[float, str]:
    """Size in SI and sign of the unit in which a sensor error is told, with its space."""
    if "bias" in name:
        return (degree / hour, " °/h") if "gyro" in name else (micro * g, " µg")
    return (micro, " ppm") if "scale" in name else (arcsecond, "″")


def calibration(values: Values) -> Rows:
    trial = typical_trial(values["frame"])
    found = trial.calibration
    at = np.abs(found.times - 60 * values["minute"]).argmin()
    state = 6 + PARAMETERS.index(values["parameter"])
    name = found.model.names[state]
    size, unit = unit_of(name)
    estimate, three = found.state[at, state] / size, 3 * found.standard_deviations[at, state] / size
    error = trial.errors[at, state] / size
    return [
        ("error at this moment", f"{error:.4f}{unit}"),
        ("in these body axes", name),
        ("true", f"{estimate + error:.4f}{unit}"),
        ("estimate", f"{estimate:.4f}{unit}"),
        ("three deviations", f"{three:.4f}{unit}"),
        ("moment", f"{found.times[at] / 60:.1f} min"),
        ("the table", table_says(found.times[at])),
    ]


def table_says(second: float) -> str:
    """What a table does on the nineteen positions: two minutes of rest, nine seconds a turn."""
    body = Rotation.from_matrix(np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]]))
    for word in (*NINETEEN_POSITIONS.rotations.split(), ""):
        if second <= 120:
            up = body.inv().apply([0, 0, 1])
            axis = np.abs(up).argmax()
            return f"rests, {'+' if up[axis] > 0 else '−'}{'xyz'[axis]} up"
        if second < 129:
            return f"turns {word}"
        second -= 129
        body = body * Rotation.from_euler(word[-1], float(word[:-1]), degrees=True)
    raise AssertionError("the scheme is over")
