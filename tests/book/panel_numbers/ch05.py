"""Rows of the panel of chapter 05."""

import numpy as np

from driftlab.attitude.cayley import cayley_vector
from driftlab.quaternion import from_rotation_vector

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
