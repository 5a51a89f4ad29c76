"""What digits alone can tell: the values they may stand for, and whether they fit together.

Applied to the seven numbers of Larin's experiment, whose last three are weighings of the first
four.
"""

from __future__ import annotations

import re
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from functools import cache
from itertools import chain

import numpy as np
from scipy.optimize import linprog

from driftlab.checks import FloatArray
from driftlab.drift.weighing_designs import weighing_estimate

CHARACTERS = "0123456789.-"
"""What a misread character may be."""

NUMBER = re.compile(r"-?\d+(\.\d+)?e-?\d+")


def digit_interval(text: str, rule: str | None = None) -> tuple[float, float]:
    """Lowest and highest value that given digits may stand for.

    The rule is `decimal.ROUND_HALF_EVEN` for rounded digits and `decimal.ROUND_DOWN` for digits
    that were cut off; without one both are allowed.
    """
    number = Decimal(text)
    unit = Decimal(1).scaleb(number.as_tuple().exponent)  # type: ignore[arg-type]
    ends = [number]
    if rule != ROUND_DOWN:
        ends += [number - unit / 2, number + unit / 2]
    if rule != ROUND_HALF_EVEN:
        ends.append(number + unit.copy_sign(number))
    return float(min(ends)), float(max(ends))


def weighed_intervals(starred: tuple[str, ...]) -> FloatArray:
    """Bounds (3, 2) of sigma1**, sigma2**, sigma3** that the digits of four starred numbers allow.

    Interval arithmetic; each weighing is half of a sum of four numbers with signs, so its
    half-width is half of the sum of theirs.
    """
    low, high = np.array([digit_interval(text) for text in starred]).T
    half_width = 0.5 * np.sum(0.5 * (high - low))
    middle = weighing_estimate(0.5 * (low + high))
    return np.stack([middle - half_width, middle + half_width], axis=-1)


def is_consistent(seven: tuple[str, ...], rule: str | None = None) -> bool:
    """Can seven numbers with these digits stand together? The rule is that of `digit_interval`.

    Linear programming: is there a point in the box of the four starred intervals whose weighings
    lie in the three doubly starred ones?
    """
    bounds = [digit_interval(text, rule) for text in seven]
    weights = weighing_estimate(np.eye(4)).T
    low, high = np.array(bounds[4:]).T
    # Scaled to units of 1e-9, or the solver's own tolerance would swallow the intervals.
    found = linprog(
        np.zeros(4),
        A_ub=np.vstack([weights, -weights]),
        b_ub=1e9 * np.concatenate([high, -low]),
        bounds=1e9 * np.array(bounds[:4]),
    )
    return bool(found.success)


@cache
def single_slips(seven: tuple[str, ...], rule: str | None = None) -> tuple[tuple[int, str], ...]:
    """Every way to make seven numbers consistent by one slip in one of them.

    A slip is one character replaced, left out or put in, or two neighbours exchanged, anywhere
    in mantissa or exponent. Returned are the place of the changed number and its new text. The
    rule is that of `digit_interval`.
    """
    # A rule narrows the intervals: what it lets pass, both rules together let pass too.
    every = [(place, text) for place, given in enumerate(seven) for text in one_slip_away(given)]
    slips = every if rule is None else single_slips(seven)
    return tuple(
        (place, text)
        for place, text in slips
        if is_consistent((*seven[:place], text, *seven[place + 1 :]), rule)
    )


def one_slip_away(text: str) -> list[str]:
    """All numbers that one slip makes of a number, in alphabetical order."""
    cuts = [(text[:i], text[i:]) for i in range(len(text) + 1)]
    left_out = (a + b[1:] for a, b in cuts)
    exchanged = (a + b[1] + b[0] + b[2:] for a, b in cuts if len(b) > 1)
    replaced = (a + character + b[1:] for a, b in cuts for character in CHARACTERS)
    put_in = (a + character + b for a, b in cuts for character in CHARACTERS)
    changed = set(chain(left_out, exchanged, replaced, put_in)) - {text}
    return sorted(each for each in changed if NUMBER.fullmatch(each))
