"""The shared checks: what they let through unchanged, and the sentence with which they refuse."""

import re
from dataclasses import dataclass
from datetime import timedelta
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.checks import (
    UnusualWarning,
    checked_function,
    checked_generator,
    checked_instance,
    checked_path,
    checked_text,
    chosen_number,
    common_leading_axes,
    finite_array,
    finite_arrays,
    finite_number,
    keep,
    linear_error_matrix,
    named_or_own,
    nonnegative_number,
    nonzero_vectors,
    one_of,
    one_pull,
    one_quaternion,
    plausible_error_matrix,
    positive_array,
    positive_number,
    probability,
    pull_of_gravity,
    row_number,
    shown,
    some_of,
    speed_of_body,
    table_rate,
    truth_value,
    turned_angle,
    unit_quaternions,
    usual_deviation,
    whole_number,
    whole_pairs,
    within,
)
from driftlab.core.vectors import norms
from driftlab.gyrocompass.alignment_deviations import alignment_standard_deviation
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.triad import split_error_matrix, triad_matrix
from support import EPS, directions


@pytest.mark.parametrize("dtype", ["int8", "uint64", "float16", "float32", "float64"])
def test_real_numbers_become_float64(dtype):
    array = finite_array(np.array([1, 2, 3], dtype=dtype), "value", 3)
    assert array.dtype == np.float64
    np.testing.assert_array_equal(array, [1, 2, 3])


@pytest.mark.parametrize(
    "value",
    [np.arange(3.0), np.arange(6.0)[::2], np.ones((3, 2)).T, np.full(3, 1e40)],
    ids=["plain", "with gaps", "turned", "large"],
)
def test_float64_is_not_copied(value):
    assert finite_array(value, "value") is value


def test_a_rotation_stands_for_its_quaternion():
    half = Rotation.from_rotvec([0.0, 0.0, np.pi])
    np.testing.assert_allclose(finite_array(half, "start", 4), [0, 0, 1, 0], atol=EPS)


@pytest.mark.parametrize("nothing", [[], np.zeros((0, 2)), np.zeros((0, 5))])
def test_no_pairs_are_a_table_of_two_columns(nothing):
    assert whole_pairs(nothing, "static_intervals").shape == (0, 2)


@pytest.mark.parametrize("sign", [1, -1])
def test_light_itself_is_not_faster_than_light(sign):
    light = sign * np.array([0.0, 299792458.0])
    assert speed_of_body(light, "velocity") is light
    with pytest.raises(
        ValueError, match=r"^velocity: expected m/s, slower than light, got -?2.99792e"
    ):
        speed_of_body(np.nextafter(light, sign * np.inf), "velocity")


@pytest.mark.parametrize("degrees", [13.0, -13.0])
def test_one_angle_of_many_turns_is_warned_of(degrees):
    angles = np.array([0.1, degrees, 0.2])
    with pytest.warns(UnusualWarning, match=f"^heading: {degrees:g} rad is 2.1 turns"):
        assert turned_angle(angles, "heading") is angles


@pytest.mark.parametrize(
    ("value", "shape", "sentence"),
    [
        ([1, np.nan], (), "value: expected finite numbers, got 1 NaN or infinite."),
        ([np.inf, -np.inf], (), "value: expected finite numbers, got 2 NaN or infinite."),
        ([1j], (), "value: expected real numbers, got dtype complex128."),
        ([True], (), "value: expected real numbers, got dtype bool."),
        (["1"], (), "value: expected real numbers, got dtype <U1."),
        (None, (), "value: expected real numbers, got None."),
        ("0.01", (), "value: expected real numbers, got '0.01'."),
        (True, (), "value: expected real numbers, got True."),
        (timedelta(seconds=1), (), "value: expected real numbers, got a timedelta."),
        (np.timedelta64(10, "ms"), (), "value: expected real numbers, got 10 milliseconds."),
        ([None], (), "value: expected real numbers, got dtype object."),
        (np.array(1j), (), "value: expected real numbers, got dtype complex128."),
        (
            np.ma.array([1.0, 2.0], mask=[False, True]),
            (),
            "value: expected all values to be there, got masked ones.",
        ),
        (
            [np.ones(2), np.ma.array([1.0, 2.0], mask=[False, True])],
            (),
            "value: expected all values to be there, got masked ones.",
        ),
        (
            [1.0, np.ma.masked],
            (),
            "value: expected all values to be there, got masked ones.",
        ),
        ([1, 1.1e50], (), "value: expected numbers of at most 1e+50 in size, got 1.1e+50."),
        ([-1e308, 1e300], (), "value: expected numbers of at most 1e+50 in size, got -1e+308."),
        ([10**400], (), "value: expected real numbers, got dtype object."),
        ([[1, 2], [3]], (), "value: expected real numbers, got rows of unequal length."),
        ([[1, 2], [3]], (2,), r"value: expected shape (..., 2), got rows of unequal length."),
        ([], (), "value: expected at least one value, got an empty array."),
        (np.empty((0, 3)), (3,), "value: expected at least one value, got an empty array."),
        (1.0, (3,), "value: expected shape (..., 3), got shape ()."),
        (np.eye(4), (3, 3), "value: expected shape (..., 3, 3), got shape (4, 4)."),
        (np.ones(3), (3, 3), "value: expected shape (..., 3, 3), got shape (3,)."),
    ],
)
def test_finite_array_refuses_in_one_sentence(value, shape, sentence):
    with pytest.raises(ValueError, match="value: ") as refusal:
        finite_array(value, "value", *shape)
    assert str(refusal.value) == sentence


