"""Rows of the panel of chapter 10."""

import numpy as np
from scipy.constants import arcsecond, micro

from .values import Rows, Values


def split_triad(values: Values) -> Rows:
    units = np.where(np.eye(3, dtype=bool), micro, arcsecond)
    matrix = units * [[values[f"k{row}{column}"] for column in "xyz"] for row in "xyz"]
    pairs = [0.5 * (matrix[j, k] + matrix[k, j]) / arcsecond for j, k in ((0, 1), (0, 2), (1, 2))]
    rows = [("the most that two axes lack of square", f"{2 * max(map(abs, pairs)):.1f}″")]
    for i in range(3):
        rows.append(("scale of x, y, z, ppm", f"{matrix[i, i] / micro:.1f}"))
    rows += [("non-orthogonality xy, xz, yz, ″", f"{pair:.1f}") for pair in pairs]
    for i in range(3):
        # The vector of a skew matrix: K_zy, K_xz, K_yx less their mirrors, halved.
        a, b = (i + 2) % 3, (i + 1) % 3
        turned = 0.5 * (matrix[a, b] - matrix[b, a])
        rows.append(("misalignment about x, y, z, ″", f"{turned / arcsecond:.1f}"))
    return rows
