"""What is wrong with single channels of a log: dead, stuck, clipped, or the same one twice."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

ENOUGH = 100
"""Rows from which something is concluded about a channel."""
_CHANCE = 1e-6
"""Of a run of equal values so long, where runs are as those seen elsewhere in the channel."""
CLIPPED_RATIO = 5.0
"""Values at the extreme for each at the next level; a swing without noise has 1/(√2 - 1) = 2.4."""


def dead_channels(channels: FloatArray) -> list[bool]:
    """Say which channels never change while another one does.

    Parameters
    ----------
    channels : ndarray, shape (n, k)
        Of any units.

    Returns
    -------
    list of bool

    Examples
    --------
    >>> dead_channels(np.stack([np.arange(200.0), np.ones(200)], axis=1))
    [False, True]
    """
    constant = np.ptp(channels, axis=0) == 0
    return [bool(one and len(channels) >= ENOUGH) for one in constant & ~constant.all()]


def longest_run(channel: FloatArray) -> tuple[int, int, float]:
    """Return the longest run of equal values, and how long one may be by chance.

    Parameters
    ----------
    channel : ndarray, shape (n,)
        Of any unit.

    Returns
    -------
    begin, rows : int
        Its first row, and how many rows it has.
    allowed : float
        Twice the rows that are passed once in a million records, if the runs above the shortest of
        the longest tenth fall off as the middle one of them tells. Coarse steps and samples that
        are written twice thus make long runs usual; twice, because a unit at rest has longer ones.

    Examples
    --------
    >>> noise = np.random.default_rng(1).normal(size=500)
    >>> noise[100:150] = noise[100]
    >>> longest_run(noise)[:2]
    (100, 50)
    """
    begins = np.flatnonzero(np.concatenate([[True], np.diff(channel) != 0]))
    rows = np.diff(np.append(begins, len(channel)))
    longest = int(np.argmax(rows))
    tail = np.sort(rows)[-max(len(rows) // 10, min(len(rows), 10)) :]
    # A geometric tail: the middle excess, with half a row for the rounding, over ln 2 is the mean.
    excess = (np.median(tail - tail[0]) + 0.5) / np.log(2)
    allowed = 2 * (tail[0] + excess * np.log(len(tail) / _CHANCE))
    return int(begins[longest]), int(rows[longest]), float(allowed)


def clipped_rows(channel: FloatArray) -> tuple[int, float]:
    """Return how many rows stand at an extreme value as if the channel were cut off there.

    Parameters
    ----------
    channel : ndarray, shape (n,)
        Of any unit.

    Returns
    -------
    rows : int
        At the extreme, if three of them follow each other; 0 otherwise.
    ratio : float
        Of them to those at the level next to the extreme (and one more, lest it be none).

    Examples
    --------
    >>> swing = 2 * np.sin(np.arange(1000) / 20)
    >>> clipped_rows(swing), clipped_rows(np.minimum(swing, 1.5))
    ((0, 0.0), (232, 116.0))
    """
    found = (0, 0.0)
    for rising in (channel, -channel):
        there = rising == rising.max()
        below = rising[~there]
        # What stands there most of the time rests; few pulses of a quiet gyro go one way only.
        if len(below) > len(rising) / 2 and (there[2:] & there[1:-1] & there[:-2]).any():
            count, beside = int(there.sum()), int((below == below.max()).sum())
            found = max(found, (count, count / (beside + 1)), key=lambda one: one[1])
    return found


def twin_channels(channels: FloatArray) -> list[tuple[int, int]]:
    """Return pairs of channels that are the same, but for unit, sign and zero.

    Parameters
    ----------
    channels : ndarray, shape (n, k)
        Of any units.

    Returns
    -------
    list of tuple of int

    Examples
    --------
    >>> one, other = np.random.default_rng(1).normal(size=(2, 200))
    >>> twin_channels(np.stack([one, other, -2 * one], axis=1))
    [(0, 2)]
    """
    spread = np.ptp(channels, axis=0)
    alive = np.flatnonzero(spread > 0)
    if len(channels) < ENOUGH or len(alive) < 2:
        return []
    alike = np.abs(np.corrcoef(channels[:, alive].T / spread[alive, None])) > 1 - 1e-9
    return [(int(alive[i]), int(alive[j])) for i, j in np.argwhere(np.triu(alike, 1))]
