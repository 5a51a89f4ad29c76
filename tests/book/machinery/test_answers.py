"""How an answer is judged: any form of the right one passes, a slip is called by its name."""

import re
from fractions import Fraction
from itertools import permutations

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, strategies as st

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Said
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.slips import UNITS

QUARTER = Value(kind="compute", right=lambda: np.pi / 2, unit="radians")
OBTUSE = Value(kind="compute", right=lambda: 2.0, unit="radians")
SHARE = Value(kind="compute", right=lambda: 0.1)
VECTOR = Value(kind="compute", right=lambda: np.array([1.0, -2.0, 0.5]))
TURN = Value(
    kind="compute", right=lambda: np.array([0.6, 0.0, 0.0, 0.8]), quaternion=True, accuracy=1e-6
)
ROOTS = Value(kind="compute", right=lambda: np.array([2j, -2j, 1j, -1j]), any_order=True)
MATRIX = Value(kind="compute", right=lambda: np.array([[0.0, 1.0], [2.0, 3.0]]))
NOTHING = Value(kind="predict", right=lambda: 0.0, absolute=0.1, unit="degrees")
EARTH = Formula(
    kind="compute",
    arguments=("U", "phi"),
    draw=lambda rng: (rng.uniform(0.5, 2), rng.uniform(0.1, 1.4)),
    right=lambda U, phi: U * np.cos(phi),
    mistakes={"The sine for the cosine.": lambda U, phi: U * np.sin(phi)},
    aliases={"latitude": "phi"},
)
COLUMN = Formula(
    kind="compute",
    arguments=("v",),
    draw=lambda rng: (rng.normal(size=3),),
    right=lambda v: 2 * v,
)
PAIR = Value(kind="compute", right=lambda: np.array([1e-3, 200.0]), absolute=(1e-4, 1.0))
VECTOR_FORMULA = Formula(
    kind="compute",
    arguments=("x",),
    draw=lambda rng: (rng.normal(),),
    right=lambda x: np.array([x, x**2]),
)
GENEROUS = Value(kind="slide", right=lambda: 50.0, absolute=4.0)
STATEMENT = Choice(kind="explain", right="bd", wrong={"a": "is false.", "c": "is not true."})


def doubled_in_place(v):
    v *= 2
    return v


class Unwilling:
    def __array__(self, *arguments, **options):
        raise RuntimeError("not today")


@pytest.mark.parametrize(
    ("exercise", "answer"),
    [
        (QUARTER, 1.5708),
        (QUARTER, sp.pi / 2),
        (QUARTER, np.float32(np.pi / 2)),
        (QUARTER, np.array(np.pi / 2)),
        (QUARTER, Fraction(355, 226)),
        (QUARTER, sp.Rational(355, 226)),
        (QUARTER, np.pi / 2 + 0j),
        (VECTOR, [1, -2, 0.5]),
        (VECTOR, (1, -2, Fraction(1, 2))),
        (VECTOR, sp.Matrix([1, -2, sp.Rational(1, 2)])),
        (VECTOR, [sp.Integer(1), -2.0, sp.Rational(1, 2)]),
        (TURN, [0.6, 0, 0, 0.8]),
        (TURN, [-0.6, 0, 0, -0.8]),
        (ROOTS, [1j, 2j, -1j, -2j]),
        (ROOTS, [sp.I, 2 * sp.I, -sp.I, -2 * sp.I]),
        (MATRIX, [[0, 1], [2, 3]]),
        (MATRIX, sp.Matrix([[0, 1], [2, 3]])),
        (NOTHING, 0),
        (NOTHING, -0.05),
        (EARTH, lambda U, phi: U * np.sin(np.pi / 2 - phi)),
        (EARTH, sp.Symbol("U") * sp.cos(sp.Symbol("latitude"))),
        (EARTH, sp.Symbol("U", positive=True) * sp.cos(sp.Symbol("phi"))),
        (EARTH, sp.Symbol("U") * sp.sin(sp.pi / 2 - sp.Symbol("phi", real=True))),
        (COLUMN, lambda v: [2 * x for x in v]),
        (PAIR, [1.05e-3, 200.9]),
        (VECTOR_FORMULA, sp.Matrix([sp.Symbol("x"), sp.Symbol("x") ** 2])),
        (VECTOR_FORMULA, lambda x: sp.Matrix([x, x**2])),
        (STATEMENT, "bd"),
        (STATEMENT, "B and D"),
        (STATEMENT, ["(d)", "b"]),
        (STATEMENT, {"b", "d"}),
        (STATEMENT, (letter for letter in "db")),
        (STATEMENT, np.array("bd")),
        (STATEMENT, np.array(["b", "d"])),
        (VECTOR, np.array([[1.0], [-2.0], [0.5]])),
        (VECTOR, sp.Matrix([[1, -2, 0.5]])),
        (ROOTS, {2j, -2j, 1j, -1j}),
        (EARTH, sp.Lambda(sp.symbols("a b"), sp.Symbol("a") * sp.cos(sp.Symbol("b")))),
        (VECTOR_FORMULA, [sp.Symbol("x"), sp.Symbol("x") ** 2]),
        (VECTOR_FORMULA, np.array([sp.Symbol("x"), sp.Symbol("x") ** 2])),
        (COLUMN, doubled_in_place),
    ],
)
def test_any_form_of_the_right_answer_passes(exercise, answer):
    assert exercise.verdict(answer)[:2] == (True, "right.")


