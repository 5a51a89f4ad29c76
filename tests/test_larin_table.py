"""Larin's table: every printed digit, the losing candidates, and the lost minus sign."""

from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from itertools import cycle, product

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from driftlab.larin_table import (
    MISALIGNMENT,
    NAMES,
    PRINTED,
    SIGN_RESTORED,
    SUM_FACTORS,
    TRIADS,
    Reconstruction,
    candidates,
    is_consistent,
    larin_table,
    printed_interval,
    reconstruct,
    triad_misalignment,
    weighed_intervals,
)
from driftlab.step_formulas import STEP_FORMULAS
from driftlab.turn_calibration import YATES_AXES, TurnExperiment, weighing
from support import EPS


@pytest.fixture(scope="module")
def everyone():
    return candidates()


def inside(value, text):
    low, high = printed_interval(text)
    return low <= value <= high


def place(number):
    """One unit in the last place of a printed number."""
    return Decimal(1).scaleb(number.as_tuple().exponent)


def printed(value, like, rounding):
    """A number as it would be printed with as many decimals as `like`."""
    return str(Decimal(float(value)).quantize(Decimal(like), rounding))


def test_reconstruction_gives_all_seven_printed_digits():
    winner = reconstruct()
    for value, text in zip(winner.values, SIGN_RESTORED, strict=True):
        assert Decimal(printed(value, text, ROUND_DOWN)) == Decimal(text)
    assert winner.agrees == [True] * 7


@pytest.mark.parametrize(
    ("fractions", "agree"),
    [((0.9, 0.9), True), ((0.4, -0.4), True), ((0.9, -0.4), False)],
    ids=["all cut off", "all rounded", "some cut off and some rounded"],
)
def test_digits_are_all_cut_off_or_all_rounded(fractions, agree):
    """Values beyond the printed ones by a fraction of the last place, in turn."""
    values = [
        float(number + Decimal(fraction).copy_sign(number * Decimal(fraction)) * place(number))
        for number, fraction in zip(map(Decimal, SIGN_RESTORED), cycle(fractions), strict=False)
    ]
    assert all(Reconstruction("", "", "", np.array(values)).agrees) == agree


def test_reconstruction_in_thirty_digits():
    """Independent of the package: a hundred equal steps about one axis are one rotation."""
    with mpmath.workdps(30):
        lean = mpmath.mpf("2e-3")
        triad = mpmath.matrix([[1, 0, 0], [0, 1, 0], [lean, -lean, mpmath.sqrt(1 - 2 * lean**2)]])
        starred = []
        for n in ([1, 1, 0], [1, 0, 1], [0, 1, 1], [1, 1, 1]):
            n = mpmath.matrix(n)
            measured = triad * n / mpmath.norm(n)
            p = 2 * mpmath.pi / 100 * mpmath.norm(measured)
            half_angle = 100 * mpmath.atan(p / 2 / (1 - p**2 / 12))
            # All four with a division by sqrt(2), the fourth as well: the third assumption.
            along = mpmath.fdot(measured, n) / mpmath.sqrt(2) / mpmath.norm(measured)
            starred.append(mpmath.atan(along * mpmath.tan(half_angle)) / mpmath.pi)
        expected = np.array([float(x) for x in starred])
    # A hundred products of a few roundings each.
    np.testing.assert_allclose(reconstruct().values[:4], expected, rtol=0, atol=400 * EPS)
    np.testing.assert_allclose(reconstruct().values[4:], weighing(expected), rtol=0, atol=800 * EPS)


def test_candidates_are_all_combinations_best_first(everyone):
    names = {(each.triad, each.step_formula, each.sum_factor) for each in everyone}
    assert names == set(product(TRIADS, STEP_FORMULAS, SUM_FACTORS))
    assert len(everyone) == len(names)
    scores = [sum(each.agrees) for each in everyone]
    assert scores == sorted(scores, reverse=True)


