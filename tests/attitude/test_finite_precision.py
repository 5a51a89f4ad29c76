"""Short words: a step's quaternion and complement, and what is lost from step to step."""

from fractions import Fraction
from itertools import product

import mpmath
import numpy as np
import pytest
from hypothesis import given, strategies as st

from driftlab.attitude.cayley import rotation_quaternion
from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.finite_precision import UPDATES, integrate_finite_word, step_finite_word
from driftlab.attitude.integration import integrate, step_rotation_vectors
from driftlab.checks import unit_quaternions
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle
from support import EPS, random_quaternions, vectors

EPS32 = float(np.finfo(np.float32).eps)
EARTH_RATE = 7.292115e-5  # rad/s

every_update = pytest.mark.parametrize("update", UPDATES)
both_kinds = pytest.mark.parametrize("rotation_vector", [False, True])


def exact_complement(vector, rotation_vector):
    """1 - l0 in fifty digits, rounded once."""
    with mpmath.workdps(50):
        square = sum(mpmath.mpf(float(part)) ** 2 for part in vector)
        if rotation_vector:
            return float(2 * mpmath.sin(mpmath.sqrt(square) / 4) ** 2)
        return float(2 * square / (1 + square))


# One step


@both_kinds
@given(vector=vectors(3))
def test_step_in_a_long_word_is_the_usual_quaternion(rotation_vector, vector):
    method = from_rotation_vector if rotation_vector else rotation_quaternion
    step = step_finite_word(vector, rotation_vector=rotation_vector)
    # A few roundings of numbers up to 1, and angles up to 2.6 rad, good to some eps of themselves.
    np.testing.assert_allclose(step[:4], method(vector), rtol=0, atol=16 * EPS)
    np.testing.assert_allclose(step[4], 1 - step[3], rtol=0, atol=16 * EPS)


@both_kinds
@pytest.mark.parametrize("size", [1e-9, 1e-4, 1e-2, 1.0])
@pytest.mark.parametrize("word", ["float32", "float64"])
def test_complement_keeps_its_digits(rotation_vector, size, word):
    vector = (size * np.array([0.6, -0.3, 0.7])).astype(word)
    step = step_finite_word(vector, rotation_vector=rotation_vector)
    assert step.dtype == word
    # Two squares, sums and a division; each of them is good to half an eps of the word.
    expected = exact_complement(vector, rotation_vector)
    np.testing.assert_allclose(step[4], expected, rtol=8 * float(np.finfo(word).eps))


@pytest.mark.parametrize("name", ["picard-1", "rotation-vector-2"])
def test_scalar_part_of_a_short_word_loses_what_the_complement_keeps(name):
    """The paper's remark: at |gamma| = 1e-4, 1 - l0 is 1.25e-9, and half an eps of float32 6e-8."""
    rotation_vector = name == "rotation-vector-2"
    gamma = 1e-4 * np.array([2, -1, 2]) / 3
    vector = (gamma if rotation_vector else -gamma / 4).astype(np.float32)
    step = step_finite_word(vector, rotation_vector=rotation_vector)
    assert 1 - step[3] == 0
    np.testing.assert_allclose(step[4], 1e-8 / 8, rtol=8 * EPS32)


@both_kinds
def test_no_rotation_is_the_identity(rotation_vector):
    step = step_finite_word(np.zeros((2, 3), np.float32), rotation_vector=rotation_vector)
    np.testing.assert_array_equal(step, [[0, 0, 0, 1, 0]] * 2)


# Many steps


@every_update
@given(name=st.sampled_from(list(CONING_ALGORITHMS)), seed=st.integers(0, 1000))
def test_long_word_gives_the_usual_attitude(update, name, seed):
    rng = np.random.default_rng(seed)
    increments, start = rng.uniform(-0.2, 0.2, (12, 3)), random_quaternions(1, seed=seed)[0]
    attitude = integrate_finite_word(increments, name, start=start, word=np.float64, update=update)
    # Up to twelve steps, each good to some eps.
    np.testing.assert_allclose(
        attitude, integrate(increments, name, start=start), rtol=0, atol=100 * EPS
    )


