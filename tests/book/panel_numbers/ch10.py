"""Rows of the panel of chapter 10."""

import numpy as np
from scipy.constants import arcminute, degree, hour

from driftlab.book.scenarios import ship_manoeuvre
from driftlab.gyrocompass.simulation import simulate_compass

from .values import Rows, Values, listed


def gyrocompass(values: Values) -> Rows:
    latitude, course, turn = np.radians(listed(values, "latitude course turn"))
    run = simulate_compass(
        ship_manoeuvre(latitude, values["speed"], course, turn, 4.0),
        listed(values, "gyro_forward gyro_up gyro_right") * degree / hour,
        tuning_factor=values["tuning"],
        damping=values["damping"],
        tilt=values["tilt"] * arcminute,
        log=values["log"],
    )
    north, east = (np.abs(run.tilt[:, i]).max() / arcminute for i in (0, 1))
    gap = f"{np.degrees(np.abs(run.heading_error - run.formula.heading).max()):.4f}°"
    small = max(np.abs([run.yaw_error, run.compass_error]).max(axis=-1)) <= 0.2
    return [
        ("largest heading error", f"{np.degrees(np.abs(run.heading_error).max()):.4f}°"),
        ("at the end", f"{np.degrees(run.heading_error[-1]):.4f}°"),
        ("largest gap to the formula", gap if small else "too large errors for it"),
        ("largest tilt about North", f"{north:.3f}′"),
        ("largest tilt about East", f"{east:.3f}′"),
        ("largest speed error", f"{np.degrees(np.abs(run.speed_error).max()):.4f}°"),
        ("yaw error at the end", f"{np.degrees(run.yaw_error[-1]):.4f}°"),
        ("compass error at the end", f"{np.degrees(run.compass_error[-1]):.4f}°"),
    ]
