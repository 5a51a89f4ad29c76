"""Doubts about a log: units that cannot be, columns that are mixed up, channels that do not live.

A wrong unit gives no error anywhere, only a wrong answer. What physics can say about a log is said
here before it is used: gravity has its size; it turns in the body as the gyros tell; sensors have
ends of their range, and noise.

Some slips leave no trace. Of a unit that lies still, or is tilted less than five times, the gyros'
unit, signs and order cannot be told, unless they come out faster than gyros are: degrees of a gyro
at rest pass for radians. What turns about the vertical only, or slower than seven degrees a second,
is not tested. A log with all accelerometers negated (some phones give gravity instead of specific
force), or with both triads in other but right-handed axes, is as good as any. A factor below 1.4, a
bias, and a constant delay between the triads are errors of an instrument, not slips of a reader.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.constants import g as STANDARD_GRAVITY

from driftlab.checks import checked_instance, some_of

from ._slips import (
    force_factors as force_factors,
    force_slips,
    gyro_factors as gyro_factors,
    gyro_slips,
)
from .channels import CLIPPED_RATIO, clipped_rows, dead_channels, longest_run, twin_channels
from .recording import Recording
from .turns_of_gravity import gravity_turns

RULES = {
    "force": "the median specific force has the size of gravity",
    "rate": "no gyro exceeds the usual range",
    "half turn": "no angle over one interval exceeds half a turn",
    "turning": "gravity turns in the body as fast as the gyros say",
    "axes": "and it turns about the axes, and in the sense, that they say",
    "dead": "no channel is constant while others change",
    "stuck": "no channel keeps one value for much longer than it usually does",
    "clipped": "no channel stays at its extreme value",
    "twins": "no two channels are the same",
    "gap": "no sample is missing between two time stamps",
}
"""Rules that a good log keeps, under the names that `allow` takes."""

_CHANNELS = ("gyro x", "gyro y", "gyro z", "accelerometer x", "accelerometer y", "accelerometer z")
_FORCE_FACTOR = 1.8
"""Half way, as a factor, to the least slip of units known here: feet for metres, 3.28."""
_TURNING_FACTOR = 2**0.5
"""Half way to the least slip of the interval known here: every other sample lost."""
_MAJORITY = 0.5
"""Share of gravity's turns that a slip must explain to be named; good logs have 0.9 and more."""
_MOST_RATE = 1.05 * np.radians(2000)
"""End of the range of most gyros, and the errors of scale of a bad one, rad/s."""
_LONGEST_GAP = 1.5
"""In usual steps: a lost sample makes 2."""


@dataclass(frozen=True)
class Doubt:
    """One reason not to believe a log as it was read.

    Attributes
    ----------
    rule : str
        One of `RULES`.
    sentence : str
        What was found, and what it may mean. Also the doubt's own text.
    size, threshold : float
        What was measured, and what the rule lets through.

    Examples
    --------
    >>> print(Doubt("dead", "gyro x: constant.", 0.0, 0.0))
    gyro x: constant.
    """

    rule: str
    sentence: str
    size: float
    threshold: float

    def __str__(self) -> str:
        return self.sentence


def doubts(recording: Recording) -> tuple[Doubt, ...]:
    """Return what speaks against a recording's units, axes and channels.

    Parameters
    ----------
    recording : Recording
        As it was read.

    Returns
    -------
    tuple of Doubt
        In the order of `RULES`; empty if nothing speaks against it. That proves nothing: the
        module says which slips cannot be seen.

    Examples
    --------
    A unit that lies still, whose specific force in g was taken for m/s^2:

    >>> still = Recording(np.zeros((200, 3)), np.tile([0.0, 0.0, 1.0], (200, 1)), 0.01, "rates")
    >>> for doubt in doubts(still):
    ...     print(doubt.rule, "-", doubt)  # doctest: +NORMALIZE_WHITESPACE
    force - accelerometer: expected a median size near gravity, 9.81 m/s^2, got 1,
    a factor of 0.102: g taken for m/s^2?
    """
    checked_instance(recording, Recording, "recording")
    found = [*_size_doubts(recording), *_turning_doubts(recording), *_channel_doubts(recording)]
    order = list(RULES)
    return tuple(sorted(found, key=lambda doubt: order.index(doubt.rule)))


def without_doubts(recording: Recording, allow: Sequence[str] = ()) -> Recording:
    """Return a recording if nothing speaks against it but what is allowed.

    Parameters
    ----------
    recording : Recording
        As it was read.
    allow : sequence of str
        Names of `RULES` that it may break.

    Returns
    -------
    Recording
        The same.

    Raises
    ------
    ValueError
        With the sentences of the doubts; or if there is no such rule.

    Examples
    --------
    >>> fast = Recording(np.full((9, 3), 90.0), None, 0.01, "rates", name="log")
    >>> without_doubts(fast)  # doctest: +NORMALIZE_WHITESPACE
    Traceback (most recent call last):
    ValueError: log: gyro: expected rates up to 36.7 rad/s, the range of most gyros, got 90: degrees
    taken for radians? Right all the same? Then say allow=("rate",).
    >>> without_doubts(fast, allow=["rate"]) is fast
    True
    """
    allow = some_of(allow, RULES, "allow")
    found = [doubt for doubt in doubts(recording) if doubt.rule not in allow]
    if found:
        rules = ", ".join(f'"{rule}"' for rule in dict.fromkeys(doubt.rule for doubt in found))
        listed = rules if "," in rules else f"{rules},"
        raise ValueError(
            f"{recording.name or 'recording'}: {' '.join(map(str, found))} "
            f"Right all the same? Then say allow=({listed})."
        )
    return recording


