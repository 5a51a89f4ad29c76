"""Which slip makes a record of a turntable contradict what was told? Each is undone and tried.

A slip is named if the record fits without it. Every unit, order and sign is tried by gravity and
the Earth's rate, which is cheap; those few that fit then go through the filter, and the judge
decides by its innovations and by what it finds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from driftlab.checks import FloatArray
from driftlab.core import quaternion
from driftlab.earth import gravity
from driftlab.increments import Increments
from driftlab.recordings.guards import doubts, force_factors, gyro_factors
from driftlab.recordings.recording import Recording

from ._contradictions import BEYOND, Evidence, Expected, evidence, thinned
from ._judge import Judge, Told
from ._other_starts import headed, levelled, other_starts

FITS = 6.0
"""Misfit that may still be a right record's."""
_NEAR = 1.5
"""Slips that leave not so many times the misfit of the best may be it as well."""
_RIGHT = 1.0
"""Misfit of a right record, or less: of slips that leave no more, the innovations have to tell."""
_TRIED = 8
"""Slips that go through the filter,"""
_TRIED_WITH_MORE = 3
"""and through a filter with more states."""
_MORE = "lever arms", "time skew"
"""States of errors that turns show, and that a model may lack."""
_LACKING = "errors that the model does not have, such as lever arms or a time skew"
_SIZE = 0.1
"""Specific force of this much more or less than gravity may still have the right unit."""
_GRAVITY_A_METRE = 3.1e-7
"""Share of gravity that a metre of height takes away."""
_NEAREST_TO_POLE = float(np.radians(89.9))
_RULES = ("force", "rate", "half turn", "turning", "axes")
_LIKELY = 1
_FITTED = 3
"""Rank of slips that often happen, and of those whose size is fitted to the record."""


class Slip(NamedTuple):
    """A slip, what would have been told without it, and how badly that fits."""

    rank: int
    """Of slips that fit as well, those of lower rank are likelier."""
    name: str
    told: Told
    misfit: float


def likely_slips(told: Told, expected: Expected, judge: Judge) -> list[str]:
    """Slips without which the record fits, best first, or else what `doubts` has to say."""
    units = list(_other_units(told, expected))
    names = _named(units, judge)
    if names:
        return names
    tried = [*units, *_others(told, expected, judge)]
    names = _named(tried, judge)
    with_more = replace(judge, model=judge.model.with_states(*_MORE))
    if not names and with_more.model is not judge.model:
        lacking = f"{_LACKING}: model.with_states{_MORE} has states for them"
        if with_more.steps is None:
            return [lacking]
        names = [f"{name}, and {lacking}" for name in _named(tried, with_more, _TRIED_WITH_MORE)]
        if not names and judge.accepts(told, with_more.model) is not None:
            names = [lacking]
    if names:
        return names
    interval, angle, velocity = told.increments
    log = Recording(angle, velocity, interval, "increments")
    return [doubt.sentence.rstrip(".?") for doubt in doubts(log) if doubt.rule in _RULES]


def _named(slips: list[Slip], judge: Judge, most: int = _TRIED) -> list[str]:
    """Names of those slips that the judge accepts, likely ones first."""
    fitting: list[Slip] = []
    for slip in sorted(slips, key=lambda slip: slip.misfit)[:most]:
        if slip.misfit > (max(_NEAR * fitting[0].misfit, _RIGHT) if fitting else FITS):
            break
        if slip.told.loose and any(other.told.loose for other in fitting):
            continue  # two guesses of one start
        start = judge.accepts(slip.told)
        if start is None:
            continue
        if slip.told.loose:
            turn = _turn(judge.told.start, start)
            if np.linalg.norm(turn) < BEYOND * judge.prior.attitude:
                continue
            slip = slip._replace(name=_turned(np.degrees(turn)))
        fitting.append(slip)
    fitting.sort(key=lambda slip: slip.rank)
    # What was fitted to the record is no news beside a likely slip.
    if fitting and fitting[0].rank <= _LIKELY:
        fitting = [slip for slip in fitting if slip.rank < _FITTED]
    return list(dict.fromkeys(slip.name for slip in fitting))


def _turn(told: FloatArray, found: FloatArray) -> FloatArray:
    """Rotation vector (3,) between two starts."""
    back = quaternion.multiply(told, quaternion.conjugate(found))
    return quaternion.to_rotation_vector(back)


def _turned(turn: FloatArray) -> str:
    """Words for a start that the filter moved by a rotation vector in degrees."""
    if np.linalg.norm(turn[:2]) < 0.1 * abs(turn[2]):
        return f"start: a heading wrong by {abs(turn[2]):.3g} degrees"
    return f"start: an attitude wrong by {np.linalg.norm(turn):.3g} degrees"


def _others(told: Told, expected: Expected, judge: Judge) -> Iterator[Slip]:
    """Slips of start, place and axes, and what would have been told without each."""
    shown = evidence(told.increments)
    if shown is None:
        return

    def tried(rank: int, name: str, other: Told) -> Slip:
        return Slip(rank, name, other, float(shown.misfit(other.start, other.latitude, expected)))

    for name, start in other_starts(told.start):
        yield tried(_LIKELY, name, told._replace(start=start))
    for level in (told.start, levelled(told.start, shown)):
        start = headed(level, shown, told.latitude, expected)
        yield tried(_FITTED, "start: wrong", told._replace(start=start, loose=True))
    for rank, name, latitude in _other_latitudes(told, shown, expected, judge):
        if abs(latitude) < _NEAREST_TO_POLE:
            yield tried(rank, name, told._replace(latitude=latitude))
    names, increments = _other_axes(told.increments)
    seen = evidence(increments)
    if seen is None:
        return
    sizes = seen.misfit(told.start, told.latitude, expected)
    for row, (name, size) in enumerate(zip(names, sizes, strict=True)):
        if size > FITS:
            continue
        matrices = _SETS[row]
        angle, velocity = (
            rows @ matrix.T for rows, matrix in zip(told.increments[1:], matrices, strict=True)
        )
        rows = Increments(told.increments.interval, angle, velocity)
        likely = "forward" in name or "alone" in name
        yield Slip(_LIKELY if likely else 2, name, told._replace(increments=rows), float(size))


