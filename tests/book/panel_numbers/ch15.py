"""Rows of the panel of chapter 15."""

import numpy as np
from scipy.constants import hour, knot, minute

from driftlab.gyrocompass import COARSE, Gyrocompass, GyroNoise, marine_type_test

from .values import ABSENT, Rows, Values, listed

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
