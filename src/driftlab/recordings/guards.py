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
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from scipy.constants import g as STANDARD_GRAVITY

from driftlab.checks import FloatArray, checked_instance, some_of

from ._slips import force_slips, gyro_slips
from .recording import Recording

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
_ENOUGH_ROWS = 100
"""Rows from which something is concluded about a channel."""
_CHANCE_OF_RUN = 1e-6
"""Of a run of equal values so long, where runs are as those seen elsewhere in the channel."""
_CLIPPED_RATIO = 5.0
"""Values at the extreme for each at the next level; a swing without noise has 1/(√2 - 1) = 2.4."""
_BLOCK = 1 << 12
"""Rows that are copied at once."""
_WINDOW = 0.25
"""Length of a moment in which the unit may be held still, s."""
_STEADY, _NEAR = 0.1, 0.2
"""Still is: specific force spreads less than this, and differs less from its median, in g."""
_TURN = 0.2
"""A turn of gravity that counts, in g: eleven degrees."""
_REST = 0.03
"""A change of gravity from one window to the next that is none, in g: seven degrees a second."""
_ENOUGH_TURNS = 5
"""Turns from which something is concluded."""
_CHANCE_OF_TURNS = 1e-3
"""Of taking gravity's turns for explained where the gyros have nothing to do with them."""
_TIED = 0.01
"""Share of gravity's turns that a good triad may leave unexplained."""
_ORDERS = np.array(
    sorted(
        (
            np.eye(3)[list(order)] * np.array(signs)[:, None]
            for order in permutations(range(3))
            for signs in product((1, -1), repeat=3)
        ),
        key=np.trace,
        reverse=True,
    )
)
"""Ways (48, 3, 3) to take the columns of a triad in some order and with some signs; those that
change least stand first."""
_CROSS = np.cross(np.eye(3)[:, None], np.eye(3)[None])
"""Entries (j, k, i): component i of the product of unit vectors j and k."""


@dataclass(frozen=True)
class DataProblem:
    """One reason not to believe a log as it was read.

    Attributes
    ----------
    rule : str
        One of `RULES`.
    sentence : str
        What was found, and what it may mean. Also the text of the problem itself.
    size, threshold : float
        What was measured, and what the rule lets through.
    """

    rule: str
    sentence: str
    size: float
    threshold: float

    def __str__(self) -> str:
        return self.sentence


def data_problems(recording: Recording) -> tuple[DataProblem, ...]:
    """Return what speaks against a recording's units, axes and channels.

    Parameters
    ----------
    recording : Recording
        As it was read.

    Returns
    -------
    tuple of DataProblem
        In the order of `RULES`; empty if nothing speaks against it. That proves nothing: the
        module says which slips cannot be seen.

    Examples
    --------
    A unit that lies still, whose specific force in g was taken for m/s^2:

    >>> still = Recording(np.zeros((200, 3)), np.tile([0.0, 0.0, 1.0], (200, 1)), 0.01, "rates")
    >>> for problem in data_problems(still):
    ...     print(problem.rule, "-", problem)  # doctest: +NORMALIZE_WHITESPACE
    force - accelerometer: expected a median size near gravity, 9.81 m/s^2, got 1,
    a factor of 0.102: g taken for m/s^2?
    """
    checked_instance(recording, Recording, "recording")
    found = [*_size_doubts(recording), *_turning_doubts(recording), *_channel_doubts(recording)]
    order = list(RULES)
    return tuple(sorted(found, key=lambda doubt: order.index(doubt.rule)))


def _without_problems(recording: Recording, allow: Sequence[str] = ()) -> Recording:
    """Return a recording if nothing speaks against it but the rules in `allow`; refuse others."""
    allow = some_of(allow, RULES, "allow")
    found = [doubt for doubt in data_problems(recording) if doubt.rule not in allow]
    if found:
        rules = ", ".join(f'"{rule}"' for rule in dict.fromkeys(doubt.rule for doubt in found))
        listed = rules if "," in rules else f"{rules},"
        raise ValueError(
            f"{recording.name or 'recording'}: {' '.join(map(str, found))} "
            f"Right all the same? Then say allow=({listed})."
        )
    return recording


