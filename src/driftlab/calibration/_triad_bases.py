"""Basis matrices of the error matrices K and L, and the names of their coefficients."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

AXES = "xyz"
DIAGONAL = [(i, i) for i in range(3)]
UPPER = [(0, 1), (0, 2), (1, 2)]
LOWER = [(1, 0), (2, 0), (2, 1)]
OFF_DIAGONAL = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]


def combined(coefficients: FloatArray, basis: FloatArray) -> FloatArray:
    """Matrices (..., 3, 3) with m coefficients (..., m) in a basis (m, 3, 3)."""
    matrices: FloatArray = coefficients @ basis.reshape(-1, 9)
    return matrices.reshape(*coefficients.shape[:-1], 3, 3)


def units(places: list[tuple[int, int]]) -> FloatArray:
    """Matrices (m, 3, 3) with a one at each of the places."""
    basis = np.zeros((len(places), 3, 3))
    for matrix, place in zip(basis, places, strict=True):
        matrix[place] = 1.0
    return basis


def named(kind: str, places: list[tuple[int, int]]) -> list[str]:
    """Names of the entries at the places."""
    return [f"{kind} {AXES[i]}" if i == j else f"{kind} {AXES[i]}{AXES[j]}" for i, j in places]
