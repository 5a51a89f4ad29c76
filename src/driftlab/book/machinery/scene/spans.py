"""What a plot of a scene spans, in round numbers."""

from __future__ import annotations

import numpy as np
from matplotlib.ticker import MaxNLocator

from driftlab.checks import FloatArray


def reach(values: FloatArray) -> tuple[float, float]:
    """Return a round span on both sides of zero that holds all values that are finite."""
    largest = np.abs(values[np.isfinite(values)]).max(initial=0.0)
    if largest < 1e-12:
        return -1.0, 1.0
    steps = 10.0 ** np.floor(np.log10(largest)) * np.array([1, 1.5, 2, 3, 5, 7, 10, 15])
    step = float(steps[0.98 * steps >= largest][0])
    return -step, step


def span(values: FloatArray, least: float = 0.0) -> tuple[float, float]:
    """Return a round span of zero and all finite values, one-sided if hardly any are on one side.

    It reaches at least to `least`, so that smaller values do not look large.
    """
    low, high = reach(np.append(values, least))
    known = values[np.isfinite(values)]
    lowest, highest = float(known.min(initial=0.0)), float(known.max(initial=0.0))
    if highest > 0.05 * high and lowest > 0.05 * low:
        return lowest, high
    if lowest < 0.05 * low and highest < 0.05 * high:
        return low, highest
    return low, high


def ticks_between(low: float, high: float, most: int) -> list[float]:
    """Round values from `low` to `high`, about `most` of them."""
    ticks = np.asarray(MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high))
    margin = 1e-9 * (high - low)
    return [float(t) for t in ticks.round(12) if low - margin <= t <= high + margin]
