"""The misaligned triad's ship after its turn, with a horizon that a speed log damps."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE, ship_manoeuvre
from driftlab.checks import FloatArray, finite_array, shown
from driftlab.gyrocompass.simulation import simulate_gyrocompass

from .experiments import MISALIGNMENT, NON_ORTHOGONALITY, bent_triad

RATIOS = (0.0, 0.3, 0.5, 0.9, 5.0)


def remaining_part(ratio: ArrayLike) -> FloatArray:
    """Return the largest heading error over that without damping, by the impulse response.

    The largest value of exp(-ratio w t) sin(w t sqrt(1 - ratio^2)) / sqrt(1 - ratio^2).
    """
    ratio = finite_array(ratio, "ratio")
    arc, root = np.abs(np.emath.arccos(ratio)), np.abs(np.emath.sqrt(1 - ratio**2))
    near = np.isclose(ratio, 1.0)
    part: FloatArray = np.exp(-ratio * np.where(near, 1.0, arc / np.where(near, 1.0, root)))
    return part


def damped_turn(
    ratios: ArrayLike = RATIOS,
    non_orthogonality: ArrayLike = NON_ORTHOGONALITY,
    misalignment: ArrayLike = MISALIGNMENT,
    latitude: float = SARATOV_LATITUDE,
) -> DataTable:
    """Follow the heading error of a misaligned triad through a turn, for some damping ratios."""
    each = np.atleast_1d(finite_array(ratios, "ratios"))
    if not (each >= 0).all():
        raise ValueError(f"ratios: expected none below zero, got {shown(each)}.")
    way = ship_manoeuvre(latitude, interval=16.0)
    drift = way.increments.mean_rate @ bent_triad(non_orthogonality, misalignment).T
    runs = [
        simulate_gyrocompass(way, drift, damping=float(ratio), speed_log=True)
        for ratio in (0.0, *each)
    ]
    errors = np.stack([run.heading_error for run in runs])
    worst = np.abs(errors).max(axis=1)
    grid = np.arange(0.0, max(5.0, each.max()) + 0.01, 0.05)
    return DataTable(
        {
            "time": (runs[0].times, "min", "under way"),
            "heading_error": (errors[1:], "deg", "with damping", [f"{x:.3g}" for x in each]),
            "ratio": (each, "", "damping ratio"),
            "remaining": (worst[1:] / worst[0], "", "largest error over that without damping"),
            "any_ratio": (grid, "", "damping ratio of the formula"),
            "by_formula": (remaining_part(grid), "", "the same by the impulse response"),
        },
        {"undamped": (worst[0], "deg", "largest error without damping")},
    )
