"""Alignment of a record at rest: by its means, by gravity in inertial space, and what to trust.

The scatter of its stretches says how far noise leaves the means known, and the Earth's own rate
what a drift of the gyros may do to the heading.
"""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.constants import degree, hour

from driftlab.checks import FloatArray
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RATE
from driftlab.frames import _pitch_and_roll
from driftlab.gyrocompass._contradictions import NOTHING_KNOWN, rate_contradiction
from driftlab.gyrocompass.alignment import Alignment, align
from driftlab.gyrocompass.inertial_alignment import InertialAlignment, align_in_inertial_frame
from driftlab.increments import Increments

from .numbers import DEG_PER_HOUR, written

STRETCHES = 10
"""The record is aligned in as many parts too."""
FOUND = Alignment._fields[:5]
"""What an alignment finds: four angles and the level rate."""
MOST = np.radians(60.0)
"""A drift that may turn a heading farther leaves the deviation of one of which nothing is known."""
SLIPS = {
    1 / degree: "degrees taken for radians",
    degree: "radians taken for degrees",
    hour: "deg/h taken for deg/s",
    1 / hour: "deg/s taken for deg/h",
}
"""By the factor that they make of a rate."""
CLOSE = 1.1
"""A factor so near to that of a slip may be it."""
LEVELS = "Pitch and roll come from the accelerometers."
MOVED = (
    "No heading: the unit was moved at {:.6g} s. Choose a stretch at rest by --begin and --end; "
    "pitch and roll, too, are means over all that it did."
)
NO_INERTIAL = "Gravity in inertial space gives no heading: "


class Samples(NamedTuple):
    """A record in body axes forward, up, right, and what was told of it; SI and radians."""

    times: FloatArray  # (n,), since the first sample
    rate: FloatArray  # (n, 3)
    force: FloatArray  # (n, 3)
    increments: Increments | None  # for gravity in inertial space
    why_not: str  # in a sentence, why there are no increments
    moved: float | None  # when the unit did not stay where it was
    duration: float
    latitude: float | None
    gravity: float | None
    axes: str  # those of the log


class AtRest(NamedTuple):
    """What a record at rest says of its attitude, and how far that is known; SI and radians."""

    samples: Samples
    times: FloatArray  # (10,), middles of the stretches
    rate: FloatArray  # (3,), mean
    force: FloatArray  # (3,), mean
    # Of the record, of the stretches (10,), and standard deviations of that of the record. Where
    # the gyros do not see the Earth all but pitch and roll is NaN.
    whole: Alignment
    parts: Alignment
    deviation: Alignment
    blind: str  # why the means give no heading, in a sentence; empty if they do
    biased: bool  # no other method mends that: it is the gyros' own fault, or the unit was moved
    swaying: InertialAlignment | None  # by gravity in inertial space
    why_not: str  # in a sentence, why there is none
    # Deviation of the gyros' drift, as the rates of the Earth show it that are known, so many;
    # None if there is no heading to spoil.
    drift: float | None = None
    rates: int = 0
    # What such a drift across the meridian makes of the heading, at most that of no knowledge; and
    # of pitch and roll at the end, summed up from the middle of the record.
    turn: float = 0.0
    tilt: float = 0.0
    # Deviations of the headings: the larger of noise and drift.
    of_means: float = np.nan
    in_inertial_space: float = np.nan


