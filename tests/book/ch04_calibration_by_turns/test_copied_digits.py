"""What digits can tell: their intervals, and the slips that make Larin's seven numbers fit."""

import re
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from itertools import combinations, product

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, strategies as st

from driftlab.book.ch04_calibration_by_turns.copied_digits import (
    digit_interval,
    is_consistent,
    one_slip_away,
    single_slips,
    weighed_intervals,
)
from driftlab.book.ch04_calibration_by_turns.experiment_numbers import (
    IN_THE_COPY,
    NAMES,
    SIGN_RESTORED,
    agreement,
    candidates,
)
from driftlab.drift.weighing_designs import weighing_estimate
from support import EPS, written


@pytest.mark.parametrize(
    ("text", "low", "high"),
    [
        ("0.165e-5", 0.1645e-5, 0.166e-5),
        ("-0.216e-7", -0.217e-7, -0.2155e-7),
        ("-1.0e-3", -1.1e-3, -0.95e-3),
    ],
)
def test_interval_of_a_number(text, low, high):
    np.testing.assert_allclose(digit_interval(text), [low, high], rtol=2 * EPS)


@given(
    st.floats(-1e-3, 1e-3),
    st.sampled_from(IN_THE_COPY),
    st.sampled_from([ROUND_DOWN, ROUND_HALF_EVEN]),
)
def test_interval_holds_what_was_written_of_it(value, like, rounding):
    text = written(value, like, rounding)
    low, high = digit_interval(text)
    if Decimal(text) == 0:  # a zero has lost its sign with its digits
        low, high = min(low, -high), max(high, -low)
    assert low <= value <= high


@pytest.mark.parametrize("starred", [IN_THE_COPY[:4], SIGN_RESTORED[:4]])
def test_weighed_intervals_are_those_of_all_sixteen_corners(starred):
    corners = weighing_estimate(list(product(*map(digit_interval, starred))))
    expected = np.stack([corners.min(axis=0), corners.max(axis=0)], axis=-1)
    np.testing.assert_allclose(weighed_intervals(starred), expected, rtol=0, atol=4e-3 * EPS)


# The slip of one character


def test_the_seven_of_the_copy_cannot_stand_together():
    assert not is_consistent(IN_THE_COPY)


def test_the_seven_of_the_copy_contradict_each_other_in_interval_arithmetic():
    """s1** = (s1* - s2* - s3* + s4*)/2 is at least twice what the copy has."""
    s1, s2, s3, s4, weighed = (mpmath.iv.mpf(digit_interval(text)) for text in IN_THE_COPY[:5])
    allowed = (s1 - s2 - s3 + s4) / 2
    assert allowed.a > 2 * weighed.b


def test_with_the_sign_restored_they_stand_together():
    assert is_consistent(SIGN_RESTORED)
    changed = [i for i in range(7) if IN_THE_COPY[i] != SIGN_RESTORED[i]]
    assert changed == [NAMES.index("sigma4*")]


@given(
    st.lists(st.floats(1e-4, 2e-3), min_size=4, max_size=4),
    st.sampled_from([ROUND_DOWN, ROUND_HALF_EVEN]),
)
def test_any_honest_seven_are_consistent_and_wrong_ones_are_not(starred, rounding):
    seven = tuple(
        written(value, "0.001e-3", rounding) for value in (*starred, *weighing_estimate(starred))
    )
    assume(0 not in map(Decimal, seven))  # a zero has lost the sign that its interval needs
    assert is_consistent(seven)
    # Starred intervals are 1.5e-6 wide, so their weighings 3e-6: an error of 1e-5 shows.
    wrong = str(Decimal(seven[4]) + Decimal("1e-5"))
    assert not is_consistent((*seven[:4], wrong, *seven[5:]))


def test_two_slips_of_one_character_make_the_seven_consistent():
    """One digit less of sigma3*, or a minus sign before sigma4*."""
    assert sum(len(one_slip_away(text)) for text in IN_THE_COPY) == 1023
    assert IN_THE_COPY[2] == "-1.001e-3"
    assert list(single_slips(IN_THE_COPY)) == [
        (NAMES.index("sigma3*"), "-1.00e-3"),
        (NAMES.index("sigma4*"), "-0.165e-5"),
    ]


def test_one_exchange_of_two_whole_numbers_fits_but_only_by_two_rules():
    fits = {}
    for i, j in combinations(range(7), 2):
        texts = list(IN_THE_COPY)
        texts[i], texts[j] = texts[j], texts[i]
        if is_consistent(tuple(texts)):
            fits[NAMES[i], NAMES[j]] = tuple(texts)
    assert list(fits) == [("sigma4*", "sigma1**")]
    (exchanged,) = fits.values()
    assert not any(is_consistent(exchanged, rule) for rule in (ROUND_DOWN, ROUND_HALF_EVEN))
    assert max(sum(agreement(one.values, exchanged)) for one in candidates()) == 5
    # And if only the digits of sigma1* and sigma4* changed places, not the powers of ten?
    digits = "0.165e-7", *IN_THE_COPY[1:3], "-0.216e-5", *IN_THE_COPY[4:]
    assert is_consistent(digits, ROUND_DOWN)
    assert is_consistent(digits, ROUND_HALF_EVEN)
    assert max(sum(agreement(one.values, digits)) for one in candidates()) == 5


def test_if_digits_were_cut_off_the_minus_sign_is_the_only_slip():
    place = NAMES.index("sigma4*")
    assert single_slips(IN_THE_COPY, ROUND_DOWN) == ((place, "-0.165e-5"),)
    both = [NAMES.index("sigma3*"), place]
    assert [i for i, _ in single_slips(IN_THE_COPY, ROUND_HALF_EVEN)] == both


def test_slips_are_every_string_of_one_edit_that_is_a_number():
    """Against a search of all strings of the characters: one edit is a distance of one."""
    text = "1e-3"
    strings = ("".join(each) for n in (3, 4, 5) for each in product("0123456789.-e", repeat=n))
    numbers = (each for each in strings if re.fullmatch(r"-?\d+(\.\d+)?e-?\d+", each))
    expected = {each for each in numbers if one_edit(each, text)}
    assert set(one_slip_away(text)) == expected


def one_edit(a, b):
    """Is one string the other with a character replaced, left out or put in, or two exchanged?"""
    if len(a) < len(b):
        a, b = b, a
    if len(a) == len(b):
        different = [i for i in range(len(a)) if a[i] != b[i]]
        if len(different) != 2:
            return len(different) == 1
        i, j = different
        return j == i + 1 and (a[i], a[j]) == (b[j], b[i])
    return len(a) == len(b) + 1 and any(a[:i] + a[i + 1 :] == b for i in range(len(a)))
