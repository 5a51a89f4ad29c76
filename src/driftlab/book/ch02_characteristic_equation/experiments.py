"""Roots of the characteristic equation against the size of the deformation; Larin (2.1), (2.2)."""

import warnings

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import OBLIQUE_AXIS, SYMMETRIC
from driftlab.checks import ComplexArray, FloatArray, UnusualWarning, finite_array, nonzero_vectors
from driftlab.drift.characteristic_equation import (
    asymptotic_roots,
    characteristic_polynomial,
    exact_roots,
)
from driftlab.triad import measured_rate

SIZES: FloatArray = np.concatenate([np.geomspace(1e-5, 1e-2, 25), np.linspace(0.0125, 0.5, 40)])
FORMULAS = {
    "exact": "exact",
    "first order": "first order",
    "second order": "with the next term",
    "in the copy": "one term missing",
}
"""What the formulas are called in a table, and where a reader sees them."""
LEAST = 1e-15
"""An error below is rounding, which has no place on a logarithmic scale."""


def characteristic_roots(
    size: float = 0.1, shape: ArrayLike = SYMMETRIC, direction: ArrayLike = OBLIQUE_AXIS
) -> DataTable:
    """Roots by every formula for M = size * shape, and their course over `SIZES`."""
    direction, _ = nonzero_vectors(direction, "direction")
    shape = finite_array(shape, "shape", 3, 3)
    size = float(finite_array(size, "size"))
    if size < 0:
        raise ValueError(f"size: expected a number of at least 0, got {size!r}.")
    roots = _by_formula(np.array(size), shape, direction)
    parts = np.stack([roots.real, roots.imag], axis=1)
    branches = np.moveaxis(_by_formula(SIZES, shape, direction)[..., [0, 2]].imag, -1, 1)
    errors = np.abs(branches[1:] - branches[0])
    errors = np.where(errors > LEAST, errors, np.nan)
    names, pair = (*FORMULAS,), ("fast", "slow")
    return DataTable(
        {
            "sizes": (SIZES, "", "of the deformation, mu"),
            "root": (branches, "", "imaginary part, in units of the rate", [names, pair]),
            "error": (errors, "", "distance from the exact root", [names[1:], pair]),
            "plane": (parts, "", "all roots at one size", [names, ("real", "imaginary")]),
        },
        {
            "size": (size, "", "size in the complex plane"),
            # (formula, 4), in the order of `exact_roots`
            "roots": (roots, "", "all roots at this size, in units of the rate"),
        },
    )


def _by_formula(sizes: FloatArray, shape: FloatArray, direction: FloatArray) -> ComplexArray:
    """Roots (formula, ..., 4) for an array of sizes (...)."""
    error_matrix = sizes[..., np.newaxis, np.newaxis] * shape
    with warnings.catch_warnings():  # no instrument is bent so much, and that is the subject here
        warnings.simplefilter("ignore", UnusualWarning)
        measured = measured_rate(direction, error_matrix)
        return np.stack(
            [
                exact_roots(direction, measured),
                asymptotic_roots(direction, error_matrix),
                asymptotic_roots(direction, error_matrix, order=2),
                _copied_roots(direction, measured),
            ]
        )


def _copied_roots(direction: FloatArray, measured: FloatArray) -> ComplexArray:
    """Roots of the biquadratic as the copy has it, the slow ones with the sign of the exact ones.

    For a gross deformation they may leave the imaginary axis, which true roots never do.
    """
    polynomial = characteristic_polynomial(direction, measured, as_copied=True)
    b, c = polynomial[..., 2], polynomial[..., 4]
    fast = np.sqrt(0.5 * (b + np.sqrt(b**2 - 4 * c + 0j)))
    slow = np.sqrt(c) / fast * np.sign(exact_roots(direction, measured)[..., 2].imag)
    return 1j * np.stack([fast, -fast, slow, -slow], axis=-1)
