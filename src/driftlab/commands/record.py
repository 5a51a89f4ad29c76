"""The record itself: as rates, in plots, and when the unit was moved."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray
from driftlab.recordings.recording import Recording

from .findings import Plot, Shading, lines

AXES = ("x", "y", "z")
WINDOW, FEWEST = 1.0, 20
"""Time of a window, s, and how many of them there must be: of short records they are shorter."""
FAR = 15.0
"""In median distances from the median: a window so far from the others is a move."""


def moments(recording: Recording) -> FloatArray:
    """Time of each sample since the first, s."""
    if recording.times is None:
        return recording.interval * np.arange(len(recording), dtype=float)
    return recording.times - recording.times[0]


def rates(recording: Recording) -> FloatArray:
    """Angular rate of each sample, or its mean over an interval, (n, 3), rad/s."""
    return recording.gyro / (recording.interval if recording.kind == "increments" else 1.0)


def forces(recording: Recording) -> FloatArray:
    """Specific force of each sample, or its mean over an interval, (n, 3), m/s^2."""
    if recording.accelerometer is None:
        raise ValueError(
            "--columns: expected three gyros and three accelerometers, got gyros only."
        )
    return recording.accelerometer / (recording.interval if recording.kind == "increments" else 1.0)


def moved_at(recording: Recording) -> float | None:
    """Time of the first window of the gyros that stands far from the others, s; None if none does.

    Medians of windows are held against each other, so that single samples count little.
    """
    size = min(round(WINDOW / recording.interval), len(recording) // FEWEST)
    if size < 1:
        return None
    whole = len(recording) // size * size
    medians = np.median(rates(recording)[:whole].reshape(-1, size, 3), axis=1)
    away = np.abs(medians - np.median(medians, axis=0))
    usual = np.median(away, axis=0)
    far = ((away > FAR * usual) & (usual > 0)).any(axis=1)
    return float(moments(recording)[int(np.argmax(far)) * size]) if far.any() else None


def record_plots(recording: Recording, shaded: tuple[Shading, ...] = ()) -> tuple[Plot, ...]:
    """The record over time, some stretches of it shaded."""
    x = moments(recording)
    note = ", shaded where at rest" if shaded else ""
    triads = [("Gyros", "deg/s", np.degrees(rates(recording)))]
    if recording.accelerometer is not None:
        triads.append(("Accelerometers", "m/s²", forces(recording)))
    return tuple(
        Plot(f"{name}{note}", "time, s", unit, lines(x, rows, AXES), shaded)
        for name, unit, rows in triads
    )
