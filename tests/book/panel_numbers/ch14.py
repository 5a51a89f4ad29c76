"""Rows of the panel of chapter 14."""

import numpy as np
from scipy.constants import arcminute, degree, hour

from driftlab.book.scenarios import ship_manoeuvre
from driftlab.gyrocompass.simulation import simulate_gyrocompass

from .values import ABSENT, Rows, Values, listed


def gyrocompass(values: Values) -> Rows:
    latitude, course, turn = np.radians(listed(values, "latitude course turn"))
    run = simulate_gyrocompass(
        ship_manoeuvre(latitude, values["speed"], course, turn, 4.0),
        listed(values, "gyro_forward gyro_up gyro_right") * degree / hour,
        tuning_factor=values["tuning"],
        damping=values["damping"],
        tilt=values["tilt"] * arcminute,
        speed_log=values["log"],
    )
    small = max(np.abs([run.yaw_error, run.compass_error]).max(axis=-1)) <= 0.2
    gap = np.abs(run.heading_error - run.formula.heading)
    rows = [("largest heading error", f"{np.degrees(np.abs(run.heading_error).max()):.4f}°")]
    for name, error in (
        ("heading", run.heading_error),
        ("of it, yaw ψ", run.yaw_error),
        ("of it, compass angle", run.compass_error),
        ("speed deviation", run.speed_error),
        ("off the formula", gap if small else None),
    ):
        largest, last = (
            (ABSENT, ABSENT)
            if error is None
            else (f"{np.degrees(x):.4f}°" for x in (np.abs(error).max(), error[-1]))
        )
        rows += [(f"{name}: largest", largest), (f"{name}: at the end", last)]
    for i, axis in enumerate(("North", "East")):
        tilt = run.tilt[:, i] / arcminute
        rows.append((f"tilt about {axis}: largest", f"{np.abs(tilt).max():.3f}′"))
        rows.append((f"tilt about {axis}: at the end", f"{tilt[-1]:.3f}′"))
    return rows
