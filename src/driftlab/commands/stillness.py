"""Whether a unit lay still, and when it was moved."""

from __future__ import annotations

import numpy as np

from driftlab.recordings.recording import Recording

from .record import moments, rates

WINDOW, FEWEST = 1.0, 20
"""Time of a window, s, and how many of them there must be: of short records they are shorter."""
FAR = 15.0
"""In median distances from the median: a window so far from the others is a move."""


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
