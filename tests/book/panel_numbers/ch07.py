"""Rows of the panel of chapter 07."""

import numpy as np
from scipy.constants import arcsecond, micro

from .values import Rows, Values


def split_triad(values: Values) -> Rows:
    units = np.where(np.eye(3, dtype=bool), micro, arcsecond)
    matrix = units * [[values[f"k{row}{column}"] for column in "xyz"] for row in "xyz"]
    rows = []
    for i, (j, k) in enumerate(((0, 1), (0, 2), (1, 2))):
        # The vector of a skew matrix: K_zy, K_xz, K_yx less their mirrors, halved.
        a, b = (i + 2) % 3, (i + 1) % 3
        turned = 0.5 * (matrix[a, b] - matrix[b, a])
        rows += [
            (f"scale {'xyz'[i]}", f"{matrix[i, i] / micro:.1f} ppm"),
            (
                f"non-orthogonality {'xyz'[j]}{'xyz'[k]}",
                f"{0.5 * (matrix[j, k] + matrix[k, j]) / arcsecond:.1f}″",
            ),
            (f"misalignment about {'xyz'[i]}", f"{turned / arcsecond:.1f}″"),
        ]
    return rows
