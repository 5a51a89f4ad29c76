"""Which slip a wrong answer shows: the exercise's own, or one that anyone makes anywhere."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
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


def find_slip(
    given: Numbers,
    right: Numbers,
    mistakes: Iterable[tuple[str, Numbers]],
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

    def agree(a: Numbers, b: Numbers, tolerance: float | NDArray[np.float64]) -> bool:
        if a.shape != b.shape:
            return False
        if any_order:
            a, b = np.sort_complex(a), np.sort_complex(b)
        near = (np.abs(a - b) <= tolerance).all()
        return bool(near or (quaternion and (np.abs(a + b) <= tolerance).all()))

    if agree(given, right, tolerance):
        return None

    def candidates() -> Iterator[tuple[str, Numbers]]:
        yield from mistakes
        yield from slips(right, unit=unit, quaternion=quaternion)

    for says, value in candidates():
        # A mistake is as exact as the answer would be, each by its own size; zero is rather exact.
        size, other = float(np.abs(right).max()), float(np.abs(value).max())
        scale = max(other / size, 1e-6) if size > 0 else 1.0
        if agree(given, value, tolerance * scale):
            return says
    # Close is a fiftieth off, but never finer than twice a generous tolerance, and of a fine one
    # no more than ten times, or four digits.
    most = np.maximum(10 * tolerance, 1e-4 * np.abs(right).max())
    if agree(given, right, np.clip(0.02 * np.abs(right), 2 * tolerance, most)):
        return "Close: more digits are needed, a finer look, or a small term that was left out."
    return ""


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
        yield "This is the opposite rotation: look at the order of the two factors.", conjugate
        yield (
            "This is the opposite rotation, with the scalar first; in this book it is last.",
            np.roll(conjugate, 1, axis=-1),
        )
    yield (
        "The sign is reversed: look at the order of a product, or at what is taken from what.",
        (-right),
    )
    # Of one number among zeros the half may be another of the numbers that one looks for.
    if right.ndim == 0 or np.count_nonzero(right) > 1:
        yield "This is twice as much: look for an angle and its half, or for a mean.", 2 * right
        yield "This is half as much: look for an angle and its half, or for a mean.", right / 2
    if right.ndim == 2 and right.shape[0] == right.shape[1]:
        yield "This is the transpose.", right.T


def _units(right: NDArray[Any], unit: str) -> Iterator[tuple[str, NDArray[Any]]]:
    kind = next(kind for kind in UNITS.values() if unit in kind)
    for other, size in kind.items():
        if other != unit:
            wanted, got = ("as a pure number" if u == "1" else f"in {u}" for u in (unit, other))
            yield f"The answer is asked {wanted}; this is {got}.", right * kind[unit] / size
