"""Rows of the panel of chapter 03."""

import numpy as np
from scipy.constants import arcminute

from driftlab.drift.systematic_drift import drift_per_turn, principal_drifts

from .values import Rows, Values, axis_of


def drift(values: Values) -> Rows:
    entries = [values[f"m{row}{column}"] for row in (1, 2, 3) for column in (1, 2, 3)]
    triad_error = 1e-3 * np.reshape(entries, (3, 3))
    axis = axis_of(values)
    first_order = 2 * np.pi * axis @ triad_error @ axis
    extremes, axes = principal_drifts(triad_error, exact=True)
    largest = np.abs(extremes).argmax()
    worst = 2 * np.pi * extremes[largest]
    x, y, z = axes[largest]
    return [
        ("drift in one turn", f"{drift_per_turn(axis, triad_error) / arcminute:.3f}′"),
        ("to first order", f"{first_order / arcminute:.3f}′"),
        ("about the worst axis", f"{worst / arcminute:.3f}′"),
        ("worst axis, azimuth", f"{np.degrees(np.arctan2(y, x)):.1f}°"),
        ("worst axis, elevation", f"{np.degrees(np.arctan2(z, np.hypot(x, y))):.1f}°"),
    ]
