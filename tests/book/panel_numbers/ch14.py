"""Rows of the panel of chapter 14."""

import numpy as np
from scipy.constants import arcminute, degree, hour, knot, minute

from driftlab.book.scenarios import ship_manoeuvre
from driftlab.gyrocompass import COARSE, Gyrocompass, GyroNoise, marine_type_test
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


LIMITS = {
    "settle point": (0.75, True),
    "scatter": (0.25, True),
    "repeatability": (0.25, True),
    "steady way": (0.25, True),
    "change of speed": (2.0, False),
    "turn": (3.0, False),
    "sea": (1.0, True),
}


def type_test(values: Values) -> Rows:
    white = np.radians(values["walk"]) / 60
    gauss_markov, drift = np.radians(listed(values, "gauss_markov drift")) / hour
    compass = Gyrocompass(
        (0.0, 0.0, drift),
        GyroNoise(white, gauss_markov, interval=1.0),
        damping=values["damping"],
        speed_log=values["log"],
        alignment_time=values["alignment"] * minute,
    )
    place = np.radians(values["latitude"])
    found = marine_type_test(compass, place, speed=values["speed"] * knot, steps=COARSE).measured
    time = found["settling"] / hour
    late = np.isinf(time)
    rows = [
        ("settling: measured", "never" if late else f"{time:.2f} h"),
        ("settling: limit", "6.00 h"),
        ("settling: share", ABSENT if late else f"{time / 6:.3f}"),
    ]
    kept = int(time <= 6)
    for name, (size, secant) in LIMITS.items():
        limit, angle = size / np.cos(place) if secant else size, np.degrees(found[name])
        rows += [(f"{name}: measured", f"{angle:.4f}°"), (f"{name}: limit", f"{limit:.3f}°")]
        rows.append((f"{name}: share", f"{angle / limit:.3f}"))
        kept += angle <= limit
    return [("limits kept", f"{kept} of 8"), *rows]
