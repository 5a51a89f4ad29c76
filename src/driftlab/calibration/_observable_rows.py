"""All that the powers of a constant system can show."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

ZERO = 1e-9
"""Part of the largest singular value below which another counts as zero."""


def observable_rows(rates: FloatArray, seen: FloatArray) -> FloatArray:
    """Return an orthonormal basis (r, n) of all that H, H F, H F^2, ... show of a constant system.

    The states of F (n, n) are in comparable sizes; r is the rank of the observability matrix.
    Powers of F would run away in size. Instead, each round multiplies only the new directions
    by F and keeps the part that is orthogonal to those found before, if it is above 1e-9 of the
    largest rate at which the round's directions change. A round that finds nothing is the last.
    """
    found = np.zeros((0, rates.shape[1]))
    new = seen
    while len(new):
        size = np.linalg.norm(new, 2)
        for _ in range(2):  # once more for the digits that the first subtraction loses
            new = new - (new @ found.T) @ found
        _, values, rows = np.linalg.svd(new, full_matrices=False)
        fresh = rows[values > ZERO * size]
        found = np.concatenate([found, fresh])
        new = fresh @ rates
    return found