@every_update
def test_short_word_is_good_to_some_roundings_a_step(update):
    increments = np.random.default_rng(0).uniform(-0.2, 0.2, (60, 3))
    attitude = integrate_finite_word(increments, update=update)
    exact = integrate(increments)
    np.testing.assert_allclose(attitude, exact, rtol=0, atol=30 * 8 * EPS32)
    # And no better, so that it is a short word indeed.
    assert np.abs(attitude - exact).max() > EPS32 / 4


def drift_at_earth_rate(update, start):
    """Error in deg/h after 2 s at 1 kHz about an axis that is none of the body's."""
    count, axis = 2000, np.array([0.3, -0.5, 0.8]) / np.sqrt(0.98)
    increments = np.tile(1e-3 * EARTH_RATE * axis, (count, 1))
    # Compared from the start that the short word really has.
    start = np.asarray(start, np.float32)
    attitude = integrate_finite_word(increments, start=start, update=update)[-1]
    exact = integrate(increments, start=start.astype(float))[-1]
    angle = rotation_angle(multiply(conjugate(exact), attitude))
    return np.degrees(angle) / (count * 1e-3) * 3600


# The Earth turns by 1.5e-7 rad in a step, so components change by less than 7e-8. Float32 has a
# spacing of 6e-8 between 1/2 and 1: up to half of that is rounded off, always in the same sense.
STARTS = [[0.5, 0.5, 0.5, 0.5], [0.1, -0.3, 0.2, 0.927], [0.69, 0.1, -0.59, 0.4]]
PLAIN = [update for update in UPDATES if update != "compensated"]


@pytest.mark.parametrize("start", STARTS, ids=str)
@pytest.mark.parametrize("update", PLAIN)
def test_short_word_loses_the_earths_rotation(update, start):
    assert 1 < drift_at_earth_rate(update, start) < 20


def turning(count):
    """Increments (count, 3) of a turn by 1 rad/s about a fixed axis, at 2 kHz."""
    return np.tile(5e-4 * np.array([0.6, 0.0, 0.8]), (count, 1))


def on_a_cone(count):
    """Increments (count, 3) on a cone of half angle 1 deg, 5 times a second, at 1 kHz."""
    tilt, turned = np.radians(1), 2 * np.pi * 5 * 1e-3 * np.arange(count + 1)
    angles = [
        np.sin(tilt) * np.sin(turned),
        -np.sin(tilt) * np.cos(turned),
        (1 - np.cos(tilt)) * turned,
    ]
    return np.diff(np.stack(angles, axis=-1), axis=0)


@pytest.mark.parametrize("motion", [turning, on_a_cone])
def test_complement_keeps_the_attitude_where_the_scalar_part_is_not_stored_as_one(motion):
    """Not the norm alone: products with a rounded l0 shrink the components unequally."""
    increments = motion(4000)
    steps = step_finite_word(step_rotation_vectors(increments, "two-step-4", word=np.float32))
    assert np.median(1 - steps[:, 3]) > 0
    starts = random_quaternions(16).astype(np.float32)
    exact = integrate(increments, start=starts)[:, -1]
    errors = {}
    for update in UPDATES:
        found = integrate_finite_word(increments, start=starts, update=update)[:, -1].astype(float)
        found /= np.linalg.norm(found, axis=-1, keepdims=True)
        angles = rotation_angle(multiply(conjugate(exact), found))
        errors[update] = np.sqrt(np.mean(angles**2))
    assert errors["complement"] < min(errors["product"], errors["small terms first"]) / 10
    assert errors["compensated"] < errors["complement"] / 3


@pytest.mark.parametrize("start", STARTS, ids=str)
def test_compensated_sum_keeps_it(start):
    # What is left is one rounding of the last sum: 6e-8 rad in 2 s are 0.006 deg/h.
    assert drift_at_earth_rate("compensated", start) < 0.05


@pytest.mark.parametrize("update", PLAIN)
def test_short_word_loses_little_from_the_attitude_zero(update):
    """There the components that change are small, and small numbers have a fine spacing."""
    assert drift_at_earth_rate(update, [0, 0, 0, 1]) < 0.05


