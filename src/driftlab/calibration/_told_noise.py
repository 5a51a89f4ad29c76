"""Is the noise of the sensors what the filter was told? The rests of a record show it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.special import chdtri

from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise
from driftlab.increments import Increments

from ._evidence import Evidence

_BLOCKS = 4
"""A rest window is compared in so many parts: long ones, so that counts of a coarse unit and what
vibrates do not pass for noise."""
_ENOUGH = 30
"""Degrees of freedom: of so many, the root of a mean square scatters by an eighth."""
LARGER = 2.0
"""Noise so many times what was told is named: of right records, not one in 10^12."""
_ANGLES = {
    "degrees for radians, or degrees/sqrt(h) for degrees/sqrt(s)?": np.degrees(1.0),
    "degrees/sqrt(h) for rad/sqrt(s)?": 60 * np.degrees(1.0),
}
_NEAR = 1.3
"""Sensors that are better than told are no slip; but noise so near to that in another unit is."""


def told_noise(
    increments: Increments, shown: Evidence | None, told: ImuNoise
) -> tuple[list[str], ImuNoise]:
    """Sentences on the noise of gyros and accelerometers if it is not what was told, and what it is
    then."""
    sentences: list[str] = []
    right = told
    triads = (
        ("gyros", "angle_random_walk", increments.angle),
        ("accelerometers", "velocity_random_walk", increments.velocity),
    )
    for triad, name, rows in triads:
        size = float(getattr(told, name))
        if shown is None or size == 0:
            continue
        found = _random_walk(rows, shown, increments.interval)
        if found is None:
            continue
        ratio = found / size
        unit = _unit(ratio) if triad == "gyros" else ""
        if ratio > LARGER or unit:
            sentences.append(f"{triad}: noise {ratio:.2g} times what was told{unit}")
            right = replace(right, **{name: found})
    return sentences, right


def _random_walk(rows: FloatArray, shown: Evidence, interval: float) -> float | None:
    """White noise of increments (n, 3) in windows that rest, per square root of a second; None if
    there are too few."""
    rest, each = shown.rest, round(shown.window / interval)
    part = each // _BLOCKS if each >= _BLOCKS else 1
    blocks = each // part
    freedom = 3 * (blocks - 1)  # of one window
    if freedom * int(rest.sum()) < _ENOUGH:
        return None
    windows = rows[: each * len(rest)].reshape(len(rest), each, 3)[rest, : blocks * part]
    sums = windows.reshape(-1, blocks, part, 3).sum(axis=2)
    squares = np.sum((sums - sums.mean(axis=1, keepdims=True)) ** 2, axis=(1, 2))
    # The median, because one or another window may end as a turn begins.
    typical = float(np.median(squares)) / float(chdtri(freedom, 0.5))
    return float(np.sqrt(typical / (part * interval)))


def _unit(ratio: float) -> str:
    """Words for a factor that is one of units of angle."""
    for name, factor in _ANGLES.items():
        if 1 / _NEAR < ratio * factor < _NEAR:
            return f": {name}"
    return ""