def test_one_candidate_wins_and_all_others_lose(everyone):
    winner, *losers = everyone
    assert (winner.triad, winner.step_formula, winner.sum_factor) == (
        "unit third axis",
        "pade",
        "sqrt(3/2)",
    )
    assert all(winner.agrees)
    assert not any(all(each.agrees) for each in losers)


@pytest.mark.parametrize(
    ("assumptions", "index", "value", "tolerance"),
    [
        ({"triad": "linear"}, 1, 1.0005e-3, 1e-7),
        ({"step_formula": "taylor-3"}, 0, 3.2e-8, 1e-9),
        ({"step_formula": "taylor-4"}, 0, -0.8e-8, 1e-9),
        ({"step_formula": "cayley"}, 0, -8e-5, 5e-6),
    ],
)
def test_how_the_losers_lose(assumptions, index, value, tolerance):
    """The values that the notes on the sources give for them."""
    loser = reconstruct(**assumptions)
    assert loser.values[index] == pytest.approx(value, abs=tolerance)
    assert not loser.agrees[index]


@pytest.mark.parametrize("sum_factor", SUM_FACTORS)
def test_fourth_number_scales_with_its_factor(sum_factor):
    """Small enough for the tangent to be its argument; the factor is the one its name begins with.

    About (1, 1, 1) the estimate is 1e-6, so that the cube that the tangent adds is below 1e-16.
    """
    factor = {"1": 1, "3/2": 3 / 2, "sqrt(3/2)": np.sqrt(3 / 2)}[sum_factor.split()[0]]
    plain = TurnExperiment(step_formula="pade").estimate(
        triad_misalignment("unit third axis"), YATES_AXES[3]
    )
    assert abs(plain) < 2e-6
    starred = reconstruct(sum_factor=sum_factor).values[3]
    np.testing.assert_allclose(starred, factor * plain, rtol=0, atol=4 * EPS)


def test_first_number_is_the_integration_error_alone():
    """About n1 the unit triad measures the rate exactly: what is left is -p^5/720 a step."""
    p = 2 * np.pi / 100
    # Half the angle of 100 steps, over pi; the next term is smaller by a multiple of p^2 below 1.
    expected = 100 * -(p**5) / 720 / (2 * np.pi)
    np.testing.assert_allclose(reconstruct().values[0], expected, rtol=p**2)


def test_readings_of_the_triad():
    linear, unit, symmetric = (triad_misalignment(triad) for triad in TRIADS)
    np.testing.assert_array_equal(linear, MISALIGNMENT)
    np.testing.assert_array_equal(linear, [[0, 0, 0], [0, 0, 0], [2e-3, -2e-3, 0]])
    assert np.linalg.norm(np.eye(3)[2] + unit[2]) == pytest.approx(1, abs=EPS)
    np.testing.assert_array_equal(unit[:, :2], linear[:, :2])
    np.testing.assert_array_equal(symmetric, symmetric.T)
    np.testing.assert_array_equal(np.diag(symmetric), 0)
    np.testing.assert_array_equal(symmetric[2, :2], linear[2, :2] / 2)


def test_the_table_itself():
    table = larin_table()
    assert list(table) == ["printed", "exact", "reconstructed"]
    assert len(NAMES) == len(PRINTED) == 7
    np.testing.assert_array_equal(table["printed"], [float(text) for text in PRINTED])
    np.testing.assert_array_equal(table["reconstructed"], reconstruct().values)
    # The digest's closed form, all of whose digits are given.
    digest = [0, 1.000499e-3, -0.999499e-3, 0, -5.0e-7, 0.999999e-3, -0.999999e-3]
    np.testing.assert_allclose(table["exact"], digest, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "assumptions", [{"triad": "bent"}, {"step_formula": "euler"}, {"sum_factor": "2"}]
)
def test_unknown_assumptions_are_refused(assumptions):
    with pytest.raises(ValueError, match=r"expected one of .*, got '(bent|euler|2)'"):
        reconstruct(**assumptions)


# Printed digits


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
        low = -high
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


def test_the_reconstruction_is_a_witness():
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