@pytest.mark.parametrize(
    ("exercise", "answer", "words"),
    [
        (QUARTER, 90, "asked in radians; this is in degrees"),
        (QUARTER, -np.pi / 2, "sign is reversed"),
        (QUARTER, np.pi, "an angle and its half"),
        (QUARTER, np.pi / 4, "an angle and its half"),
        (QUARTER, np.pi / 2 + 2 * np.pi, "whole turn more or less"),
        (OBTUSE, np.pi - 2.0, "other part of a right angle, of a half turn"),
        (OBTUSE, 4.0, "an angle and its half"),
        (SHARE, 0.9, "This is the rest"),
        (SHARE, 10, "this is in %"),
        (VECTOR, [1, -0.5, 2], "the reciprocal"),
        (SHARE, 0.2, "^not yet. Too large.$"),
        (QUARTER, 1.575, "Close"),
        (QUARTER, 0.3, "^not yet. Too small.$"),
        (QUARTER, 1j, "^not yet. Not a real number.$"),
        (PAIR, [5e-3, 200.0], "The second is right. The first is too large.$"),
        (PAIR, [200.0, 1e-3], "The numbers are right, their order is not"),
        (PAIR, [3e-3, 600.0], "Both are too large: one common factor"),
        (PAIR, [-1e-3, 2e4], "Neither of the two is right yet; the first is of the wrong sign"),
        (PAIR, [1e-3, 198.0], "Close"),
        (TURN, [0.60005, 0, 0, 0.79996], "Close"),
        (TURN, [0.8, 0.6, 0, 0], "scalar stands first"),
        (TURN, [-0.6, 0, 0, 0.8], "opposite rotation: look at the order"),
        (TURN, [0.8, -0.6, 0, 0], "opposite rotation, with the scalar first"),
        (MATRIX, [[0, 2], [1, 3]], "transpose"),
        (EARTH, lambda U, phi: U * np.sin(phi), "sine for the cosine"),
        (EARTH, sp.sin(sp.Symbol("phi")) * sp.Symbol("U"), "sine for the cosine"),
        (EARTH, lambda U, phi: -U * np.cos(phi), "sign is reversed"),
        (EARTH, 0.7, "At U = .*, phi = .* it is too small"),
        (EARTH, lambda U, phi: phi * np.cos(U), "Two of the arguments"),
        (EARTH, lambda U, phi: 5 * U * np.cos(phi), "a constant factor is not"),
        (EARTH, lambda U, phi: -2 * U * np.cos(phi), "the sign and a constant factor"),
        (EARTH, Fraction(7, 10), "it is too small"),
        (EARTH, np.float32(0.7), "it is too small"),
        (QUARTER, 1.6, "^not yet. Too large.$"),
        (QUARTER, 2000, "^not yet. Too large, by about three powers of ten.$"),
        (OBTUSE, 1e-15, "^not yet. Practically zero, nothing but rounding.$"),
        (OBTUSE, -1e-16, "^not yet. Practically zero, nothing but rounding.$"),
        (QUARTER, 1.6e-9, "^not yet. Too small, by about nine powers of ten.$"),
        (VECTOR, [3e-16, 1e-17, 0], "is right yet; the first is practically zero"),
        (VECTOR, [1e-16, -2e-16, 5e-17], "is right yet; the first is practically zero"),
        (QUARTER, -7, "^not yet. Of the wrong sign and too large"),
        (MATRIX, [[2, 3], [0, 1]], "The rows are exchanged"),
        (MATRIX, [[0, 1], [2, 9]], "Three of the 4 entries are right so far"),
        (ROOTS, [2j, -2j, 1j, 1j], "first, second and third are right, the fourth not yet"),
        (VECTOR_FORMULA, [sp.Symbol("x"), 3], "1 of 2 parts"),
        (GENEROUS, 60.0, "Too large.$"),
        (GENEROUS, 41.0, "Too small.$"),
        (GENEROUS, 57.0, "Close"),
        (STATEMENT, "abd", r"^not yet. At least one statement .* own words"),
        (STATEMENT, "b", r"^not yet. At least one statement .* own words"),
    ],
)
def test_slip_is_called_by_its_name(exercise, answer, words):
    verdict = exercise.verdict(answer)
    assert verdict.right is False
    assert re.search(words, verdict.says), verdict.says


