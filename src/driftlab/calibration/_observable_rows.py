"""All that the powers of a constant system can show."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

ZERO = 1e-9
"""Part of the largest singular value below which another counts as zero."""


def observable_rows(rates: FloatArray, seen: FloatArray) -> FloatArray:
    """Orthonormal basis of all that H, H F, H F^2, ... can show of a constant system.

    Parameters
    ----------
    rates : ndarray, shape (n, n)
        The matrix F; its states in comparable sizes.
    seen : ndarray, shape (m, n)
        The matrix H.

    Returns
    -------
    ndarray, shape (r, n)
        Rows across each other, of unit length; r is the rank of the local observability matrix.

    Notes
    -----
    Instead of powers, which run away in size, each round multiplies only the directions that are
    new by F, and keeps what sticks out of those found before. The first round that finds nothing
    is the last: no higher power adds anything. What sticks out counts as nothing below 1e-9 of the
    largest rate at which the round's directions change.

    Examples
    --------
    A mass that nothing pushes: its position shows its velocity, but not the other way round.

    >>> moves = np.array([[0.0, 1.0], [0.0, 0.0]])
    >>> [len(observable_rows(moves, np.eye(2)[[i]])) for i in range(2)]
    [2, 1]
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
