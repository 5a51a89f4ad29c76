"""Integration of a levelled frame: the arithmetic of `driftlab.gyrocompass.levelling`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from driftlab.checks import FloatArray

from .vectors import cross

_FEW = 12
"""Up to this many runs are integrated one by one in Python floats: faster than short arrays."""


def force_at_start(angle: FloatArray, velocity: FloatArray) -> FloatArray:
    """Velocity increments (..., n, 3) in the body axes at the start of each interval.

    The body turns at a constant rate while the force, most of which is gravity, stands still in
    space.
    """
    a, v = (np.moveaxis(part, -1, 0) for part in np.broadcast_arrays(angle, velocity))
    once = cross(a, v)
    return np.moveaxis(v + once / 2 + cross(a, once) / 12, 0, -1)


def integrated_runs(
    first: FloatArray, steps: list[FloatArray], interval: float, k1: float, k2: float, every: int
) -> FloatArray:
    """Results (..., k, 8) of `_integrate` from first (..., 6) with steps (..., n, m)."""
    lead = first.shape[:-1]
    if math.prod(lead) > _FEW:
        components = [np.moveaxis(part, (-2, -1), (0, 1)) for part in steps]
        rows = _integrate(np.moveaxis(first, -1, 0), components, interval, k1, k2, every)
        return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
    try:
        runs = [
            _integrate(first[i].tolist(), [s[i].tolist() for s in steps], interval, k1, k2, every)
            for i in np.ndindex(lead)
        ]
    except ZeroDivisionError:  # where arrays have infinity
        return np.array(np.inf)
    return np.reshape(runs, (*lead, -1, 8))


def _integrate(
    first: Any, steps: Any, interval: float, k1: float, k2: float, every: int
) -> list[Any]:
    """Rows of attitude, integral and proportional parts of the rates, after each `every` steps.

    All operations are plain arithmetic, so the same lines serve floats and arrays. In a step the
    horizon goes halfway, looks at the force there, and goes all the way with what it has seen: a
    leapfrog, which keeps the amplitude of an undamped oscillation.
    """
    x, y, z, w, i1, i3 = first
    half = 0.5 * interval
    rows = []
    for number, ((a, b, c, d), (f1, f2, f3), (u,)) in enumerate(zip(*steps, strict=True), 1):
        # The force in the horizon at the beginning of the step, v + 2 w q×v + 2 q×(q×v) ...
        t1, t2, t3 = 2 * (y * f3 - z * f2), 2 * (z * f1 - x * f3), 2 * (x * f2 - y * f1)
        g1 = f1 + w * t1 + y * t3 - z * t2
        g2 = f2 + w * t2 + z * t1 - x * t3
        g3 = f3 + w * t3 + x * t2 - y * t1
        # ... and in the horizon of the middle. It has turned by half of the integrals' rates and,
        # solved for the force there, by half of the proportional part.
        share = 1 / (1 + half * k1 * g2)
        w1 = share * (g1 - half * (u * g3 - i3 * g2))
        w3 = share * (g3 - half * (i1 * g2 - u * g1))
        i1, i3 = i1 + half * k2 * w3, i3 - half * k2 * w1
        r1, r3 = i1 + k1 * w3, i3 - k1 * w1
        i1, i3 = i1 + half * k2 * w3, i3 - half * k2 * w1
        # The body's turn on the right of the quaternion, ...
        x, y, z, w = (
            w * a + x * d + y * c - z * b,
            w * b + y * d + z * a - x * c,
            w * c + z * d + x * b - y * a,
            w * d - x * a - y * b - z * c,
        )
        # ... the horizon's on the left, by series: it turns by little.
        h1, h2, h3 = half * r1, half * u, half * r3
        s = h1 * h1 + h2 * h2 + h3 * h3
        small = 1 - s / 6 + s * s / 120
        h1, h2, h3, h4 = h1 * small, h2 * small, h3 * small, 1 - s / 2 + s * s / 24
        x, y, z, w = (
            h4 * x - h1 * w - h2 * z + h3 * y,
            h4 * y - h2 * w - h3 * x + h1 * z,
            h4 * z - h3 * w - h1 * y + h2 * x,
            h4 * w + h1 * x + h2 * y + h3 * z,
        )
        length = 1.5 - 0.5 * (x * x + y * y + z * z + w * w)
        x, y, z, w = length * x, length * y, length * z, length * w
        if number % every == 0:
            # The integrals are those of the end of the step; the force is a mean over the step.
            rows.append((x, y, z, w, i1, i3, k1 * w3, -k1 * w1))
    return rows
