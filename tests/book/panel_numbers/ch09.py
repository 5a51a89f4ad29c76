"""Rows of the panel of chapter 09."""

import re

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, knot, micro, nautical_mile
from scipy.linalg import expm

from driftlab.calibration.static_error_growth import STATIC_ERROR_SOURCES, static_error_modes

from .values import Rows, Values, listed, three_digits


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
