"""Which slip a wrong answer shows: the exercise's own, or one that anyone makes anywhere."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.constants import arcminute, arcsecond, degree, hour, micro, minute

from .reading import Numbers

UNITS: dict[str, dict[str, float]] = {
    "angle": {
        "radians": 1.0,
        "degrees": degree,
        "arc minutes": arcminute,
        "arc seconds": arcsecond,
    },
    "rate": {
        "rad/s": 1.0,
        "degrees per second": degree,
        "degrees per hour": degree / hour,
        "radians per hour": 1 / hour,
    },
    "time": {"s": 1.0, "min": minute, "h": hour},
    "frequency": {"Hz": 2 * np.pi, "radians per second": 1.0},
    "pure": {"1": 1.0, "%": 0.01, "ppm": micro},
}
"""Units that an exercise may ask for, by what they measure, in those of the SI."""


def matches(
    given: Numbers,
    right: Numbers,
    tolerance: float | NDArray[np.float64],
    *,
    quaternion: bool = False,
    any_order: bool = False,
) -> NDArray[np.bool_]:
    """Return which parts of `given` are right within `tolerance`; the shapes are the same.

    In any order, a part is right if it is one of those that are asked, each counted once.
    """
    if any_order:
        free = list(range(right.size))
        found = []
        for part in given:
            fitting = [i for i in free if abs(part - right[i]) <= tolerance]
            found.append(bool(fitting))
            free = [i for i in free if i not in fitting[:1]]
        return np.array(found)
    near = np.abs(given - right) <= tolerance
    opposite = np.abs(given + right) <= tolerance
    return opposite if quaternion and opposite.sum() > near.sum() else near


def find_slip(
    given: Numbers,
    right: Numbers,
    mistakes: Sequence[tuple[str, Numbers]],
    *,
    tolerance: float | NDArray[np.float64],
    unit: str = "1",
    quaternion: bool = False,
    any_order: bool = False,
) -> str | None:
    """Return None if `given` is right within `tolerance`, else the mistake that explains it.

    The exercise's own `mistakes` come first, then the slips that anyone makes anywhere. If none of
    them fits, the sentence is empty, or says that it was close.
    """
    same = {"quaternion": quaternion, "any_order": any_order}

    def agree(value: Numbers, tolerance: float | NDArray[np.float64]) -> bool:
        return value.shape == given.shape and bool(matches(given, value, tolerance, **same).all())

    if agree(right, tolerance):
        return None

    def candidates() -> Iterator[tuple[str, Numbers]]:
        yield from mistakes
        yield from slips(right, unit=unit, quaternion=quaternion)
        yield from _two_slips(mistakes, unit)

    for says, value in candidates():
        if agree(value, tolerance * exactness(right, value)):
            return says
    # Close is a fiftieth off, but never finer than twice a generous tolerance, and of a fine one
    # no more than ten times, or four digits.
    most = np.maximum(10 * tolerance, 1e-4 * np.abs(right).max())
    if not any_order and agree(right, np.clip(0.02 * np.abs(right), 2 * tolerance, most)):
        return "Close: more digits are needed, a finer look, or a small term that was left out."
    return ""


def exactness(right: NDArray[Any], value: NDArray[Any]) -> float:
    """Return by how much the tolerance of a mistake is larger than that of the right answer.

    A mistake is as exact as the answer would be, each by its own size; zero is rather exact.
    """
    size, other = float(np.abs(right).max()), float(np.abs(value).max())
    return max(other / size, 1e-6) if size > 0 else 1.0


def slips(
    right: NDArray[Any], *, unit: str = "1", quaternion: bool = False
) -> Iterator[tuple[str, NDArray[Any]]]:
    """Give what to say of each common slip, and the answer that it makes of the `right` one."""
    yield from _units(right, unit)
    if quaternion:
        yield (
            "The scalar stands first; in this book it is the last of the four.",
            np.roll(right, 1, axis=-1),
        )
        conjugate = right * [-1, -1, -1, 1]
        opposite = "This is the opposite rotation: look at the order of the two factors."
        yield opposite, conjugate
        yield (
            "This is the opposite rotation, with the scalar first; in this book it is last.",
            np.roll(conjugate, 1, axis=-1),
        )
    yield (
        "The sign is reversed: look at the order of a product, or at what is taken from what.",
        (-right),
    )
    if unit in UNITS["angle"]:
        yield from _other_angles(right, UNITS["angle"][unit])
    if unit == "1" and np.all(right != 0):
        yield "This is the reciprocal: look at what is divided by what.", 1 / right
    if unit == "1" and right.ndim == 0 and 0 < right < 1:
        yield "This is the rest, the share of those that are not meant.", 1 - right
    if right.ndim == 2:
        yield "The rows are exchanged.", right[::-1]
        if right.shape[0] == right.shape[1]:
            yield "This is the transpose.", right.T


def _two_slips(mistakes: Sequence[tuple[str, Numbers]], unit: str) -> Iterator[tuple[str, Numbers]]:
    """A mistake of the exercise's own that is besides in another unit, or in another order."""
    for says, value in mistakes:
        for also, other in _units(value, unit):
            yield f"{also} And in the right unit: {says}", other
        if value.ndim == 1:
            yield (
                f"The order is not the one that is asked. And in the right order: {says}",
                value[::-1],
            )


def _other_angles(right: NDArray[Any], unit: float) -> Iterator[tuple[str, NDArray[Any]]]:
    # Of one number among zeros the half may be another of the numbers that one looks for.
    if right.ndim == 0 or np.count_nonzero(right) > 1:
        halved = "A factor of two too much or too little: look for an angle and its half."
        yield halved, 2 * right
        yield halved, right / 2
    for turn in np.array([np.pi / 2, np.pi, 2 * np.pi]) / unit:
        yield (
            "You have the other part of a right angle, of a half turn or of a whole one. From "
            "where is the angle counted?",
            turn - right,
        )
    whole = 2 * np.pi / unit
    for turns in (1, -1):
        same = "A whole turn more or less makes no difference to an attitude."
        yield same, right + turns * whole


def _units(right: NDArray[Any], unit: str) -> Iterator[tuple[str, NDArray[Any]]]:
    kind = next(kind for kind in UNITS.values() if unit in kind)
    for other, size in kind.items():
        if other != unit:
            wanted, got = map(_in_unit, (unit, other))
            says = f"The answer is asked {wanted}; this is {got}."
            yield says, right * kind[unit] / size


def _in_unit(unit: str) -> str:
    return "as a pure number" if unit == "1" else f"in {unit}"