@pytest.mark.parametrize("word", [np.longdouble, np.float64])
def test_the_largest_number_of_any_word_is_too_large(word):
    """What a double cannot hold is refused before it becomes one."""
    with pytest.raises(ValueError, match=r"^value: expected numbers of at most 1e\+50 "):
        finite_number(np.finfo(word).max, "value")


@given(directions(), st.integers(-1000, 160))
def test_unit_vectors_and_norms_at_every_scale(vector, exponent):
    # Exact scaling by a power of two; a hypothesis entry below 1e-3 of the largest may become
    # subnormal at 2^-1000 and lose its digits, but then weighs less than an ulp of the norm.
    unit, norm = nonzero_vectors(np.ldexp(vector, exponent), "vector")
    np.testing.assert_allclose(unit, vector / np.linalg.norm(vector), rtol=0, atol=4 * EPS)
    np.testing.assert_allclose(np.ldexp(norm, -exponent), np.linalg.norm(vector), rtol=4 * EPS)
    np.testing.assert_allclose(
        norms(np.ldexp(vector, exponent)), norm, rtol=4 * EPS, err_msg="norms"
    )


def test_norms_are_right_beside_others_of_any_size():
    vectors = np.array([[0.0, 3e-200, 4e-200], [3.0, 0.0, 4.0], [4e200, 3e200, 0.0]])
    np.testing.assert_allclose(norms(vectors), [5e-200, 5.0, 5e200], rtol=4 * EPS)


def test_smallest_number_is_not_zero():
    unit, norm = nonzero_vectors([0, 5e-324, 0], "vector")
    np.testing.assert_array_equal(unit, [0, 1, 0])
    assert norm == 5e-324


def test_one_zero_vector_among_many_is_refused():
    with pytest.raises(ValueError, match=r"^axis: expected nonzero vectors, got a zero vector"):
        nonzero_vectors([[1, 0, 0], [0, 0, 0]], "axis")


@pytest.mark.parametrize("value", [1, 7, np.int8(7), np.uint64(7), np.array(7)])
def test_whole_numbers_pass(value):
    number = whole_number(value, "turns")
    assert type(number) is int
    assert number == value


@pytest.mark.parametrize("value", [0, -1, 1.0, 0.5, True, np.True_, "1", None, [1], np.nan])
def test_whole_number_refuses(value):
    with pytest.raises(ValueError, match=r"^turns: expected a whole number of at least 1, got "):
        whole_number(value, "turns")


def test_one_number_is_a_float():
    assert finite_number(np.array(2), "value") == 2.0
    assert type(finite_number(np.float32(2), "value")) is float
    with pytest.raises(ValueError, match=r"^value: expected one number, got shape \(1,\)\.$"):
        finite_number([2.0], "value")
    with pytest.raises(ValueError, match=r"^value: expected finite numbers, got 1 NaN"):
        finite_number(np.nan, "value")


def test_nothing_masked_is_let_through():
    np.testing.assert_array_equal(finite_array(np.ma.array([1.0, 2.0]), "value"), [1, 2])


@pytest.mark.parametrize("size", [1e-310, 1e-200, 1.0, 1e49])
def test_quaternions_of_any_size_become_unit_ones(size):
    expected = np.array([[0.5, -0.5, 0.5, 0.5], [0, 0.6, 0, -0.8]])
    found = unit_quaternions(size * np.array([[1, -1, 1, 1], [0, 3, 0, -4]]), "value")
    # Of numbers below 2e-308 some last digits are gone before they come here.
    bound = 4 * EPS if size > 1e-300 else 1e-13
    np.testing.assert_allclose(found, expected, rtol=0, atol=bound)
    with pytest.raises(ValueError, match=r"^value: expected nonzero quaternions, got a zero q"):
        unit_quaternions([[1, 0, 0, 0], [0, 0, 0, 0]], "value")


