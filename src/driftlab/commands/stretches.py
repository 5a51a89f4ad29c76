"""Alignment of a record and of its stretches: their scatter says how far the whole is known."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.core.vectors import wrap_angle
from driftlab.frames import pitch_and_roll
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.alignment_results import Alignment
from driftlab.recordings.recording import Recording

from .blindness import blindness
from .record import forces, rates
from .stillness import moved_at

STRETCHES = 10
"""The record is aligned in as many parts too."""
FOUND = Alignment._fields[:5]
"""What an alignment finds: four angles and the level rate."""


class Spread(NamedTuple):
    """Means of the stretches, the alignment of the whole, and what follows from their scatter.

    Attributes
    ----------
    rate, force : ndarray, shape (10, 3)
        Means of the stretches; body axes forward, up, right; rad/s and m/s^2.
    whole, parts, deviation : Alignment
        Of the record, of the stretches (10,), and standard deviations of that of the record.
        Where the gyros do not see the Earth all but pitch and roll is NaN.
    blind : str
        Why the means give no heading, in a sentence; empty if they do.
    biased : bool
        Whether no other method mends that: it is the gyros' own fault, or the unit was moved.
    """

    rate: FloatArray
    force: FloatArray
    whole: Alignment
    parts: Alignment
    deviation: Alignment
    blind: str
    biased: bool


def aligned(recording: Recording) -> Spread:
    """Align a record by its means, with deviations from its stretches.

    A record with too few rows is refused.
    """
    if len(recording) < STRETCHES:
        raise ValueError(f"log: expected at least {STRETCHES} rows, got {len(recording)}.")
    known = recording.in_axes("FUR")
    rate, force = (
        np.stack([part.mean(axis=0) for part in np.array_split(rows, STRETCHES)])
        for rows in (rates(known), forces(known))
    )
    blind, biased = _moved(recording) or blindness(rate)
    # `driftlab.commands.trust` says in its own words how far the rates are to be believed.
    method = _levelled if blind else partial(align, heading_tolerance=np.inf)
    whole = method(rates(known).mean(axis=0), forces(known).mean(axis=0))
    parts = method(rate, force)
    scatter = [getattr(parts, name) - getattr(whole, name) for name in FOUND]
    scatter[:4] = [wrap_angle(each) for each in scatter[:4]]
    deviation = [np.sqrt((each**2).sum() / (STRETCHES - 1) / STRETCHES) for each in scatter]
    return Spread(rate, force, whole, parts, Alignment(*deviation), blind, biased)


def _moved(recording: Recording) -> tuple[str, bool] | None:
    """A reason that goes before all others: the unit did not stay where it was."""
    moment = moved_at(recording)
    if moment is None:
        return None
    return (
        f"No heading: the unit was moved at {moment:.6g} s. Choose a stretch at rest by --begin "
        "and --end; pitch and roll, too, are means over all that it did."
    ), True


def _levelled(rate: FloatArray, force: FloatArray) -> Alignment:
    """Pitch and roll alone."""
    pitch, roll = pitch_and_roll(force / np.linalg.norm(force, axis=-1, keepdims=True))
    unknown = np.full(np.shape(pitch), np.nan)
    return Alignment(unknown, pitch, roll, unknown, unknown)
