"""Roots of the characteristic equation against the size of the deformation; Larin (2.1), (2.2)."""

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.scenarios import OBLIQUE_AXIS, SYMMETRIC
from driftlab.checks import (
    ComplexArray,
    FloatArray,
    UnusualWarning,
    finite_array,
    nonzero_vectors,
)
from driftlab.drift.characteristic_equation import (
    asymptotic_roots,
    characteristic_polynomial,
    exact_roots,
)
from driftlab.triad import measured_rate

SIZES: FloatArray = np.concatenate([np.geomspace(1e-5, 1e-2, 25), np.linspace(0.0125, 0.5, 40)])
FORMULAS = ("exact", "first order, (2.2)", "with the next term", "(2.1) as the copy has it")


class Roots(NamedTuple):
    """Roots by every formula of `FORMULAS`, in units of the rate."""

    size: float  # mu
    # (formula, 4), at `size`, in the order of `driftlab.drift.characteristic_equation.exact_roots`
    roots: ComplexArray
    sizes: FloatArray  # (m,), sizes mu of the branches
    # (formula, m, 2), imaginary part of the fast and of the slow root at `sizes`
    branches: FloatArray


def characteristic_roots(
    size: float = 0.1, shape: ArrayLike = SYMMETRIC, direction: ArrayLike = OBLIQUE_AXIS
) -> Roots:
    """Roots by every formula for M = size * shape, and their course over `SIZES`."""
    direction, _ = nonzero_vectors(direction, "direction")
    shape = finite_array(shape, "shape", 3, 3)
    size = float(finite_array(size, "size"))
    if size < 0:
        raise ValueError(f"size: expected a number of at least 0, got {size!r}.")
    branches = _by_formula(SIZES, shape, direction)[..., [0, 2]].imag.astype(np.float64)
    return Roots(size, _by_formula(np.array(size), shape, direction), SIZES, branches)


def _by_formula(sizes: FloatArray, shape: FloatArray, direction: FloatArray) -> ComplexArray:
    """Roots (formula, ..., 4) for an array of sizes (...)."""
    triad_error = sizes[..., np.newaxis, np.newaxis] * shape
    with warnings.catch_warnings():  # no instrument is bent so much, and that is the subject here
        warnings.simplefilter("ignore", UnusualWarning)
        measured = measured_rate(direction, triad_error)
        return np.stack(
            [
                exact_roots(direction, measured),
                asymptotic_roots(direction, triad_error),
                asymptotic_roots(direction, triad_error, order=2),
                _copied_roots(direction, measured),
            ]
        )


def _copied_roots(direction: FloatArray, measured: FloatArray) -> ComplexArray:
    """Roots of the biquadratic as the copy has it, the slow ones with the sign of the exact ones.

    For a gross deformation they may leave the imaginary axis, which true roots never do.
    """
    polynomial = characteristic_polynomial(direction, measured, in_the_copy=True)
    b, c = polynomial[..., 2], polynomial[..., 4]
    fast = np.sqrt(0.5 * (b + np.sqrt(b**2 - 4 * c + 0j)))
    slow = np.sqrt(c) / fast * np.sign(exact_roots(direction, measured)[..., 2].imag)
    return 1j * np.stack([fast, -fast, slow, -slow], axis=-1)


def root_errors(roots: Roots) -> FloatArray:
    """Distance (3, m, 2) of the approximate roots from the exact ones, in units of the rate."""
    return np.abs(roots.branches[1:] - roots.branches[0])