@pytest.mark.parametrize(
    ("exercise", "answer", "words"),
    [
        (QUARTER, "90", "Expected numbers without quotation marks"),
        (VECTOR, ["1", "-2", "0.5"], "Expected numbers without quotation marks"),
        (QUARTER, True, "Expected numbers, got a bool."),
        (QUARTER, (129, 6), "got 2 numbers in a list. With a decimal point it is 129.6."),
        (QUARTER, float("nan"), "Expected finite numbers, got NaN or infinity."),
        (QUARTER, sp.oo, "Expected finite numbers, got NaN or infinity."),
        (QUARTER, sp.Symbol("x"), "Expected numbers, found the symbols x."),
        (QUARTER, {"a": 1}, "Expected numbers, got a dict."),
        (QUARTER, [], "Expected numbers, got a list."),
        (VECTOR, 1.0, "Expected 3 numbers in a list, got one number."),
        (VECTOR, [[1, 2], [3]], "Expected numbers, got rows of unequal length."),
        (EARTH, "U*cos(phi)", "Expected an expression or a function of (U, phi), got a str."),
        (EARTH, sp.Symbol("u"), "Expected an expression in U, phi, found also u."),
        (EARTH, lambda U: U, "Your answer raised TypeError"),
        (EARTH, lambda U, phi: 1 / 0, "Your answer raised ZeroDivisionError"),
        (EARTH, lambda U, phi: None, "Expected numbers, got a NoneType."),
        (EARTH, lambda U, phi: [U, phi], "Expected one number, got 2 numbers in a list."),
        (COLUMN, sp.Symbol("v"), "Expected a Python function of (v)."),
        (STATEMENT, "e", "Expected letters from a to d, found 'e'."),
        (STATEMENT, 2, "Expected letters from a to d, as text."),
        (STATEMENT, {"a": False, "b": True}, "Expected letters from a to d, as text."),
        (STATEMENT, ["b", 4], "Expected letters from a to d, as text."),
        (STATEMENT, "bщ", r"Expected letters from a to d, found 'щ'."),
        (STATEMENT, "()", "Expected letters from a to d."),
        (QUARTER, 10**400, "OverflowError"),
        (QUARTER, Unwilling(), "RuntimeError: not today"),
        (EARTH, lambda U, phi: 10**400, "OverflowError"),
        (EARTH, sp.Derivative(sp.Symbol("U") ** 2, sp.Symbol("U")), "Your answer raised"),
        (COLUMN, lambda v: [1] * int(9 + 9 * v[0]), "Expected 3 numbers in a list"),
    ],
)
def test_what_cannot_be_read_is_refused_in_words(exercise, answer, words):
    verdict = exercise.verdict(answer)
    assert verdict.right is False
    assert verdict.says.startswith("not readable. ")
    assert words in verdict.says


def test_every_other_unit_is_noticed():
    for units in UNITS.values():
        for asked, given_in in permutations(units, 2):
            if asked != "1":
                exercise = Value(kind="compute", right=lambda: 0.123 / units[asked], unit=asked)  # noqa: B023
                says = exercise.verdict(0.123 / units[given_in]).says
                assert f"is asked in {asked}" in says
                assert given_in in says or given_in == "1"


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.floats(1e-9, 0.1))
def test_right_is_what_lies_within_the_accuracy(right, answer, accuracy):
    exercise = Value(kind="compute", right=lambda: right, accuracy=accuracy)
    assert exercise.verdict(answer).right == (abs(answer - right) <= accuracy * abs(right))


def test_remark_is_told_to_who_has_found_it_only():
    exercise = Value(kind="compute", right=lambda: 1.0, remark="Now see.")
    assert exercise.verdict(1.0).says == "right. Now see."
    assert "Now see" not in exercise.verdict(2.5).says


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("abd", r"\(a\) is false."),
        ("b", "something else is too"),
        ("ab", "More than one statement"),
    ],
)
def test_reason_is_given_for_a_reason(answer, words):
    assert re.search(words, STATEMENT.verdict(answer, Said("I think it is.")).says)
    assert not re.search(words, STATEMENT.verdict(answer, Said("I think")).says)


def test_a_unit_that_is_not_known_is_refused_at_once() -> None:
    with pytest.raises(ValueError, match=r"unit: expected one of slips\.UNITS, got 'furlongs'"):
        Value(kind="compute", right=lambda: 1.0, unit="furlongs")
