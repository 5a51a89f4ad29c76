"""Rows of the panel of chapter 06."""

import numpy as np

from driftlab.attitude.cayley import cayley_vector
from driftlab.quaternion import from_rotation_vector

from .values import Rows, Values, axis_of


def cayley_map(values: Values) -> Rows:
    angle = abs(values["angle"])
    rotation = from_rotation_vector(np.radians(values["angle"]) * axis_of(values))
    vectors = [
        None if infinite else cayley_vector(sign * rotation, dimension)
        for sign, dimension, infinite in (
            (1, 3, angle == 180),
            (1, 4, angle == 360),
            (-1, 4, angle == 0),
        )
    ]
    lengths = [np.inf if vector is None else np.linalg.norm(vector) for vector in vectors]
    names = ("dimension 3", "dimension 4", "shadow")
    rows = [("the shorter of dimension 4 and its shadow", f"{min(lengths[1:]):.4f}")]
    for i in range(3):
        for name, vector in zip(names, vectors, strict=True):
            entry = "∞" if vector is None else f"{vector[i]:.3f}"
            rows.append((f"component {i + 1}: {name}", entry))
    for name, size in zip(names, lengths, strict=True):
        rows.append((f"length: {name}", "∞" if np.isinf(size) else f"{size:.4f}"))
    for name, away in zip(names, (abs(angle - 180), 360 - angle, angle), strict=True):
        rows.append((f"to its singularity: {name}", f"{away:.0f}°"))
    return rows