def _size_doubts(recording: Recording) -> Iterator[DataProblem]:
    """Doubts about the size of the numbers alone."""
    rates = recording.kind == "rates"
    step = recording.interval
    if recording.accelerometer is not None:
        gravity = STANDARD_GRAVITY if recording.gravity is None else recording.gravity
        expected = gravity * (1 if rates else step)
        size = _median_size(recording.accelerometer)
        if not 1 / _FORCE_FACTOR < size / expected < _FORCE_FACTOR:
            unit = "m/s^2" if rates else "m/s, gravity times the interval"
            yield DataProblem(
                "force",
                f"accelerometer: expected a median size near {'gravity, ' * rates}"
                f"{expected:.3g} {unit}, got {size:.3g}, a factor of {size / expected:.3g}"
                f"{force_slips(size / expected, recording)}",
                size / expected,
                _FORCE_FACTOR,
            )
    largest = max(float(recording.gyro.max()), -float(recording.gyro.min()))
    rate, angle = (largest, largest * step) if rates else (largest / step, largest)
    if rate > _MOST_RATE:
        yield DataProblem(
            "rate",
            f"gyro: expected rates up to {_MOST_RATE:.3g} rad/s, the range of most gyros, got "
            f"{rate:.3g}: degrees taken for radians{'' if rates else ', or rates for angles'}?",
            rate,
            _MOST_RATE,
        )
    if angle > np.pi:
        yield DataProblem(
            "half turn",
            f"gyro: expected less than half a turn over one interval of {step:.3g} s, got "
            f"{angle:.3g} rad: is it the interval, or the unit?",
            angle,
            np.pi,
        )
    if recording.times is not None and len(recording) > 2:
        steps = np.diff(recording.times)
        usual = float(np.median(steps))
        row, longest = int(np.argmax(steps)), round(float(steps.max()) / usual, 9)
        if longest > _LONGEST_GAP:
            yield DataProblem(
                "gap",
                f"times: expected steps of about {usual:.4g} s, got one of "
                f"{steps[row]:.4g} s after row {row + 1}, at "
                f"{recording.times[row] - recording.times[0]:.6g} s: samples are missing.",
                longest,
                _LONGEST_GAP,
            )


def _median_size(vectors: FloatArray) -> float:
    x, y, z = vectors.T
    return float(np.median(np.sqrt(x * x + y * y + z * z)))


