"""Rows of the panels of chapter 11."""

import re

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, knot, micro, milli, nautical_mile
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from driftlab.book.ch11_kalman_calibration.experiments import PARAMETERS, typical_trial
from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_dynamics import linearize_along
from driftlab.calibration.error_model import ERROR_MODELS, FULL
from driftlab.calibration.observability import unobservable_subspace
from driftlab.calibration.static_error_growth import STATIC_ERROR_SOURCES, static_error_modes
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

from .values import Rows, Values, listed, three_digits


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


def mission(values: Values) -> Rows:
    """By the matrix exponential; the modes by fitting what it gives over four days."""
    tilts = listed(values, "tilt_east tilt_north") * arcsecond
    drifts = listed(values, "gyro_east gyro_north gyro_up") * degree / hour
    pushes = listed(values, "push_east push_north") * micro * g
    causes = np.array([*tilts, values["azimuth"] * arcminute, *[0.0] * 4, *drifts, *pushes])
    matrix = np.zeros((12, 12))
    matrix[:7] = static_error_modes(np.radians(values["latitude"])).matrix

    def along(step: float, count: int) -> np.ndarray:
        """States (count + 1, 12, 12): a column for each cause by itself."""
        states, growth = [np.diag(causes)], expm(matrix * step)
        for _ in range(count):
            states.append(growth @ states[-1])
        return np.array(states)

    times = np.linspace(0.0, values["hours"] * hour, 361)
    each = along(times[1], 360)
    whole = each.sum(axis=-1)
    distance = np.linalg.norm(whole[:, 5:7], axis=-1)
    rate = (distance * times).sum() / (times**2).sum()

    days = 1200.0 * np.arange(289)
    rates = np.sort(np.linalg.eigvals(matrix[:7, :7]).imag)[[4, 5, 6]]
    waves = [f(w * days) for w in rates for f in (np.cos, np.sin)]
    basis = np.stack([np.ones(289), days / 86400, *waves], axis=-1)
    fitted = np.linalg.lstsq(basis, along(1200.0, 288)[:, 5:7].reshape(289, -1), rcond=None)[0]
    line, *sizes = (fitted.reshape(8, 2, 12)[i] for i in range(1, 8))
    daily, swing = (np.sqrt(sum((part**2).sum(axis=0) for part in rows)) for rows in
                    (sizes[:2], sizes[2:]))  # fmt: skip
    rows = [("radial error rate, nmi an hour", three_digits(rate / knot))]
    columns = (np.linalg.norm(each[-1, 5:7], axis=0), np.linalg.norm(line, axis=0), daily, swing)
    names = "at the end", "line, nmi a day", "24 hours, nmi", "Schuler, nmi"
    ends = whole[-1, [5, 6, 2]] / [nautical_mile, nautical_mile, arcminute]
    for what, end in zip(("East, nmi", "North, nmi", "heading, ′"), ends, strict=True):
        rows.append((f"{what}: {names[0]}", re.sub(r"^-(0\.0+)$", r"\1", f"{end:.2f}")))
        rows += [(f"{what}: {other}", "") for other in names[1:]]
    chosen = (7, 8, 9, 10, 11, 0, 1, 2)
    for i in sorted(chosen, key=lambda i: not causes[i]):  # those of zero are blank, at the end
        cause = STATIC_ERROR_SOURCES[i].replace("accelerometer", "acc.")
        cause = "azimuth" if i == 2 else cause.replace("attitude", "tilt")
        for name, column in zip(names, columns, strict=True):
            size = f"{column[i] / nautical_mile:.2f}"
            rows.append((f"{cause}: {name}", size) if causes[i] else (f": {name}", ""))
    return rows
