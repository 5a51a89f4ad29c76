"""How far an error about the axis of a cone swings within a step: where it is no drift any more."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray


def largest_change(drift: FloatArray, size: FloatArray, along: FloatArray) -> FloatArray:
    """How much the error about the cone's axis may change in a step, rad.

    The steps turn by `size`, `along` being the part about the cone's axis; see `coning_drift`.
    """
    lean = np.abs(along) / np.where(size > 0, size, 1.0)
    ratio = np.where(size > 0, (1 - lean) / (1 + lean), 0.0)
    sine, cosine = ratio * np.sin(size / 2), ratio * np.cos(size / 2)
    sign = np.where(along < 0, -1.0, 1.0)
    more, less = (4 * np.arctan2(sine, 1 + way * cosine) for way in (-1, 1))
    return np.maximum(np.abs(drift + sign * more), np.abs(drift - sign * less))


def half_a_turn(found: float) -> ValueError:
    """Return the refusal of an error that changes by half a turn or more, `found` rad, per step."""
    return ValueError(
        "half_angle, frequency, sample_interval: expected a cone on which the algorithm's error "
        f"about the axis changes by less than half a turn a step, got {found:.3g} rad."
    )
