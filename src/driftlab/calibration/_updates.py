"""When the filter looks at the velocity: the ends of its updates, as numbers of increments.

The navigation computation takes pairs of increments, so an update ends after an even number of
them. Reference velocities of other moments are taken for those of the nearest pair.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from driftlab.checks import FloatArray, UnusualWarning, finite_array, positive_number, shown

USUAL_INTERVAL = 1.0
"""Of the updates at a table that stands, if nothing else is said, s."""
_LEAST = 4


def updates(
    count: int,
    interval: float,
    reference_velocity: ArrayLike | None,
    reference_times: ArrayLike | None,
    update_interval: float | None,
) -> tuple[NDArray[Any], FloatArray]:
    """Ends (k,) of the updates, as numbers of increments, and the velocities (..., k, 3) there."""
    if count < _LEAST:
        raise ValueError(f"increments: expected at least {_LEAST}, two pairs, got {count}.")
    if update_interval is not None and (
        reference_velocity is not None or reference_times is not None
    ):
        raise ValueError(
            "update_interval: expected with a table that stands, without reference_velocity and "
            f"reference_times, got {shown(update_interval)}."
        )
    if reference_times is not None:
        ends = _nearest_pairs(count, interval, reference_times)
        if reference_velocity is None:
            return ends, np.zeros((len(ends), 3))
        reference = finite_array(reference_velocity, "reference_velocity", 3)
        if reference.ndim < 2 or reference.shape[-2] != len(ends):
            raise ValueError(
                f"reference_velocity: expected shape (..., {len(ends)}, 3), as many as "
                f"reference_times, got shape {reference.shape}."
            )
        return ends, reference
    if reference_velocity is None:
        seconds = USUAL_INTERVAL if update_interval is None else update_interval
        pairs = max(round(positive_number(seconds, "update_interval") / (2 * interval)), 1)
        inner = np.arange(2 * pairs, count - 1, 2 * pairs)
        # The last update takes what is left, but for one increment of an odd number.
        ends = np.append(inner[inner < count - count % 2], count - count % 2)
        if 2 * pairs > count:
            warnings.warn(
                f"update_interval: {seconds:g} s is longer than the record, {interval * count:g} s:"
                " there is one update only, and little is learnt beyond the prior.",
                UnusualWarning,
                stacklevel=3,
            )
        return ends, np.zeros((len(ends), 3))
    reference = finite_array(reference_velocity, "reference_velocity", 3)
    number = reference.shape[-2] if reference.ndim > 1 else 0
    if number == 0 or count % (2 * number):
        raise ValueError(
            "reference_velocity: expected shape (..., updates, 3), with a number of updates that "
            f"divides {count} increments into even parts, got shape {reference.shape}. "
            "Velocities of other moments go with their reference_times."
        )
    return np.arange(1, number + 1) * (count // number), reference


def _nearest_pairs(count: int, interval: float, reference_times: ArrayLike) -> NDArray[Any]:
    """Even numbers of increments nearest to times since the start, s."""
    times = finite_array(reference_times, "reference_times")
    end = interval * count
    if times.ndim != 1 or times.min() < interval / 2 or times.max() > end + interval:
        raise ValueError(
            "reference_times: expected times (k,) since the start, from half an interval, "
            f"{interval / 2:g} s, to {end:g} s, got shape {times.shape}, {times.min():g} to "
            f"{times.max():g} s."
        )
    ends = np.clip(2 * np.round(times / (2 * interval)).astype(int), 2, count - count % 2)
    if (np.diff(ends) <= 0).any():
        raise ValueError(
            "reference_times: expected times that rise by more than a pair of increments, "
            f"{2 * interval:g} s, got a step of {np.diff(times).min():g} s."
        )
    if count - ends[-1] > np.diff(ends, prepend=0).max():
        warnings.warn(
            f"reference_times: the record goes on for {interval * (count - ends[-1]):g} s after "
            "the last of them; that is not used.",
            stacklevel=4,
        )
    return ends
