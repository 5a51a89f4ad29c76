"""Rows of the panels of chapter 08."""

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro, milli

from driftlab.book.ch08_system_calibration.experiments import PARAMETERS, typical_trial
from driftlab.calibration.error_model import ERROR_MODELS, FULL
from driftlab.calibration.linearization import linearize_along
from driftlab.calibration.observability import covariance_analysis, unobservable_subspace
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import Scheme

from .values import Rows, Values


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
    after = np.sqrt(np.diag(covariance_analysis(way, noise, PriorDeviations())))
    unobservable = unobservable_subspace(way)
    rows = [("rank", f"{model.size - len(unobservable.directions)} of {model.size}")]
    rows += [("unobservable", text) for text in unobservable.descriptions]
    kinds = dict.fromkeys(name.rpartition(" ")[0] for name in model.names[6:])
    for kind in kinds:
        size, unit = unit_of(kind)
        states = [i for i, name in enumerate(model.names) if name.rpartition(" ")[0] == kind]
        places = ", ".join(model.names[i].rpartition(" ")[2] for i in states)
        found = ", ".join(f"{after[i] / size:.2g}" for i in states)
        rows.append((f"{kind} {places}", f"{found} {unit}"))
    return rows


def unit_of(name: str) -> tuple[float, str]:
    """Size in SI and name of the unit in which a sensor error is told."""
    if "bias" in name:
        return (degree / hour, "deg/h") if "gyro" in name else (micro * g, "µg")
    return (micro, "ppm") if "scale" in name else (arcsecond, "arc seconds")


def calibration(values: Values) -> Rows:
    trial = typical_trial(values["frame"])
    found = trial.calibration
    at = np.abs(found.times - 60 * values["minute"]).argmin()
    state = 6 + PARAMETERS.index(values["parameter"])
    name = found.model.names[state]
    size, unit = unit_of(name)
    estimate, three = found.state[at, state] / size, 3 * found.deviations[at, state] / size
    return [
        (name, ""),
        ("moment", f"{found.times[at] / 60:.1f} min"),
        ("estimate", f"{estimate:.4f} {unit}"),
        ("true", f"{estimate + trial.errors[at, state] / size:.4f} {unit}"),
        ("error", f"{trial.errors[at, state] / size:.4f} {unit}"),
        ("three deviations", f"{three:.4g} {unit}"),
    ]
