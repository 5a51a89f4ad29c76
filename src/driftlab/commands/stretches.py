"""Alignment of a record and of its stretches: their scatter says how far the whole is known."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RATE
from driftlab.frames import pitch_and_roll
from driftlab.gyrocompass.alignment import Alignment, align
from driftlab.recordings.recording import Recording

from .numbers import RATES, written
from .record import forces, rates

STRETCHES = 10
"""The record is aligned in as many parts too."""


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
        Whether that is the gyros' own fault, which no other method mends.
    """

    rate: FloatArray
    force: FloatArray
    whole: Alignment
    parts: Alignment
    deviation: Alignment
    blind: str
    biased: bool


def aligned(recording: Recording) -> Spread:
    """Alignment of a record by its means, with deviations from its stretches.

    Raises
    ------
    ValueError
        If it has too few rows.
    """
    if len(recording) < STRETCHES:
        raise ValueError(f"log: expected at least {STRETCHES} rows, got {len(recording)}.")
    known = recording.in_axes("FUR")
    rate, force = (
        np.stack([part.mean(axis=0) for part in np.array_split(rows, STRETCHES)])
        for rows in (rates(known), forces(known))
    )
    blind, biased = blindness(rate)
    method = _levelled if blind else align
    whole = method(rates(known).mean(axis=0), forces(known).mean(axis=0))
    parts = method(rate, force)
    scatter = [part - each for each, part in zip(whole, parts, strict=True)]
    scatter[:4] = [wrap_angle(each) for each in scatter[:4]]
    deviation = [np.sqrt((each**2).sum() / (STRETCHES - 1) / STRETCHES) for each in scatter]
    return Spread(rate, force, whole, parts, Alignment(*deviation), blind, biased)


def blindness(rate: FloatArray) -> tuple[str, bool]:
    """Why means (10, 3) of gyros do not see the Earth turn, and whether biases are the reason.

    A rate of the wrong size has an error at least as large as the difference: half the Earth's rate
    may turn the heading by half a radian and more. Empty and False if they see it.
    """
    found = float(np.linalg.norm(rate.mean(axis=0)))
    noise = float(rate.std(axis=0, ddof=1).max() / np.sqrt(STRETCHES))
    sizes = (found, EARTH_RATE, noise)
    shown, earth, spread = (written(size / RATES[1].size, digits=4) for size in sizes)
    if abs(found - EARTH_RATE) > max(EARTH_RATE / 2, 3 * noise):
        return (
            f"No heading: at rest the gyros show {shown} deg/h, and the Earth turns by {earth} "
            "deg/h. Their biases hide it; a compass needs gyros whose biases are a small part of "
            "the Earth's rate. Pitch and roll come from the accelerometers."
        ), True
    if noise > EARTH_RATE / 5:
        return (
            f"No heading from the means: they are known to {spread} deg/h only, and the Earth "
            f"turns by {earth} deg/h. The base was not still, or the record is too short for such "
            "gyros. Pitch and roll come from the accelerometers."
        ), False
    return "", False


def _levelled(rate: FloatArray, force: FloatArray) -> Alignment:
    """Pitch and roll alone."""
    pitch, roll = pitch_and_roll(force / np.linalg.norm(force, axis=-1, keepdims=True))
    unknown = np.full(np.shape(pitch), np.nan)
    return Alignment(unknown, pitch, roll, unknown, unknown)