def fused_by_fractions(attitude, column):
    """The four products of each component, each added with one rounding, by exact fractions."""
    total = np.float32(attitude[0] * column[0])
    for a, c in zip(attitude[1:], column[1:], strict=True):
        total = np.float32(float(Fraction(float(a)) * Fraction(float(c)) + Fraction(float(total))))
    return total


@given(seed=st.integers(0, 1000))
def test_fused_multiply_add_rounds_a_product_and_its_sum_once(seed):
    rng = np.random.default_rng(seed)
    increments = rng.uniform(-0.3, 0.3, (1, 3)).astype(np.float32)
    start = random_quaternions(1, seed=seed)[0].astype(np.float32)
    start = (start / np.linalg.norm(start.astype(float))).astype(np.float32)
    found = integrate_finite_word(increments, "picard-1", start=start, fused=True)[0]
    first = unit_quaternions(start, "start").astype(np.float32)
    x, y, z, scalar, _ = step_finite_word(
        step_rotation_vectors(increments, "picard-1", word=np.float32)
    )[0]
    columns = [(scalar, z, -y, x), (-z, scalar, x, y), (y, -x, scalar, z), (-x, -y, -z, scalar)]
    expected = [fused_by_fractions(first, column) for column in columns]
    np.testing.assert_array_equal(found, expected)


@every_update
def test_fused_sums_in_half_precision_are_those_of_a_longer_word_rounded(update):
    increments = np.random.default_rng(0).uniform(-0.2, 0.2, (60, 3))
    found = integrate_finite_word(increments, update=update, word=np.float16, fused=True)
    exact = integrate(increments)
    assert found.dtype == np.float16
    # Sixty samples make thirty steps, each good to some eps of the word.
    np.testing.assert_allclose(
        found.astype(float), exact, rtol=0, atol=30 * 8 * np.finfo(np.float16).eps
    )


def test_fused_words_of_64_bits_are_refused():
    words = r"^word: expected float16 or float32 with fused multiply-add, got float64\.$"
    with pytest.raises(ValueError, match=words):
        integrate_finite_word(np.zeros((2, 3)), word=np.float64, fused=True)


@every_update
@pytest.mark.parametrize("fused", [False, True])
def test_length_is_one_if_it_is_mended_and_the_attitude_is_the_same(update, fused):
    increments = np.random.default_rng(0).uniform(-0.2, 0.2, (600, 3))
    options = {"update": update, "fused": fused}
    mended = integrate_finite_word(increments, normalise=True, **options).astype(float)
    assert np.abs(np.linalg.norm(mended, axis=-1) - 1).max() < 2 * EPS32
    left = integrate_finite_word(increments, **options).astype(float)
    angle = rotation_angle(multiply(conjugate(left), mended))
    assert angle.max() < 300 * 8 * EPS32


# Shapes, words, refusals


@every_update
def test_answer_is_in_the_word(update):
    increments = np.random.default_rng(0).uniform(-0.2, 0.2, (6, 3))
    for (name, chosen), word in product(CONING_ALGORITHMS.items(), ("float16", np.float32, float)):
        attitude = integrate_finite_word(increments, name, word=word, update=update)
        assert attitude.dtype == np.dtype(word), name
        assert attitude.shape == (6 // chosen.samples, 4), name


@pytest.mark.parametrize(
    ("vectors", "words"),
    [
        (np.array([1, 2, 3]), "floating numbers whose squares are finite, got int64"),
        (np.float32([0, 1e30, 0]), "floating numbers whose squares are finite, got float32"),
        (np.zeros(4), r"shape \(\.\.\., 3\), got shape \(4,\)"),
    ],
)
@both_kinds
def test_bad_vectors_are_refused(rotation_vector, vectors, words):
    with pytest.raises(ValueError, match=rf"^vectors: expected {words}"):
        step_finite_word(vectors, rotation_vector=rotation_vector)


@pytest.mark.parametrize("start", STARTS, ids=str)
def test_complement_does_as_small_terms_first_where_the_scalar_part_is_stored_as_one(start):
    """1 - l0 is 3e-15 here: whether it is kept or not is nothing beside an eps of 1e-7."""
    first, complement = (drift_at_earth_rate(name, start) for name in UPDATES[1:3])
    assert complement == pytest.approx(first, rel=0.01)