@pytest.mark.parametrize(
    ("value", "kind", "sentence"),
    [
        (3, str, "scheme: expected a str, got 3."),
        ("x", int, "scheme: expected an int, got 'x'."),
        (None, list, "scheme: expected a list, got None."),
        (np.zeros(3), dict, "scheme: expected a dict, got an array of shape (3,)."),
    ],
)
def test_a_thing_of_another_kind_is_refused(value, kind, sentence):
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        checked_instance(value, kind, "scheme")


def test_a_thing_of_its_kind_is_returned():
    value = [1]
    assert checked_instance(value, list, "value") is value
    rng = np.random.default_rng(1)
    assert checked_generator(rng) is rng
    assert checked_generator(np.int64(7)).uniform() == np.random.default_rng(7).uniform()


def test_zero_is_a_seed():
    assert checked_generator(0).uniform() == np.random.default_rng(0).uniform()


@pytest.mark.parametrize("seed", [None, -1, True, 1.0, np.random.RandomState(1)])
def test_noise_is_drawn_from_a_generator_only(seed):
    with pytest.raises(ValueError, match=r"^rng: expected a numpy Generator to draw the noise"):
        checked_generator(seed)


def test_one_whole_matrix_among_many_is_refused():
    several = np.stack([np.zeros((3, 3)), np.eye(3)])
    with pytest.raises(ValueError, match=r"^error_matrix: .* is it the whole matrix I \+ M\? Sub"):
        plausible_error_matrix(several, "error_matrix")
    with pytest.warns(UnusualWarning, match=r"^matrix: .* If so, subtract the identity"):
        linear_error_matrix(several, "matrix")


def test_a_diagonal_two_fifths_from_one_is_warned_of():
    for diagonal in (0.6, 1.399):
        with pytest.warns(UnusualWarning, match="is it the whole matrix"):
            plausible_error_matrix(diagonal * np.eye(3), "error_matrix", scale=4.0)
    plausible_error_matrix(0.599 * np.eye(3), "error_matrix")


@pytest.mark.parametrize(
    ("scale", "row", "column"), [(1.0, 0, 1), (4.0, 0, 1), (1.0, 2, 2), (4.0, 2, 2)]
)
def test_one_entry_that_is_larger_than_usual_is_warned_of(scale, row, column):
    several = np.zeros((2, 3, 3))
    several[1, row, column] = -(scale if row == column else 1.0)
    plausible_error_matrix(several, "error_matrix", scale)
    several *= 1.001
    with pytest.warns(UnusualWarning, match=f"^error_matrix: an entry is {several.min():g}, and"):
        plausible_error_matrix(several, "error_matrix", scale)


@pytest.mark.parametrize(
    ("asked", "matrix"),
    [
        (triad_matrix, 0.7 * np.eye(3)),
        (triad_matrix, np.diag([1.1, 0.0], 1)),
        (split_error_matrix, np.eye(3)),
    ],
)
def test_a_warning_of_a_matrix_points_to_who_hands_it_in(asked, matrix):
    with pytest.warns(UnusualWarning, match="^(error_matrix|matrix): ") as seen:
        asked(matrix)
    assert [warning.filename for warning in seen] == [__file__]


@dataclass(frozen=True)
class Turns:
    count: int

    def __post_init__(self) -> None:
        keep(self, count=whole_number(self.count, "count"))


def test_a_record_computes_in_the_kind_of_number_that_was_checked():
    assert Turns(np.int8(3)).count * 100 == 300


def test_what_is_known_passes():
    counts = {"one": 1, "two": 2}
    assert named_or_own("two", int, counts, "count") == 2
    assert named_or_own(7, int, counts, "count") == 7
    assert one_of("gap", ("gap", "rate"), "allow") == "gap"
    assert some_of("gap", ("gap", "rate"), "allow") == ("gap",)
    assert chosen_number(np.int8(4), (3, 4), "dimension") == 4
    assert common_leading_axes(rate=(3, 1), time=(2,)) == (3, 2)
    assert checked_path("a/b.csv", "path") == Path("a/b.csv")
    rate, time = finite_arrays(rate=([1, 2, 3], 3), time=([0, 1],))
    assert (rate.shape, time.shape) == ((3,), (2,))