def _size_doubts(recording: Recording) -> Iterator[Doubt]:
    """Doubts about the size of the numbers alone."""
    rates = recording.kind == "rates"
    step = recording.interval
    if recording.accelerometer is not None:
        gravity = STANDARD_GRAVITY if recording.gravity is None else recording.gravity
        expected = gravity * (1 if rates else step)
        size = float(np.median(np.linalg.norm(recording.accelerometer, axis=1)))
        if not 1 / _FORCE_FACTOR < size / expected < _FORCE_FACTOR:
            unit = "m/s^2" if rates else "m/s, gravity times the interval"
            yield Doubt(
                "force",
                f"accelerometer: expected a median size near {'gravity, ' * rates}"
                f"{expected:.3g} {unit}, got {size:.3g}, a factor of {size / expected:.3g}"
                f"{force_slips(size / expected, recording)}",
                size / expected,
                _FORCE_FACTOR,
            )
    largest = float(np.abs(recording.gyro).max())
    rate, angle = (largest, largest * step) if rates else (largest / step, largest)
    if rate > _MOST_RATE:
        yield Doubt(
            "rate",
            f"gyro: expected rates up to {_MOST_RATE:.3g} rad/s, the range of most gyros, got "
            f"{rate:.3g}: degrees taken for radians{'' if rates else ', or rates for angles'}?",
            rate,
            _MOST_RATE,
        )
    if angle > np.pi:
        yield Doubt(
            "half turn",
            f"gyro: expected less than half a turn over one interval of {step:.3g} s, got "
            f"{angle:.3g} rad: is it the interval, or the unit?",
            angle,
            np.pi,
        )
    if recording.times is not None and len(recording) > 2:
        steps = np.diff(recording.times)
        row, longest = int(np.argmax(steps)), round(float(steps.max() / np.median(steps)), 9)
        if longest > _LONGEST_GAP:
            yield Doubt(
                "gap",
                f"times: expected steps of about {np.median(steps):.4g} s, got one of "
                f"{steps[row]:.4g} s after row {row + 1}, at "
                f"{recording.times[row] - recording.times[0]:.6g} s: samples are missing.",
                longest,
                _LONGEST_GAP,
            )


def _turning_doubts(recording: Recording) -> Iterator[Doubt]:
    """Doubts that come from gravity's turns in the body."""
    found = gravity_turns(recording)
    if found is None or found.explained < max(found.needed, _MAJORITY):
        return
    evidence = f"over {found.turns} turns of gravity in the body, {found.explained:.0%} explained"
    too_large = 1 / found.factor
    if not 1 / _TURNING_FACTOR < too_large < _TURNING_FACTOR:
        yield Doubt(
            "turning",
            f"gyro: expected gravity to turn as far as the gyros say, got {too_large:.3g} times as "
            f"much from them ({evidence}){gyro_slips(too_large, recording)}",
            too_large,
            _TURNING_FACTOR,
        )
    if (found.order != np.eye(3)).any():
        if (found.order == -np.eye(3)).all():
            slip = "the other way: left-handed axes, or gyros with the other sign"
        else:
            columns = (
                f"{'-' * bool(row.sum() < 0)}{'xyz'[int(np.argmax(abs(row)))]}"
                for row in found.order
            )
            slip = f"as if x, y, z were the gyros' {', '.join(columns)}: signs, or order of columns"
        yield Doubt(
            "axes",
            f"gyro: expected gravity to turn about the axes that the gyros say, got it turning "
            f"{slip} ({evidence}).",
            found.explained,
            found.needed,
        )


def _channel_doubts(recording: Recording) -> Iterator[Doubt]:
    """Doubts about channels, whatever their units."""
    triads = [recording.gyro]
    if recording.accelerometer is not None:
        triads.append(recording.accelerometer)
    channels = np.concatenate(triads, axis=1)
    dead = dead_channels(channels)
    for name, channel, lifeless in zip(_CHANNELS, channels.T, dead, strict=False):
        if lifeless:
            yield Doubt(
                "dead",
                f"{name}: expected values that change as in other channels, got {channel[0]:.6g} "
                f"in all {len(channel)} rows.",
                0.0,
                0.0,
            )
        if np.ptp(channel) == 0:
            continue
        rows, ratio = clipped_rows(channel)
        if ratio > CLIPPED_RATIO:
            yield Doubt(
                "clipped",
                f"{name}: expected few values at the extreme, got {rows} rows there, {ratio:.3g} "
                "for each at the level beside it: the end of the range?",
                ratio,
                CLIPPED_RATIO,
            )
            continue  # a channel at its end keeps one value for long
        begin, rows, allowed = longest_run(channel)
        if rows > allowed:
            yield Doubt(
                "stuck",
                f"{name}: expected no value more than {allowed:.0f} times in a row, got "
                f"{channel[begin]:.6g} in {rows} rows from row {begin + 1} on.",
                float(rows),
                allowed,
            )
    for one, other in twin_channels(channels):
        yield Doubt(
            "twins",
            f"{_CHANNELS[one]} and {_CHANNELS[other]}: expected different channels, got the same: "
            "one column read twice?",
            1.0,
            1 - 1e-9,
        )
