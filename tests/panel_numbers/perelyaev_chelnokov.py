"""Rows of the panels of Part II."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.attitude.cayley import cayley_vector
from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.attitude.finite_precision import integrate_in_word
from driftlab.attitude.integration import integrate
from driftlab.motion.profiles import Coning, FixedAxis, Sway
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

from .values import Rows, Values, axis_of


def cayley_map(values: Values) -> Rows:
    angle = abs(values["angle"])
    rotation = from_rotation_vector(np.radians(values["angle"]) * axis_of(values))

    def both(name: str, sign: int, dimension: int, infinite: bool) -> Rows:
        if infinite:
            return [(name, "infinite"), ("length", "infinite")]
        vector = cayley_vector(sign * rotation, dimension)
        words = ", ".join(f"{entry:.3f}" for entry in vector)
        return [(name, f"({words})"), ("length", f"{np.linalg.norm(vector):.4f}")]

    return [
        *both("dimension 3", 1, 3, angle == 180),
        ("from its singularity", f"{abs(angle - 180):.0f}°"),
        *both("dimension 4", 1, 4, angle == 360),
        ("from its singularity", f"{360 - angle:.0f}°"),
        *both("shadow", -1, 4, angle == 0),
    ]


def algorithm_laboratory(values: Values) -> Rows:
    kinds = {"coning": Coning, "swaying ship": Sway, "fixed axis": FixedAxis}
    motion = kinds[values["motion"]](np.radians(values["amplitude"]), values["frequency"])
    short = values["word"] == "32 bits"
    method = integrate_in_word if short else integrate
    floor = 1e-5 if short else 1e-12
    rows = []
    for name in (name for name in ALGORITHMS if values[name]):
        worst = {}
        for rate in (12, 24, 48, 96, 192):
            attitude = method(
                motion.increments(1 / rate, 2 * rate), name, start=motion.attitude(0.0)
            )
            ends = np.arange(1, len(attitude) + 1) * (2 * rate // len(attitude)) / rate
            error = rotation_angle(multiply(conjugate(motion.attitude(ends)), attitude))
            worst[rate] = error.max()
        seen = {rate: error for rate, error in worst.items() if floor < error < 1e-2}
        order = "none"
        if len(seen) > 2:
            order = f"{-np.polyfit(np.log(list(seen)), np.log(list(seen.values())), 1)[0]:.2f}"
        rows.append((name, f"{worst[values['rate']] / arcsecond:.2e}″, order {order}"))
    return rows
