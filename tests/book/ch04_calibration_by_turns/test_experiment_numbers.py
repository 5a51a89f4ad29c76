"""Larin's seven numbers: every digit, the other winners, and the losing candidates."""

from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal
from itertools import cycle, product

import mpmath
import numpy as np
import pytest

from driftlab.book.ch04_calibration_by_turns.copied_digits import digit_interval
from driftlab.book.ch04_calibration_by_turns.experiment_numbers import (
    IN_THE_COPY,
    NAMES,
    SIGN_RESTORED,
    STEPS,
    SUM_FACTORS,
    TRIADS,
    TRUE_SIGMA,
    agreement,
    agreement_when,
    candidates,
    experiment_numbers,
    reconstruct,
    triad_reading,
)
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.drift.step_formulas import STEP_FORMULAS
from driftlab.drift.weighing_designs import weighing_estimate
from support import EPS, written


@pytest.fixture(scope="module")
def everyone():
    return candidates()


def place(number):
    """One unit in the last place of a number."""
    return Decimal(1).scaleb(number.as_tuple().exponent)


def test_reconstruction_gives_every_digit_of_the_seven():
    winner = reconstruct()
    for value, text in zip(winner.values, SIGN_RESTORED, strict=True):
        assert Decimal(written(value, text, ROUND_DOWN)) == Decimal(text)
    assert winner.agrees == [True] * 7


@pytest.mark.parametrize(
    ("fractions", "agree"),
    [((0.9, 0.9), True), ((0.4, -0.4), True), ((0.9, -0.4), False)],
    ids=["all cut off", "all rounded", "some cut off and some rounded"],
)
def test_digits_are_all_cut_off_or_all_rounded(fractions, agree):
    """Values beyond those of the copy by a fraction of the last place, in turn."""
    values = [
        float(number + Decimal(fraction).copy_sign(number * Decimal(fraction)) * place(number))
        for number, fraction in zip(map(Decimal, SIGN_RESTORED), cycle(fractions), strict=False)
    ]
    assert all(agreement(values)) == agree


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
    np.testing.assert_allclose(
        reconstruct().values[4:], weighing_estimate(expected), rtol=0, atol=800 * EPS
    )


def test_candidates_are_all_combinations_best_first(everyone):
    names = {(each.triad, each.step_formula, each.steps, each.sum_factor) for each in everyone}
    assert names == set(product(TRIADS, STEP_FORMULAS, STEPS, SUM_FACTORS))
    assert len(everyone) == len(names)
    scores = [sum(each.agrees) for each in everyone]
    assert scores == sorted(scores, reverse=True)


def test_three_candidates_win_and_all_others_lose(everyone):
    """Two rivals with steps twice as long have the leading error of the first one."""
    winners = [each for each in everyone if all(each.agrees)]
    assert everyone[: len(winners)] == winners
    assert {(each.triad, each.sum_factor) for each in winners} == {
        ("unit third axis", "sqrt(3/2), n4 over sqrt(2)")
    }
    assert [(each.step_formula, each.steps) for each in winners] == [
        ("pade", 100),
        ("kutta-merson", 50),
        ("pade-half", 50),
    ]


def test_how_many_candidates_give_each_number(everyone):
    """125 of 162 give the last one: the seven are no seven confirmations."""
    counts = np.sum([each.agrees for each in everyone], axis=0)
    assert dict(zip(NAMES, counts, strict=True)) == {
        "sigma1*": 27,
        "sigma2*": 33,
        "sigma3*": 36,
        "sigma4*": 3,
        "sigma1**": 3,
        "sigma2**": 69,
        "sigma3**": 125,
    }
    # sigma1* does not see the triad, nor the factor: three formulas with all three of each.
    assert counts[0] == 3 * len(TRIADS) * len(SUM_FACTORS)
    assert {each.triad for each in everyone if any(each.agrees[1:3])} == {"unit third axis"}


