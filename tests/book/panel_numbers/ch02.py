"""Rows of the panel of chapter 02."""

import numpy as np

from driftlab.drift.characteristic_equation import (
    asymptotic_roots,
    characteristic_polynomial,
    exact_roots,
)
from driftlab.triad import measured_rate

from .values import Rows, Values, axis_of

# Larin's shapes of the deformation, once more, from his paper and the chapter.
SHAPES = {
    "symmetric": np.ones((3, 3)) - np.eye(3),
    "skew": np.cross(np.eye(3), [-1.0, -1.0, -1.0]),
    "third axis bent, as in Larin's experiment": np.outer([0, 0, 1], [1, -1, 0]),
    "x leans to axis 2 only": np.outer([1, 0, 0], [0, 1, 0]),
    "scale factor of all three": np.eye(3),
}


def roots(values: Values) -> Rows:
    rate = axis_of(values)
    error_matrix = values["size"] * SHAPES[values["shape"]]
    measured = measured_rate(rate, error_matrix)
    slow = np.linalg.norm(measured) - np.linalg.norm(rate)
    first, second = (asymptotic_roots(rate, error_matrix, order=n).imag for n in (1, 2))
    as_copied = characteristic_polynomial(rate, measured, as_copied=True)
    sizes = np.sort(np.abs(np.sqrt(np.roots(as_copied[::2]) + 0j).imag))
    rows = [("slow root, exact", f"{slow:.6f} i")]
    for name, fast, slow_one in (
        ("exact", exact_roots(rate, measured).imag.max(), slow),
        ("first order", first[0], first[2]),
        ("with the next term", second[0], second[2]),
        ("one term missing", sizes[1], np.copysign(sizes[0], slow)),
    ):
        rows.append((f"{name}: fast root", f"{fast:.9f} i"))
        rows.append((f"{name}: slow root", f"{slow_one:.9f} i"))
    return rows
