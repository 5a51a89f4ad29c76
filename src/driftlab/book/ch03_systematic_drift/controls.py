"""Sliders for the nine entries of a triad error, and the triads of the chapter as their values."""

import numpy as np

from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.scenarios import LARIN_TRIAD, SKEW, SYMMETRIC
from driftlab.checks import FloatArray

from .experiments import LARGEST_ENTRY

ENTRIES = [f"m{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3)]

TRIAD_ERROR_CONTROLS = tuple(
    Control(
        entry,
        f"{gyro} {'scale, 10⁻³' if gyro == 'xyz'[column] else f'to axis {column + 1}, mrad'}",
        0.0,
        -1e3 * LARGEST_ENTRY,
        1e3 * LARGEST_ENTRY,
        0.05,
        group=f"gyro {gyro}",
    )
    for entry, (gyro, column) in zip(
        ENTRIES, ((gyro, column) for gyro in "xyz" for column in range(3)), strict=True
    )
)
"""The nine entries of the triad error, row by row: what each gyro picks up of each body axis."""


def error_matrix_of(values: Values) -> FloatArray:
    """Triad error (3, 3) of `TRIAD_ERROR_CONTROLS`."""
    return 1e-3 * np.array([values[entry] for entry in ENTRIES]).reshape(3, 3)


def error_matrix_values(error_matrix: FloatArray) -> dict[str, float]:
    """Values of `TRIAD_ERROR_CONTROLS` that give a triad error (3, 3)."""
    rounded = np.round(1e3 * np.asarray(error_matrix).ravel(), 6)
    return dict(zip(ENTRIES, rounded.tolist(), strict=True))


TRIADS: dict[str, dict[str, float]] = {
    "Symmetric triad": error_matrix_values(1e-3 * SYMMETRIC),
    "Skew triad": error_matrix_values(LARGEST_ENTRY * SKEW),
    "Larin's triad": {
        **error_matrix_values(LARIN_TRIAD), "azimuth": 0.0, "elevation": 45.0
    },
    "One gyro leans": {"m12": 2.0, "elevation": 0.0},
    "Scale factor": error_matrix_values(1e-3 * np.eye(3)),
}  # fmt: skip
"""Triads by name, some with the axis about which they are turned at first."""
