"""Rows of the panel of chapter 07."""

import numpy as np

from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.attitude.finite_precision import integrate_finite_word
from driftlab.attitude.integration import integrate
from driftlab.motion.profiles import Coning, FixedAxis, Sway
from driftlab.quaternion import conjugate, multiply, rotation_angle

from .values import ABSENT, Rows, Values, angle


def algorithm_laboratory(values: Values) -> Rows:
    kinds = {"coning": Coning, "swaying ship": Sway, "fixed axis": FixedAxis}
    motion = kinds[values["motion"]](np.radians(values["amplitude"]), values["frequency"])
    short = values["word"] == "32 bits"
    method = integrate_finite_word if short else integrate
    floor = 1e-5 if short else 1e-12
    rows, errors = [], {}
    for name in ALGORITHMS:
        if not values[name]:
            rows += [(f"{name}: largest error", ABSENT), (f"{name}: order", ABSENT)]
            continue
        worst = {}
        for rate in (12, 24, 48, 96, 192):
            attitude = method(
                motion.increments(1 / rate, 2 * rate), name, start=motion.attitude(0.0)
            )
            ends = np.arange(1, len(attitude) + 1) * (2 * rate // len(attitude)) / rate
            error = rotation_angle(multiply(conjugate(motion.attitude(ends)), attitude))
            worst[rate] = error.max()
        seen = {rate: error for rate, error in worst.items() if floor < error < 1e-2}
        order = ABSENT
        if len(seen) > 2:
            order = f"{-np.polyfit(np.log(list(seen)), np.log(list(seen.values())), 1)[0]:.2f}"
        errors[name] = worst[values["rate"]]
        rows += [(f"{name}: largest error", angle(errors[name])), (f"{name}: order", order)]
    best = min(errors, key=lambda name: np.nan_to_num(errors[name], nan=np.inf))
    return [(f"least error, by {best}", angle(errors[best])), *rows]