def _other_units(told: Told, expected: Expected) -> Iterator[Slip]:
    """Other units, another interval, and the triads exchanged."""
    for name, increments in _rescaled(told, expected):
        if (seen := evidence(increments)) is not None:
            size = float(seen.misfit(told.start, told.latitude, expected))
            yield Slip(0, name, told._replace(increments=increments), size)


_NO_FORCE = 1e-12
"""As a part of gravity: no interval explains less."""


def _rescaled(told: Told, expected: Expected) -> Iterator[tuple[str, Increments]]:
    """What the increments may have been meant to be."""
    interval, angle, velocity = told.increments
    size = float(gravity(told.latitude))
    ratio = float(np.median(np.linalg.norm(velocity, axis=1))) / (interval * size)
    forces = {
        name: factor
        for name, factor in ({"": 1.0} | force_factors("increments", interval)).items()
        if abs(ratio / factor - 1) < _SIZE and "interval" not in name
    }
    gyros = {"": 1.0} | gyro_factors("increments", interval)
    for (force, b), (gyro, a) in product(forces.items(), gyros.items()):
        pairs = (("gyros", gyro), ("accelerometers", force))
        words = [f"{triad}: {name}" for triad, name in pairs if name]
        if words and "interval" not in gyro and max(a, 1 / a, b, 1 / b) > 1 + _SIZE:
            yield " and ".join(words), Increments(interval, angle / a, velocity / b)
    # Biases push up in one position and down in another.
    if abs(ratio - 1) > max(BEYOND * expected.prior.scale, 1e-4) and ratio > _NO_FORCE:
        name = _interval_slip(interval, ratio)
        yield name, Increments(ratio * interval, angle, velocity)
    if ratio < _SIZE or ratio > 1 / _SIZE:
        yield "gyros and accelerometers exchanged", Increments(interval, velocity, angle)


def _interval_slip(interval: float, ratio: float) -> str:
    """Words for an interval that gravity contradicts."""
    for power, name in ((-3, "milliseconds"), (-6, "microseconds")):
        if abs(ratio / 10.0**power - 1) < _SIZE:
            return f"interval: {name} taken for seconds"
    words = f"interval: {ratio * interval:.4g} s instead of {interval:.4g} s, by gravity"
    height = (1 - ratio) / _GRAVITY_A_METRE
    if 0 < height < 9000:
        return f"{words}, or a place {height:.0f} m high"
    return f"{words}, or accelerometers with that error of scale"


def _named_orders() -> Iterator[tuple[str, FloatArray]]:
    """Signed permutations but the identity."""
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            matrix = np.eye(3)[list(order)] * np.array(signs)[:, np.newaxis]
            words = ", ".join(
                f"{'-' * (sign < 0)}{'xyz'[axis]}" for sign, axis in zip(signs, order, strict=True)
            )
            if words == "x, y, z":
                continue
            hint = "" if np.linalg.det(matrix) > 0 else " (left-handed)"
            if words == "x, -y, -z":
                hint = " (forward, right, down taken for forward, left, up)"
            yield f"{words} would be right{hint}", matrix


_ORDERS = list(_named_orders())
_SETS = [
    *((matrix, matrix) for _, matrix in _ORDERS),
    *((matrix, np.eye(3)) for _, matrix in _ORDERS),
    *((np.eye(3), matrix) for _, matrix in _ORDERS),
]
"""Matrices for gyros and accelerometers: of both triads, or of one."""


def _other_axes(increments: Increments) -> tuple[list[str], Increments]:
    """Orders and signs of the columns: names, and increments (m, n, 3)."""
    interval, angle, velocity = thinned(increments)
    kinds = "the log", "the gyros alone", "the accelerometers alone"
    names = [f"axes of {kind}: {name}" for kind in kinds for name, _ in _ORDERS]
    gyros, accelerometers = (np.array(each).mT for each in zip(*_SETS, strict=True))
    return names, Increments(interval, angle @ gyros, velocity @ accelerometers)


def _other_latitudes(
    told: Told, shown: Evidence, expected: Expected, judge: Judge
) -> Iterator[tuple[int, str, float]]:
    """Other latitudes, rad, with rank and name."""

    def size(latitude: float) -> float:
        return float(shown.misfit(told.start, latitude, expected))

    degree = np.radians(1.0)
    near = min(np.arange(-88, 89) * degree, key=size)
    nearest = float(minimize_scalar(size, bounds=(near - degree, near + degree)).x)
    yield _LIKELY, "latitude: the other sign", -told.latitude
    yield _LIKELY, "latitude: degrees turned into radians twice", float(np.degrees(told.latitude))
    yield _LIKELY, "latitude: degrees taken for radians", float(np.radians(told.latitude))
    if size(nearest) < FITS:
        latitude, deviation = judge.latitude(told._replace(latitude=nearest))
        if abs(latitude - told.latitude) > BEYOND * deviation:
            yield _FITTED, f"latitude: {np.degrees(latitude):.2f} degrees fits better", latitude