def test_no_candidate_gives_the_other_slip(everyone):
    """With sigma3* a digit shorter all seven are possible, but not in any of these ways."""
    texts = (*IN_THE_COPY[:2], "-1.00e-3", *IN_THE_COPY[3:])
    scores = [agreement(each.values, texts) for each in everyone]
    assert max(map(sum, scores)) == 6
    assert not any(score[NAMES.index("sigma4*")] for score in scores)


@pytest.mark.parametrize(
    ("seven", "before", "after"),
    [
        ([float(text) for text in SIGN_RESTORED], 1.29e-6, 0.70e-6),
        (reconstruct().values, 1.24e-6, 0.78e-6),
    ],
    ids=["sign restored", "reconstructed"],
)
def test_the_weighing_refines_the_experiment(seven, before, after):
    """All three together; sigma1 alone gets worse."""
    errors = np.stack([seven[:3], seven[4:]]) - TRUE_SIGMA
    rms = np.sqrt((errors**2).mean(axis=-1))
    np.testing.assert_allclose(rms, [before, after], rtol=0, atol=0.005e-6)
    assert abs(errors[1, 0]) > abs(errors[0, 0])


def test_the_digits_dropped_cannot_undo_the_refinement():
    """Half of the sum of the four errors, s1* + s4* - s1**, exceeds that of the fourth number."""
    s1, s4, weighed = (mpmath.iv.mpf(digit_interval(SIGN_RESTORED[i])) for i in (0, 3, 4))
    half_of_the_sum = s1 + s4 - weighed
    assert half_of_the_sum.b < s4.a < 0


def test_winner_needs_cut_off_digits(everyone):
    assert sum(agreement_when(ROUND_DOWN, everyone[0].values)) == 7
    assert sum(agreement_when(ROUND_HALF_EVEN, everyone[0].values)) == 5


@pytest.mark.parametrize(
    ("assumptions", "index", "value", "tolerance"),
    [
        ({"triad": "linear"}, 1, 1.0005e-3, 1e-7),
        ({"step_formula": "taylor-3"}, 0, 3.2e-8, 1e-9),
        ({"step_formula": "taylor-4"}, 0, -0.8e-8, 1e-9),
        ({"step_formula": "cayley"}, 0, -8e-5, 5e-6),
    ],
)
def test_values_of_rejected_candidates(assumptions, index, value, tolerance):
    """The values that the notes on the sources give for them."""
    loser = reconstruct(**assumptions)
    assert loser.values[index] == pytest.approx(value, abs=tolerance)
    assert not loser.agrees[index]


def test_first_number_is_the_integration_error_alone():
    """About n1 the unit triad measures the rate exactly: what is left is -phi^5/720 a step."""
    p = 2 * np.pi / 100
    # Half the angle of 100 steps, over pi; the next term is smaller by a multiple of p^2 below 1.
    expected = 100 * -(p**5) / 720 / (2 * np.pi)
    np.testing.assert_allclose(reconstruct().values[0], expected, rtol=p**2)


def test_readings_of_the_triad():
    linear, unit, symmetric = (triad_reading(triad) for triad in TRIADS)
    np.testing.assert_array_equal(linear, LARIN_TRIAD)
    np.testing.assert_array_equal(linear, [[0, 0, 0], [0, 0, 0], [2e-3, -2e-3, 0]])
    assert np.linalg.norm(np.eye(3)[2] + unit[2]) == pytest.approx(1, abs=EPS)
    np.testing.assert_array_equal(unit[:, :2], linear[:, :2])
    np.testing.assert_array_equal(symmetric, symmetric.T)
    np.testing.assert_array_equal(np.diag(symmetric), 0)
    np.testing.assert_array_equal(symmetric[2, :2], linear[2, :2] / 2)


def test_the_numbers_of_the_copy_exact_and_reconstructed():
    table = experiment_numbers()
    assert list(table) == ["copy", "exact", "reconstructed"]
    assert len(NAMES) == len(IN_THE_COPY) == 7
    np.testing.assert_array_equal(table["copy"], [float(text) for text in IN_THE_COPY])
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