def at_rest(samples: Samples) -> AtRest:
    """Align a record in both ways, and say what noise and drift leave of its headings."""
    times, rate, force = (
        np.stack([part.mean(axis=0) for part in np.array_split(rows, STRETCHES)])
        for rows in (samples.times, samples.rate, samples.force)
    )
    if samples.moved is None:
        blind, biased = blindness(rate)
    else:  # a reason that goes before all others
        blind, biased = MOVED.format(samples.moved), True
    # The command says in its own words how far the rates can be trusted.
    method = _levelled if blind else partial(align, heading_tolerance=np.inf)
    whole = method(samples.rate.mean(axis=0), samples.force.mean(axis=0))
    parts = method(rate, force)
    scatter = [getattr(parts, name) - getattr(whole, name) for name in FOUND]
    scatter[:4] = [wrap_angle(each) for each in scatter[:4]]
    deviation = [np.sqrt((each**2).sum() / (STRETCHES - 1) / STRETCHES) for each in scatter]
    swaying, why_not = (None, "") if biased else _in_inertial_space(samples)
    found = AtRest(
        samples=samples,
        times=times,
        rate=rate.mean(axis=0),
        force=force.mean(axis=0),
        whole=whole,
        parts=parts,
        deviation=Alignment(*deviation),
        blind=blind,
        biased=biased,
        swaying=swaying,
        why_not=why_not,
    )
    if not blind:
        level = whole.level_rate
        seen = rate_contradiction(level, level * np.tan(whole.latitude), samples.latitude)
    elif swaying is not None:
        seen = rate_contradiction(swaying.level_rate, latitude=samples.latitude)
    else:
        return found
    drift = float(seen.spurious_rate)
    turn = NOTHING_KNOWN if seen.heading_doubt > MOST else float(seen.heading_doubt)
    return found._replace(
        drift=drift,
        rates=1 if blind or samples.latitude is None else 2,
        turn=turn,
        tilt=drift * samples.duration / 2,
        of_means=max(turn, float(found.deviation.heading)),
        in_inertial_space=max(turn, np.nan if swaying is None else float(swaying.deviation)),
    )


def _levelled(rate: FloatArray, force: FloatArray) -> Alignment:
    """Pitch and roll alone."""
    pitch, roll = _pitch_and_roll(force / np.linalg.norm(force, axis=-1, keepdims=True))
    unknown = np.full(np.shape(pitch), np.nan)
    return Alignment(unknown, pitch, roll, unknown, unknown)


def _in_inertial_space(samples: Samples) -> tuple[InertialAlignment | None, str]:
    """The alignment that lets the base sway, or why there is none."""
    if samples.increments is None or samples.latitude is None:
        return None, samples.why_not
    try:
        return align_in_inertial_frame(samples.increments, samples.latitude), ""
    except ValueError as error:
        return None, f"{NO_INERTIAL}{error}"


def blindness(rate: FloatArray) -> tuple[str, bool]:
    """Why means (n, 3) of gyros do not see the Earth turn, and whether the gyros are the reason.

    A rate of the wrong size has an error at least as large as the difference: half the Earth's rate
    may turn the heading by half a radian and more. Empty and False if they see it.
    """
    found = float(np.linalg.norm(rate.mean(axis=0)))
    noise = float(rate.std(axis=0, ddof=1).max() / np.sqrt(len(rate)))
    sizes = (found, EARTH_RATE, noise)
    shown, earth, spread = (written(size / DEG_PER_HOUR.size, digits=4) for size in sizes)
    if abs(found - EARTH_RATE) > max(EARTH_RATE / 2, 3 * noise):
        return (
            f"No heading: at rest the gyros show {shown} deg/h, and the Earth turns by {earth} "
            f"deg/h. {_reason(found / EARTH_RATE)} {LEVELS}"
        ), True
    if noise > EARTH_RATE / 5:
        return (
            f"No heading from the means: they are known to {spread} deg/h only, and the Earth "
            f"turns by {earth} deg/h. The base was not still, or the record is too short for such "
            f"gyros. {LEVELS}"
        ), False
    return "", False


def _reason(factor: float) -> str:
    """What makes a rate wrong by a factor."""
    slips = [slip for one, slip in SLIPS.items() if 1 / CLOSE < factor / one < CLOSE]
    ratio = f"{factor:.3g} times" if factor > 1 else f"1/{1 / max(factor, 1e-9):.3g} of"
    named = f"That is {ratio} the Earth's rate: {slips[0]}? Or " if slips else ""
    if factor < 1:
        reason = "the logger has taken the bias off already, and with it the Earth's rate."
    else:
        reason = (
            "their biases hide it; a compass needs gyros whose biases are a small part of the "
            "Earth's rate."
        )
    return f"{named}{reason}" if named else reason[0].upper() + reason[1:]
