"""How far off a wrong answer is, in words that do not give the right one away."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .reading import Numbers

ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth")
NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine")

ROUNDING = 1e-12
"""What is smaller than this part of the right answer, rounding has left over of a zero."""


def how_far_off(
    given: Numbers, right: Numbers, parts: NDArray[np.bool_], *, any_order: bool = False
) -> str:
    """Say of a wrong answer which parts are right, and of the others whether they are too large.

    With `any_order`, nothing is said of the size of a single part.
    """
    if given.ndim == 0:
        return _sentence(size(given[()], right[()]))
    if not any_order:
        if _same(np.sort_complex(given.ravel()), np.sort_complex(right.ravel())):
            return "The numbers are right, their order is not."
        factor = common_factor(given, right)
        if factor:
            how = size(factor, 1.0)
            if given.size == 2:
                return f"Both are {how}: one common factor."
            return f"All are {how}: one common factor."
    right = np.where(np.abs(right) < 1e-9 * np.abs(right).max(), 0, right)  # all but rounding
    flat = parts.ravel()
    wrong = [i for i, good in enumerate(flat) if not good]
    first = wrong[0]
    remark = "" if any_order else size(given.flat[first], right.flat[first])
    if given.ndim > 1 or flat.size > len(ORDINALS):
        right_ones = int(flat.sum())
        are = "is" if right_ones == 1 else "are"
        return f"{_count(right_ones)} of the {flat.size} entries {are} right so far."
    good = [ORDINALS[i] for i, each in enumerate(flat) if each]
    bad = [ORDINALS[i] for i in wrong]
    which = f"; the {bad[0]} is {remark}" if remark else ""
    if not good and flat.size == 2:
        return f"Neither of the two is right yet{which}."
    if not good:
        return f"None of the {_number(flat.size)} is right yet{which}."
    said = f"The {_listed(good)} {'is' if len(good) == 1 else 'are'} right"
    if len(bad) == 1 and remark:
        return f"{said}. The {bad[0]} is {remark}."
    return f"{said}, the {_listed(bad)} not yet{which}."


def size(given: Any, right: Any) -> str:
    """Say how one number misses another: "too large", "too small, by about a power of ten"."""
    if np.iscomplex(given) and not np.iscomplex(right):
        return "not a real number"
    if np.iscomplex(given) or np.iscomplex(right):
        return "not the right complex number"
    given, right = float(np.real(given)), float(np.real(right))
    if right == 0 or given == 0:
        return "too large" if given > right else "too small"
    ratio = abs(given / right)
    if ratio < ROUNDING:
        return "practically zero, nothing but rounding"
    large = "too large" if ratio > 1 else "too small"
    decades = abs(np.log10(ratio))
    if decades > 0.8:
        count = round(float(decades))
        powers = "a power" if count == 1 else f"{_number(count)} powers"
        large = f"{large}, by about {powers} of ten"
    if given * right < 0:
        return "of the wrong sign" if 0.5 < ratio < 2 else f"of the wrong sign and {large}"
    return large if right > 0 else f"of the right sign, but its size is {large}"


def common_factor(given: Numbers, right: Numbers) -> float | None:
    """Return the one factor by which all parts are too large, if there is one."""
    there = np.abs(right) > 1e-9 * np.abs(right).max()
    if there.sum() < 2 or np.iscomplexobj(given) or np.iscomplexobj(right):
        return None
    factors = given[there] / right[there]
    factor = float(factors.flat[0])
    alike = abs(factor) > ROUNDING and np.allclose(factors, factor, rtol=1e-3, atol=0)
    return factor if alike and _same(given, factor * right) else None


def _same(a: Numbers, b: Numbers) -> bool:
    return bool(np.allclose(a, b, rtol=1e-3, atol=1e-6 * float(np.abs(b).max())))


def _sentence(words: str) -> str:
    return f"{words[0].upper()}{words[1:]}."


def _listed(words: list[str]) -> str:
    if len(words) == 1:
        return words[0]
    return f"{', '.join(words[:-1])} and {words[-1]}"


def _number(count: int) -> str:
    return NUMBERS[count - 1] if 1 <= count <= len(NUMBERS) else str(count)


def _count(count: int) -> str:
    return "None" if count == 0 else _number(count).capitalize()
