"""The record itself: as rates, in plots, and when the unit was moved."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray
from driftlab.recordings.recording import Recording

from .findings import AXES, Curve, Plot

# Time of a window, s, and how many of them there must be: of short records they are shorter.
WINDOW, FEWEST = 1.0, 20
FAR = 15.0  # median distances from the median: a window so far from the others is a move


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


def outline(x: FloatArray, y: FloatArray, bins: int = 500) -> tuple[FloatArray, FloatArray]:
    """Thin out a long line so that it looks the same: the least and the largest of each bin."""
    size = len(y) // bins
    if size < 4:
        return x, y
    whole = bins * size
    parts = y[:whole].reshape(bins, size)
    seen = np.stack([parts.min(axis=1), parts.max(axis=1)], axis=1).ravel()
    return np.repeat(x[:whole:size], 2), seen


def lines(x: FloatArray, rows: FloatArray, names: tuple[str, ...] = AXES) -> tuple[Curve, ...]:
    """Three curves of the columns of `rows` (n, 3)."""
    return tuple(Curve(name, *outline(x, y)) for name, y in zip(names, rows.T, strict=True))


def record_plots(
    recording: Recording, shaded: tuple[tuple[float, float], ...] = ()
) -> tuple[Plot, ...]:
    """The record over time, some stretches of it shaded."""
    x, note = moments(recording), ", shaded where at rest" if shaded else ""
    gyros = lines(x, np.degrees(rates(recording)))
    plots = [Plot(f"Gyros{note}", "time, s", "deg/s", gyros, shaded)]
    if recording.accelerometer is not None:
        shown = lines(x, forces(recording))
        plots.append(Plot(f"Accelerometers{note}", "time, s", "m/s²", shown, shaded))
    return tuple(plots)
