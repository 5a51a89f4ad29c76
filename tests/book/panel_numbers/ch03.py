"""Rows of the panel of chapter 03."""

import numpy as np
from scipy.constants import arcminute

from driftlab.drift.systematic_drift import drift_per_revolution, principal_drifts

from .values import Rows, Values, axis_of


def drift(values: Values) -> Rows:
    entries = [values[f"m{row}{column}"] for row in (1, 2, 3) for column in (1, 2, 3)]
    error_matrix = 1e-3 * np.reshape(entries, (3, 3))
    axis = axis_of(values)
    first_order = 2 * np.pi * axis @ error_matrix @ axis
    extremes, axes = principal_drifts(error_matrix, exact=True)
    largest = np.abs(extremes).argmax()
    worst = 2 * np.pi * extremes[largest]
    x, y, z = axes[largest]
    return [
        ("drift in one turn", f"{drift_per_revolution(axis, error_matrix) / arcminute:.3f}′"),
        ("to first order", f"{first_order / arcminute:.3f}′"),
        ("about the worst axis", f"{worst / arcminute:.3f}′"),
        ("worst axis, azimuth", f"{np.degrees(np.arctan2(y, x)):.1f}°"),
        ("worst axis, elevation", f"{np.degrees(np.arctan2(z, np.hypot(x, y))):.1f}°"),
    ]
