"""What printed digits can tell: their intervals, and the minus sign that Larin's table has lost."""

from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from itertools import product

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, strategies as st

from driftlab.book.ch04_calibration_by_turns.printed_digits import (
    is_consistent,
    printed_interval,
    single_misprints,
    weighed_intervals,
)
from driftlab.book.ch04_calibration_by_turns.printed_table import (
    NAMES,
    PRINTED,
    SIGN_RESTORED,
    reconstruct,
)
from driftlab.drift.weighing_designs import weighing
from support import EPS, printed


def inside(value, text):
    low, high = printed_interval(text)
    return low <= value <= high


@pytest.mark.parametrize(
    ("text", "low", "high"),
    [
        ("0.165e-5", 0.1645e-5, 0.166e-5),
        ("-0.216e-7", -0.217e-7, -0.2155e-7),
        ("-1.0e-3", -1.1e-3, -0.95e-3),
    ],
)
def test_interval_of_a_printed_number(text, low, high):
    np.testing.assert_allclose(printed_interval(text), [low, high], rtol=2 * EPS)


@given(
    st.floats(-1e-3, 1e-3), st.sampled_from(PRINTED), st.sampled_from([ROUND_DOWN, ROUND_HALF_EVEN])
)
def test_interval_holds_what_was_printed_of_it(value, like, rounding):
    text = printed(value, like, rounding)
    low, high = printed_interval(text)
    if Decimal(text) == 0:  # a zero has lost its sign with its digits
        low, high = min(low, -high), max(high, -low)
    assert low <= value <= high


@pytest.mark.parametrize("starred", [PRINTED[:4], SIGN_RESTORED[:4]])
def test_weighed_intervals_are_those_of_all_sixteen_corners(starred):
    corners = weighing(list(product(*map(printed_interval, starred))))
    expected = np.stack([corners.min(axis=0), corners.max(axis=0)], axis=-1)
    np.testing.assert_allclose(weighed_intervals(starred), expected, rtol=0, atol=4e-3 * EPS)


# The lost minus sign


def test_printed_seven_cannot_stand_together():
    assert not is_consistent(PRINTED)


def test_printed_seven_contradict_each_other_in_interval_arithmetic():
    """s1** = (s1* - s2* - s3* + s4*)/2 is at least twice what is printed."""
    s1, s2, s3, s4, weighed = (mpmath.iv.mpf(printed_interval(text)) for text in PRINTED[:5])
    allowed = (s1 - s2 - s3 + s4) / 2
    assert allowed.a > 2 * weighed.b


def test_with_the_sign_restored_they_stand_together():
    assert is_consistent(SIGN_RESTORED)
    changed = [i for i in range(7) if PRINTED[i] != SIGN_RESTORED[i]]
    assert changed == [NAMES.index("sigma4*")]


def test_the_reconstruction_lies_in_the_printed_intervals():
    """Seven numbers that weigh exactly and lie in the seven printed intervals."""
    values = reconstruct().values
    np.testing.assert_array_equal(values[4:], weighing(values[:4]))
    assert all(inside(value, text) for value, text in zip(values, SIGN_RESTORED, strict=True))


@given(
    st.lists(st.floats(1e-4, 2e-3), min_size=4, max_size=4),
    st.sampled_from([ROUND_DOWN, ROUND_HALF_EVEN]),
)
def test_any_honest_print_is_consistent_and_a_wrong_one_is_not(starred, rounding):
    seven = tuple(printed(value, "0.001e-3", rounding) for value in (*starred, *weighing(starred)))
    assume(0 not in map(Decimal, seven))  # a zero has lost the sign that its interval needs
    assert is_consistent(seven)
    # Starred intervals are 1.5e-6 wide, so their weighings 3e-6: an error of 1e-5 shows.
    wrong = str(Decimal(seven[4]) + Decimal("1e-5"))
    assert not is_consistent((*seven[:4], wrong, *seven[5:]))


def test_the_lost_sign_is_the_only_single_misprint_that_mends_the_table():
    assert single_misprints(PRINTED) == [(NAMES.index("sigma4*"), "-0.165e-5")]


def test_a_digit_less_would_mend_the_table_as_well():
    """So the sign is the only misprint of its kind, not of any kind."""
    assert PRINTED[2] == "-1.001e-3"
    assert is_consistent((*PRINTED[:2], "-1.00e-3", *PRINTED[3:]))


def test_single_misprints_find_a_digit_that_was_changed():
    wrong = (*SIGN_RESTORED[:4], "0.981e-6", *SIGN_RESTORED[5:])
    found = single_misprints(wrong)
    assert (4, "0.681e-6") in found
    assert all(is_consistent((*wrong[:i], text, *wrong[i + 1 :])) for i, text in found)