REFUSALS = {
    "axes": (
        lambda: common_leading_axes(rate=(3,), time=(2,)),
        "rate, time: expected leading axes that broadcast, got (3,) and (2,).",
    ),
    "positive array": (
        lambda: positive_array([1, -2], "times"),
        "times: expected numbers above 0, got -2.",
    ),
    "divisor array": (
        lambda: positive_array([1e-60], "times"),
        "times: expected numbers of at least 1e-50, got 1e-60.",
    ),
    "pairs": (
        lambda: whole_pairs([(0, 100), 200], "static_intervals"),
        "static_intervals: expected whole numbers of shape (m, 2), got [(0, 100), 200].",
    ),
    "one quaternion": (
        lambda: one_quaternion([[0, 0, 0, 1]], "attitude"),
        "attitude: expected one quaternion (4,), got shape (1, 4).",
    ),
    "positive": (
        lambda: positive_number(-1, "interval"),
        "interval: expected a positive number, got -1.",
    ),
    "divisor": (
        lambda: positive_number(1e-60, "interval"),
        "interval: expected a number of at least 1e-50, got 1e-60.",
    ),
    "not negative": (
        lambda: nonnegative_number(-1, "damping"),
        "damping: expected a number of at least 0, got -1.",
    ),
    "probability": (
        lambda: probability(95, "confidence"),
        "confidence: expected a number between 0 and 1, got 95.",
    ),
    "too many": (
        lambda: whole_number(2**31, "turns"),
        "turns: expected a whole number of at most 2147483647, got 2147483648.",
    ),
    "chosen": (
        lambda: chosen_number(5, (3, 4), "dimension"),
        "dimension: expected 3 or 4, got 5.",
    ),
    "row": (
        lambda: row_number(2.5, "begin"),
        "begin: expected a whole number, the place of a row, got 2.5.",
    ),
    "truth": (lambda: truth_value("no", "exact"), "exact: expected True or False, got 'no'."),
    "one of": (
        lambda: one_of("avaraged", ("averaged", "upper triangle"), "frame"),
        "frame: expected one of averaged, upper triangle, got 'avaraged'.",
    ),
    "some of": (
        lambda: some_of(["gap", 3], ("gap", "rate"), "allow"),
        "allow: expected some of gap, rate, got 3.",
    ),
    "named": (
        lambda: named_or_own("six", int, {"one": 1, "two": 2}, "count"),
        "count: expected an int or the name of one (one, two), got 'six'.",
    ),
    "function": (
        lambda: checked_function(0.5, "rate", "the time"),
        "rate: expected a function of the time, got 0.5.",
    ),
    "path": (
        lambda: checked_path(["a.csv", "b.csv"], "path"),
        "path: expected a path, got ['a.csv', 'b.csv'].",
    ),
    "text": (lambda: checked_text(None, "name"), "name: expected text, got None."),
    "table rate": (
        lambda: table_rate(360.0, "rate"),
        "rate: expected rad/s, at most 200, got 360: is it in degrees? np.radians(360).",
    ),
    "within": (
        lambda: within(np.array([90.0]), "pitch", np.pi, "rad", "is it in degrees?"),
        "pitch: expected rad, at most 3.142 in size, got 90: is it in degrees?",
    ),
    "gravity": (
        lambda: pull_of_gravity(np.array([9.81, 1.0])),
        "gravity: expected m/s^2, 1.2 to 50, got 1: is it in g?",
    ),
    "one gravity": (
        lambda: one_pull(1.0),
        "gravity: expected m/s^2, 1.2 to 50, got 1: is it in g?",
    ),
}


@pytest.mark.parametrize(("check", "sentence"), REFUSALS.values(), ids=REFUSALS)
def test_a_check_refuses_in_one_sentence(check, sentence):
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        check()


def test_a_usual_deviation_passes_and_an_unusual_one_names_the_likely_unit():
    assert usual_deviation(40e-6, "scale_factor") == 40e-6
    sentence = "installation: 40 rad is more than instruments usually have. If arc seconds were "
    with pytest.warns(UnusualWarning, match=f"^{re.escape(sentence)}meant, np.radians"):
        assert usual_deviation(40, "installation") == 40.0


@pytest.mark.parametrize(
    "ask",
    [
        lambda: PriorStandardDeviations(scale_factor_asymmetry=30.0),
        lambda: ImuNoise(30.0),
        lambda: alignment_standard_deviation(0.5, 60.0, 30.0),
    ],
)
def test_a_warning_of_a_deviation_points_to_who_says_it(ask):
    with pytest.warns(UnusualWarning, match=r"^\w+: 30 .* were meant, ") as seen:
        ask()
    assert seen[0].filename == __file__


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (2.5, "2.5"),
        ("averaged", "'averaged'"),
        (("NED", "ENU"), "('NED', 'ENU')"),
        (np.eye(3), "an array of shape (3, 3)"),
        (dict, "the class dict"),
        (range(3), "a range"),
        (len, "the function len"),
    ],
)
def test_a_value_is_shown_in_a_few_words(value, words):
    assert shown(value) == words


def test_an_object_in_place_of_its_array_is_told_which_arrays_it_has():
    increments = Increments(1.0, np.zeros((2, 3)), np.zeros((2, 3)))
    with pytest.raises(ValueError, match="an Increments: hand in one of its arrays: angle, velo"):
        finite_array(increments, "rate")