def _turning_doubts(recording: Recording) -> Iterator[DataProblem]:
    """Doubts that come from gravity's turns in the body."""
    found = _gravity_turns(recording)
    if found is None or found.explained < max(found.needed, _MAJORITY):
        return
    evidence = f"over {found.turns} turns of gravity in the body, {found.explained:.0%} explained"
    too_large = 1 / found.factor
    if not 1 / _TURNING_FACTOR < too_large < _TURNING_FACTOR:
        yield DataProblem(
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
        yield DataProblem(
            "axes",
            f"gyro: expected gravity to turn about the axes that the gyros say, got it turning "
            f"{slip} ({evidence}).",
            found.explained,
            found.needed,
        )


def _channel_doubts(recording: Recording) -> Iterator[DataProblem]:
    """Doubts about channels, whatever their units."""
    triads = [recording.gyro]
    if recording.accelerometer is not None:
        triads.append(recording.accelerometer)
    dead = _dead_channels(*triads)
    columns = (column for triad in triads for column in triad.T)
    for name, column, lifeless in zip(_CHANNELS, columns, dead, strict=False):
        if lifeless:
            yield DataProblem(
                "dead",
                f"{name}: expected values that change as in other channels, got {column[0]:.6g} "
                f"in all {len(column)} rows.",
                0.0,
                0.0,
            )
        channel = np.ascontiguousarray(column)
        if np.ptp(channel) == 0:
            continue
        rows, ratio = _clipped_rows(channel)
        if ratio > _CLIPPED_RATIO:
            yield DataProblem(
                "clipped",
                f"{name}: expected few values at the extreme, got {rows} rows there, {ratio:.3g} "
                "for each at the level beside it: the end of the range?",
                ratio,
                _CLIPPED_RATIO,
            )
            continue  # a channel at its end keeps one value for long
        begin, rows, allowed = _longest_run(channel)
        if rows > allowed:
            yield DataProblem(
                "stuck",
                f"{name}: expected no value more than {allowed:.0f} times in a row, got "
                f"{channel[begin]:.6g} in {rows} rows from row {begin + 1} on.",
                float(rows),
                allowed,
            )
    for one, other in _twin_channels(*triads):
        yield DataProblem(
            "twins",
            f"{_CHANNELS[one]} and {_CHANNELS[other]}: expected different channels, got the same: "
            "one column read twice?",
            1.0,
            1 - 1e-9,
        )


def _dead_channels(*triads: FloatArray) -> list[bool]:
    """Say which columns never change while another one does."""
    constant = np.array([np.ptp(column) == 0 for triad in triads for column in triad.T])
    return [bool(one and len(triads[0]) >= _ENOUGH_ROWS) for one in constant & ~constant.all()]


def _longest_run(channel: FloatArray) -> tuple[int, int, float]:
    """Return begin and rows of the longest run of equal values, and what is allowed.

    Allowed are twice the rows that are passed once in a million records, if the runs above the
    shortest of the longest tenth fall off as the middle one of them tells. Coarse steps and samples
    that are written twice thus make long runs usual; twice, as a unit at rest has longer ones.
    """
    begins = np.flatnonzero(np.concatenate([[True], channel[1:] != channel[:-1]]))
    rows = np.diff(begins, append=len(channel))
    longest = int(np.argmax(rows))
    tail = np.sort(rows)[-max(len(rows) // 10, min(len(rows), 10)) :]
    # A geometric tail: the middle excess, with half a row for the rounding, over ln 2 is the mean.
    excess = (np.median(tail - tail[0]) + 0.5) / np.log(2)
    allowed = 2 * (tail[0] + excess * np.log(len(tail) / _CHANCE_OF_RUN))
    return int(begins[longest]), int(rows[longest]), float(allowed)


def _clipped_rows(channel: FloatArray) -> tuple[int, float]:
    """Return how many rows stand at an extreme value as if the channel were cut off there.

    They count if three of them follow each other; with them comes their ratio to those at the
    level next to the extreme (and one more, lest it be none).
    """
    found = (0, 0.0)
    for extreme, beyond in ((channel.max(), np.max), (channel.min(), np.min)):
        there = np.flatnonzero(channel == extreme)
        # What stands there most of the time rests; few pulses of a quiet gyro go one way only.
        if len(there) < len(channel) / 2 and (there[2:] - there[:-2] == 2).any():
            below = channel[channel != extreme]
            beside = np.count_nonzero(below == beyond(below))
            found = max(found, (len(there), len(there) / (beside + 1)), key=lambda one: one[1])
    return found


def _twin_channels(*triads: FloatArray) -> list[tuple[int, int]]:
    """Return pairs of columns that are the same, but for unit, sign and zero."""
    rows = len(triads[0])
    if rows < _ENOUGH_ROWS:
        return []
    columns = [column for triad in triads for column in triad.T]
    middle = np.array([column.mean() for column in columns])
    products = np.zeros((len(columns), len(columns)))
    for begin in range(0, rows, _BLOCK):  # a long log has no room for a copy of it
        block = np.concatenate([triad[begin : begin + _BLOCK] for triad in triads], axis=1)
        block -= middle
        products += block.T @ block
    alive = np.flatnonzero([np.ptp(column) > 0 for column in columns])
    products = products[np.ix_(alive, alive)]
    standard_deviations = np.sqrt(np.diag(products))
    alike = np.abs(products / np.outer(standard_deviations, standard_deviations)) > 1 - 1e-9
    return [(int(alive[i]), int(alive[j])) for i, j in np.argwhere(np.triu(alike, 1))]


class _GravityTurns(NamedTuple):
    """What gravity's turns in the body say about the gyros."""

    factor: float  # that the gyros should be multiplied with; 1 within some ten percent
    order: FloatArray  # and which signed permutation (3, 3) of their columns is right
    explained: float  # share of gravity's turns, squared, that they account for then
    needed: float  # share that unrelated gyros reach once in a thousand records
    turns: int  # of gravity between two still moments


def _gravity_turns(recording: Recording) -> _GravityTurns | None:
    """Compare the turns of gravity in the body with those that the gyros tell.

    Whatever was done with a unit, its accelerometers see gravity f whenever it is held fairly
    still, and between two such moments f changes by the integral of f × ω. All 48 orders and signs
    of the columns are tried, each with its best factor; the one that explains most is returned, or
    one that changes less and leaves not twice as much unexplained. How much 24 tries (signs of the
    factor apart) explain by chance of n components that are independent follows from the beta
    distribution of a squared correlation, bounded by (1 - explained)^((n - 1) / 2) a try; each turn
    of gravity has n = 2 components. None if there are no accelerometers, or too few turns.
    """
    if recording.accelerometer is None:
        return None
    force = recording.accelerometer
    rows = max(round(_WINDOW / recording.interval), 4)
    count = len(force) // rows
    if count < 4:
        return None
    forces = force[: count * rows].reshape(count, rows, 3)
    angles = recording.gyro[: count * rows].reshape(count, rows, 3)
    gravity = _median_size(force)
    mean = np.einsum("wri->wi", forces) / rows
    variance = np.einsum("wri,wri->w", forces, forces) / rows - np.vecdot(mean, mean)
    near = np.abs(np.linalg.norm(mean, axis=1) - gravity) < _NEAR * gravity
    still = np.flatnonzero(near & (variance < (_STEADY * gravity) ** 2))
    if len(still) < 4:
        return None
    # Where gravity stays for two windows the unit rests, and its gyros show their bias.
    pairs = still[:-1][np.diff(still) == 1]
    turning = np.linalg.norm(mean[pairs + 1] - mean[pairs], axis=1)
    resting = pairs[turning < _REST * gravity]
    bias = np.median(angles[resting].mean(axis=1), axis=0) if len(resting) else np.zeros(3)
    blocks = [np.array_split(each, 1 + len(force) // _BLOCK) for each in (forces, angles)]
    steps = [f.transpose(0, 2, 1) @ (a - bias) for f, a in zip(*blocks, strict=True)]
    # Sums of f θ^T up to the middle of each window: all f × (A θ) follow from them.
    products = np.cumsum(np.concatenate(steps), axis=0)
    products *= recording.interval if recording.kind == "rates" else 1.0
    products[1:] = (products[1:] + products[:-1]) / 2
    ends = still[_apart(mean[still] / gravity)]
    turns = len(ends) - 1
    if turns < _ENOUGH_TURNS:
        return None
    turned = np.diff(mean[ends], axis=0).ravel() / gravity
    products = np.diff(products[ends], axis=0) / gravity
    told = np.einsum("jki,pkl,sjl->psi", _CROSS, _ORDERS, products, optimize=True)
    told = told.reshape(len(_ORDERS), -1)
    common, size = told @ turned, np.sum(told**2, axis=1)
    share = np.divide(common**2, size, out=np.zeros(len(size)), where=(common > 0) & (size > 0))
    share /= np.sum(turned**2)
    if not share.any():
        return None
    # Turns about one axis say nothing of the others: of equals the one that changes least.
    best = int(np.argmax(1 - share <= 2 * max(1 - share.max(), _TIED)))
    needed = 1 - (_CHANCE_OF_TURNS / (len(_ORDERS) / 2)) ** (2 / (2 * turns - 1))
    return _GravityTurns(
        float(common[best] / size[best]),
        _ORDERS[best],
        float(share[best]),
        float(needed),
        turns,
    )


def _apart(directions: FloatArray) -> list[int]:
    """Indices of moments, each the first with gravity turned enough since the one before."""
    rows = directions.tolist()
    found, (x, y, z) = [0], rows[0]
    for index, (a, b, c) in enumerate(rows):
        if (a - x) ** 2 + (b - y) ** 2 + (c - z) ** 2 > _TURN**2:
            found.append(index)
            x, y, z = a, b, c
    return found
