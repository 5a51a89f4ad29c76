"""What printed digits can tell: the values they may stand for, and whether they fit together.

Applied to the seven numbers of Larin's table, whose last three are weighings of the first four.
"""

from __future__ import annotations

from decimal import Decimal
from itertools import chain

import numpy as np
from scipy.optimize import linprog

from driftlab.checks import FloatArray
from driftlab.drift.weighing_designs import weighing


def printed_interval(text: str) -> tuple[float, float]:
    """Lowest and highest value that a printed number may stand for, were it rounded or cut off."""
    number = Decimal(text)
    unit = Decimal(1).scaleb(number.as_tuple().exponent)  # type: ignore[arg-type]
    ends = [number - unit / 2, number + unit / 2, number + unit.copy_sign(number)]
    return float(min(ends)), float(max(ends))


def weighed_intervals(starred: tuple[str, ...]) -> FloatArray:
    """Bounds (3, 2) of sigma1**, sigma2**, sigma3** that four printed starred numbers allow.

    Interval arithmetic; each weighing is half of a sum of four numbers with signs, so its
    half-width is half of the sum of theirs.
    """
    low, high = np.array([printed_interval(text) for text in starred]).T
    half_width = 0.5 * np.sum(0.5 * (high - low))
    middle = weighing(0.5 * (low + high))
    return np.stack([middle - half_width, middle + half_width], axis=-1)


def is_consistent(seven: tuple[str, ...]) -> bool:
    """Can the seven printed numbers stand together, whether rounded or cut off?

    Linear programming: is there a point in the box of the four starred intervals whose weighings
    lie in the three doubly starred ones?
    """
    bounds = [printed_interval(text) for text in seven]
    weights = weighing(np.eye(4)).T
    low, high = np.array(bounds[4:]).T
    # Scaled to units of 1e-9, or the solver's own tolerance would swallow the intervals.
    found = linprog(
        np.zeros(4),
        A_ub=np.vstack([weights, -weights]),
        b_ub=1e9 * np.concatenate([high, -low]),
        bounds=1e9 * np.array(bounds[:4]),
    )
    return bool(found.success)


def single_misprints(seven: tuple[str, ...]) -> list[tuple[int, str]]:
    """Every way to make seven printed numbers consistent by changing one character of one of them.

    A digit of mantissa or exponent may become another one, and a leading minus sign may come or
    go. Returned are the place of the changed number and its new text.
    """
    return [
        (place, text)
        for place, printed in enumerate(seven)
        for text in _one_character_away(printed)
        if is_consistent((*seven[:place], text, *seven[place + 1 :]))
    ]


def _one_character_away(text: str) -> list[str]:
    other_sign = text.removeprefix("-") if text.startswith("-") else "-" + text
    digits = (
        text[:i] + digit + text[i + 1 :]
        for i, character in enumerate(text)
        if character.isdigit()
        for digit in "0123456789"
        if digit != character
    )
    return list(chain([other_sign], digits))
