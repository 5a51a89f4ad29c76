"""Quaternion algebra against its axioms, SciPy's Rotation and fifty-digit arithmetic."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    left_matrix,
    multiply,
    pure,
    right_matrix,
    rotation_angle,
    to_rotation_vector,
)
from support import EPS, IDENTITY, quaternions, random_quaternions, vectors

UNIT_I, UNIT_J, UNIT_K, ONE = np.eye(4)

# A component of a product is a sum of four products of numbers up to 1: four roundings of the
# products and three of the sums, at most 8 halves of an ulp.
PRODUCT = 8 * EPS


def exact_quaternion(rotation_vector):
    """Quaternion of a rotation vector in fifty digits, rounded once."""
    with mpmath.workdps(50):
        f = [mpmath.mpf(float(x)) for x in rotation_vector]
        half = mpmath.sqrt(sum(x * x for x in f)) / 2
        factor = mpmath.sin(half) / half / 2 if half else mpmath.mpf("0.5")
        return np.array([float(factor * x) for x in f] + [float(mpmath.cos(half))])


@pytest.mark.parametrize(
    ("first", "second", "product"),
    [
        (UNIT_I, UNIT_J, UNIT_K),
        (UNIT_J, UNIT_K, UNIT_I),
        (UNIT_K, UNIT_I, UNIT_J),
        (UNIT_J, UNIT_I, -UNIT_K),
        (UNIT_I, UNIT_I, -ONE),
        (UNIT_J, UNIT_J, -ONE),
        (UNIT_K, UNIT_K, -ONE),
    ],
    ids=["ij=k", "jk=i", "ki=j", "ji=-k", "ii=-1", "jj=-1", "kk=-1"],
)
def test_product_is_hamiltons(first, second, product):
    np.testing.assert_array_equal(multiply(first, second), product)


@given(quaternions(), quaternions())
def test_product_is_scipys(p, q):
    product = (Rotation.from_quat(p) * Rotation.from_quat(q)).as_quat()
    # SciPy normalises both factors again, which may move each component by an ulp or two.
    np.testing.assert_allclose(multiply(p, q), product, rtol=0, atol=2 * PRODUCT)


@given(quaternions(), quaternions())
def test_conjugate_reverses_products_and_inverts(p, q):
    np.testing.assert_allclose(
        conjugate(multiply(p, q)), multiply(conjugate(q), conjugate(p)), rtol=0, atol=PRODUCT
    )
    np.testing.assert_allclose(multiply(q, conjugate(q)), ONE, rtol=0, atol=2 * PRODUCT)


@given(quaternions(), quaternions())
def test_matrices_are_the_two_multiplications_and_commute(p, q):
    left, right = left_matrix(p), right_matrix(q)
    np.testing.assert_allclose(left @ q, multiply(p, q), rtol=0, atol=PRODUCT)
    np.testing.assert_allclose(right @ p, multiply(p, q), rtol=0, atol=PRODUCT)
    np.testing.assert_allclose(left @ right, right @ left, rtol=0, atol=PRODUCT)


@given(quaternions(), vectors())
def test_sandwich_maps_body_to_reference(q, vector):
    rotated = multiply(multiply(q, pure(vector)), conjugate(q))
    expected = pure(Rotation.from_quat(q).apply(vector))
    np.testing.assert_allclose(rotated, expected, rtol=0, atol=20 * 8 * PRODUCT)


@given(vectors(1e3))
def test_quaternion_of_a_rotation_vector_in_every_digit(rotation_vector):
    # The angle is rounded to a relative 2 eps, which moves its sine and cosine by angle * eps.
    bound = (4 + np.linalg.norm(rotation_vector)) * EPS
    np.testing.assert_allclose(
        from_rotation_vector(rotation_vector), exact_quaternion(rotation_vector), rtol=0, atol=bound
    )


@pytest.mark.parametrize("size", [0.0, 5e-324, 1e-310, 1e-200, 1e-160, 1e-9, 1.0])
def test_small_rotations_keep_their_digits(size):
    rotation_vector = size * np.array([2.0, -1.0, 2.0])
    np.testing.assert_allclose(
        from_rotation_vector(rotation_vector), exact_quaternion(rotation_vector), rtol=4 * EPS
    )


@pytest.mark.parametrize("size", [1e9, 1e16, 1e49])
def test_rotation_of_any_size_has_unit_norm(size):
    quaternion = from_rotation_vector(size * np.array([2.0, -1.0, 2.0]))
    assert np.linalg.norm(quaternion) == pytest.approx(1, abs=4 * EPS)


def test_quaternion_changes_sign_after_a_turn_and_returns_after_two():
    turns = from_rotation_vector(2 * np.pi * np.array([[1, 0, 0], [2, 0, 0]]))
    np.testing.assert_allclose(turns, [-ONE, ONE], rtol=0, atol=8 * EPS)


@given(quaternions().filter(lambda q: abs(q[3]) > 1e-9))
def test_rotation_vector_and_angle_are_scipys(q):
    reference = Rotation.from_quat(q)
    bound = 32 * EPS  # the angle, up to pi, is twice an arc tangent of numbers good to 4 eps
    np.testing.assert_allclose(to_rotation_vector(q), reference.as_rotvec(), rtol=0, atol=bound)
    assert rotation_angle(q) == pytest.approx(reference.magnitude(), abs=bound)


@given(vectors(1.8))
def test_rotation_vector_there_and_back(rotation_vector):
    # |f| < 1.8 sqrt(3) < pi. Components of q carry a few eps; d(angle)/d(q) is at most 2.
    back = to_rotation_vector(from_rotation_vector(rotation_vector))
    np.testing.assert_allclose(back, rotation_vector, rtol=0, atol=16 * EPS)


@given(
    quaternions().filter(lambda q: abs(q[3]) > 1e-9),
    st.sampled_from([-1.0, 3.0, -1e-300, 1e-160, -1e49]),
)
def test_size_and_sign_of_a_quaternion_do_not_matter(q, factor):
    np.testing.assert_allclose(
        to_rotation_vector(factor * q), to_rotation_vector(q), rtol=0, atol=16 * EPS
    )


@pytest.mark.parametrize("scalar", [1e-310, 1e-200, 1.0, 1e50])
def test_no_rotation_is_the_zero_vector(scalar):
    np.testing.assert_array_equal(to_rotation_vector([0, 0, 0, scalar]), np.zeros(3))


@pytest.mark.parametrize("size", [1e-310, 1e-200, 1e-160, 1e-9])
def test_small_rotation_vector_is_twice_the_vector_part(size):
    np.testing.assert_allclose(to_rotation_vector([0, size, 0, 1]), [0, 2 * size, 0], rtol=4 * EPS)


@pytest.mark.parametrize("scalar", [0.0, -0.0, 1e-310, -1e-310])
def test_half_a_turn(scalar):
    assert rotation_angle([0, 3, 4, scalar]) == pytest.approx(np.pi, abs=4 * EPS)


def test_half_a_turn_is_about_the_vector_part_itself():
    half_turn = to_rotation_vector([0, 3, 4, 0])
    np.testing.assert_allclose(half_turn, np.pi * np.array([0, 0.6, 0.8]), rtol=4 * EPS)


@pytest.mark.parametrize("function", [to_rotation_vector, rotation_angle])
def test_zero_quaternion_is_refused(function):
    with pytest.raises(ValueError, match=r"^quaternion: expected nonzero quaternions, got a zero"):
        function([IDENTITY, np.zeros(4)])


# Around five the scan begins to cut into blocks; squares fill their blocks, their neighbours not.
@pytest.mark.parametrize("count", [1, 2, 4, 5, 6, 7, 9, 10, 35, 36, 37, 40, 1000])
def test_cumulative_product_is_the_loop(count):
    increments = random_quaternions(*[(), (2,), (2, 3)][count % 3], count, seed=count)
    product = IDENTITY
    products = cumulative_product(increments)
    assert products.shape == increments.shape
    for k in range(count):
        product = multiply(product, increments[..., k, :])
        np.testing.assert_allclose(products[..., k, :], product, rtol=0, atol=(k + 1) * PRODUCT)


def test_cumulative_product_of_a_long_row_is_the_one_of_extended_precision():
    # Each product errs by about eps in a random direction; about 2 sqrt(n) of them follow each
    # other, and what every block inherits from its predecessors adds up over sqrt(n) blocks.
    count = 40_000
    rows = from_rotation_vector(np.random.default_rng(3).normal(size=(count, 3)))
    exact = np.empty((count, 4), np.longdouble)
    product = IDENTITY.astype(np.longdouble)
    for i, (x, y, z, w) in enumerate(rows.astype(np.longdouble)):
        product = product @ np.array([[w, -z, y, -x], [z, w, -x, -y], [-y, x, w, -z], [x, y, z, w]])
        exact[i] = product
    if np.finfo(np.longdouble).eps == EPS:
        pytest.skip("this processor has no floating point numbers longer than double")
    np.testing.assert_allclose(cumulative_product(rows), exact, rtol=0, atol=10 * 200 * EPS)


def test_cumulative_product_needs_a_row():
    with pytest.raises(ValueError, match=r"expected shape \(\.\.\., n, 4\), got shape \(4,\)"):
        cumulative_product(IDENTITY)
