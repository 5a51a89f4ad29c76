"""Perelyaev & Chelnokov, section 1: the Cayley pair, its vectors, and their Riccati equations."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from scipy.stats import special_ortho_group

from driftlab.attitude.cayley import (
    cayley_transform,
    cayley_vector,
    rotation_quaternion,
    shadow,
    skew_operator,
)
from driftlab.attitude.riccati import integrate_riccati, riccati_rate
from driftlab.drift.error_kinematics import error_rate_matrix, rate_matrix
from driftlab.quaternion import from_rotation_vector, multiply, pure, right_matrix
from support import EPS, IDENTITY, directions, quaternions, random_quaternions, vectors

AXIS = np.array([2.0, -1.0, 2.0]) / 3
# Numbers below 2e-308 are multiples of 5e-324; what is left of their digits is not looked at.
TINY = 1e-300

whole_vectors = arrays(int, 3, elements=st.integers(-1000, 1000))
# Not the whole turn itself, where k is infinite.
short_of_a_turn = quaternions().filter(lambda q: q[3] > 0 or np.abs(q[:3]).max() > 1e-9)
both_dimensions = pytest.mark.parametrize("dimension", [4, 3])
every_size = pytest.mark.parametrize("size", [2, 3, 4, 5])


def turn(angle, axis=AXIS):
    """Quaternion of a rotation, its scalar part cos(angle/2) at any angle."""
    return np.append(np.sin(angle / 2) * axis, np.cos(angle / 2))


def exact_vector(quaternion, dimension):
    """k of a quaternion in enough digits for any cancellation, rounded once."""
    with mpmath.workdps(700):
        x, y, z, w = (mpmath.mpf(float(part)) for part in quaternion)
        norm = mpmath.sqrt(x**2 + y**2 + z**2 + w**2) if dimension == 4 else 0
        return np.array([float(-part / (norm + w)) for part in (x, y, z)])


def exact_quaternion(vector, dimension):
    """Unit quaternion of k in fifty digits, rounded once."""
    with mpmath.workdps(50):
        k = [mpmath.mpf(float(part)) for part in vector]
        square = sum(part**2 for part in k)
        if dimension == 3:
            norm = mpmath.sqrt(1 + square)
            return np.array([float(-part / norm) for part in k] + [float(1 / norm)])
        parts = [-2 * part / (1 + square) for part in k]
        return np.array([float(part) for part in [*parts, (1 - square) / (1 + square)]])


# The Cayley pair (1.2)


@given(vectors())
def test_1_2_skew_matrix_of_k_gives_matrix_of_the_quaternion(k):
    # I + k is a multiple of an orthogonal matrix: no digits are lost in its inverse.
    expected = right_matrix(rotation_quaternion(k))
    np.testing.assert_allclose(cayley_transform(skew_operator(k)), expected, rtol=0, atol=32 * EPS)


@given(quaternions().filter(lambda q: q[3] > -0.9))
def test_1_2_matrix_of_a_quaternion_gives_skew_matrix_of_k(q):
    k = cayley_vector(q)
    # The sum 1 + l0 = 2/(1 + |k|^2) is rounded, once, to half an eps.
    bound = 8 * (1 + k @ k) ** 1.5 * EPS
    np.testing.assert_allclose(
        cayley_transform(right_matrix(q)), skew_operator(k), rtol=0, atol=bound
    )


@given(directions(), st.floats(-3, 3))
def test_1_2_with_rotation_matrices_is_dimension_3(direction, angle):
    axis = direction / np.linalg.norm(direction)
    rotation = Rotation.from_rotvec(angle * axis)
    matrix = rotation.as_matrix()
    # I + C has singular values 2 and 2 cos(phi/2), at 3 rad 0.14: fourteen times the rounding, and
    # again as much because k itself is that large.
    bound = 8 * EPS / np.cos(angle / 2) ** 2
    k = -np.tan(angle / 2) * axis
    np.testing.assert_allclose(
        cayley_transform(skew_operator(k, 3)), matrix.T, rtol=0, atol=64 * EPS
    )
    np.testing.assert_allclose(
        cayley_transform(matrix.T), skew_operator(k, 3), rtol=0, atol=2 * bound
    )
    np.testing.assert_allclose(cayley_vector(rotation.as_quat(), 3), k, rtol=0, atol=bound)


@every_size
@given(data=st.data())
def test_1_2_is_its_own_inverse_on_skew_matrices(size, data):
    entries = data.draw(arrays(float, (size, size), elements=st.floats(-2, 2)))
    skew = entries - entries.T
    orthogonal = cayley_transform(skew)
    bound = 8 * size * EPS  # I + k has no singular value below 1
    square = 1 + np.linalg.norm(skew, 2) ** 2
    np.testing.assert_allclose(
        orthogonal @ orthogonal.T, np.eye(size), rtol=0, atol=bound * square**0.5
    )
    assert np.linalg.det(orthogonal) == pytest.approx(1, abs=bound * square**0.5)
    # On the way back, 2 (I + n)^-1 = I + k stands on either side of the error.
    np.testing.assert_allclose(cayley_transform(orthogonal), skew, rtol=0, atol=bound * square**1.5)


@every_size
def test_1_2_is_its_own_inverse_on_orthogonal_matrices(size):
    rotations = special_ortho_group.rvs(size, 50, random_state=np.random.default_rng(size))
    skew = cayley_transform(rotations)
    # The rotations are orthogonal to a few eps; (I + k)/2, the inverse of I + n, stands on either
    # side of that error, and on the way back a matrix no larger than 1.
    bound = 8 * size * EPS * (1 + np.linalg.norm(skew, 2, axis=(-2, -1), keepdims=True) ** 2)
    assert np.all(np.abs(skew + np.swapaxes(skew, -1, -2)) <= bound)
    assert np.all(np.abs(cayley_transform(skew) - rotations) <= bound)


@pytest.mark.parametrize(
    "matrix",
    [
        np.diag([1, -1, -1]),
        np.diag([1, 1, -1]),
        right_matrix([0, 0, 0, -1]),
        [[-1]],
        [np.eye(3), Rotation.from_rotvec(np.pi * AXIS).as_matrix()],
    ],
    ids=["half turn", "reflection", "whole turn", "one number", "one of several"],
)
def test_1_2_refuses_the_eigenvalue_minus_1(matrix):
    with pytest.raises(
        ValueError, match=r"^matrix: expected one without the eigenvalue -1, got I \+ X singular\.$"
    ):
        cayley_transform(matrix)


@pytest.mark.parametrize("shape", [(3,), (2, 3), (4, 3, 2)], ids=str)
def test_1_2_refuses_what_is_not_square(shape):
    with pytest.raises(ValueError, match=r"^matrix: expected shape \(\.\.\., n, n\), got shape \("):
        cayley_transform(np.ones(shape))


# The skew matrices


@given(whole_vectors)
def test_1_5_skew_matrix_is_that_of_a_rate_and_holds_the_one_of_dimension_3(vector):
    matrix = skew_operator(vector)
    np.testing.assert_array_equal(matrix, rate_matrix(vector))
    np.testing.assert_array_equal(matrix, -matrix.T)
    np.testing.assert_array_equal(skew_operator(vector, 3), matrix[:3, :3])


@given(whole_vectors, whole_vectors)
def test_skew_matrix_multiplies_from_the_right(vector, other):
    np.testing.assert_array_equal(
        skew_operator(vector) @ pure(other), multiply(pure(other), pure(vector))
    )
    np.testing.assert_array_equal(skew_operator(vector, 3) @ other, np.cross(other, vector))


@given(whole_vectors)
def test_square_of_k_is_a_number_in_dimension_4(k):
    """So every polynomial of k is of degree one, and k is singular only if it is zero."""
    matrix = skew_operator(k)
    np.testing.assert_array_equal(matrix @ matrix, -(k @ k) * np.eye(4))


def test_not_every_skew_matrix_of_dimension_4_is_so():
    """Larin's, of a measured rate as large as the true one, is singular and not zero."""
    rate, measured_rate = np.array([2, 3, 6]), np.array([-3, 6, 2])
    matrix = error_rate_matrix(rate, measured_rate)
    np.testing.assert_array_equal(matrix, -matrix.T)
    np.testing.assert_array_equal(matrix @ pure(rate + measured_rate), np.zeros(4))
    square = matrix @ matrix
    assert np.linalg.norm(square - np.trace(square) / 4 * np.eye(4)) > 1


# The vectors


@given(st.floats(-2 * np.pi, 2 * np.pi, exclude_min=True, exclude_max=True), directions())
def test_1_3_k_is_minus_the_tangent_of_a_quarter_of_the_angle(angle, direction):
    axis = direction / np.linalg.norm(direction)
    k = cayley_vector(turn(angle, axis))
    # The angle's rounding and that of its sine, at most 4 eps, and dk/dphi = (1 + |k|^2)/4.
    size = np.tan(angle / 4)
    np.testing.assert_allclose(
        k, -size * axis, rtol=8 * EPS, atol=TINY + 2 * (1 + size**2) * EPS * abs(angle)
    )


@given(short_of_a_turn)
def test_1_9_in_the_papers_own_letters(q):
    """k = (1 + lambda)^-1∘(1 - lambda), and (1.8) the same back."""
    k = cayley_vector(q)
    bound = 8 * (1 + k @ k) * EPS  # components of q and of k carry an eps of themselves
    np.testing.assert_allclose(multiply(IDENTITY + q, pure(k)), IDENTITY - q, rtol=0, atol=bound)
    np.testing.assert_allclose(
        multiply(IDENTITY + pure(k), q), IDENTITY - pure(k), rtol=0, atol=bound
    )


@given(short_of_a_turn.filter(lambda q: abs(q[3]) > 1e-12))
def test_shorter_of_k_and_its_shadow_is_minus_scipys_mrp(q):
    k = cayley_vector(q)
    reference = Rotation.from_quat(q).as_mrp()
    shorter = k if q[3] > 0 else shadow(k)
    # SciPy makes the quaternion, good to an eps or two, a unit one again.
    np.testing.assert_allclose(-shorter, reference, rtol=0, atol=8 * EPS)


@both_dimensions
@given(k=vectors(1e3))
def test_k_there_and_back(dimension, k):
    back = cayley_vector(rotation_quaternion(k, dimension), dimension)
    # The vector part is good to a few eps of itself, however small it is near the pole.
    np.testing.assert_allclose(back, k, rtol=16 * EPS, atol=TINY)


@both_dimensions
@given(q=short_of_a_turn.filter(lambda q: abs(q[3]) > 1e-9))
def test_rotation_there_and_back(dimension, q):
    back = rotation_quaternion(cayley_vector(q, dimension), dimension)
    expected = q if dimension == 4 or q[3] > 0 else -q
    np.testing.assert_allclose(back, expected, rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("part", [1e-3, 1e-9, 1e-50, 1e-155, 1e-160, 1e-200, 1e-300])
@pytest.mark.parametrize("scalar", [1.0, -1.0])
def test_k_keeps_its_digits_near_its_zero_and_its_pole(part, scalar):
    q = np.array([2 * part, -part, 3 * part, scalar])
    np.testing.assert_allclose(cayley_vector(q), exact_vector(q, 4), rtol=8 * EPS)


@pytest.mark.parametrize("scalar", [1e-3, -1e-9, 1e-50, -1e-300])
def test_dimension_3_keeps_its_digits_near_half_a_turn(scalar):
    q = np.array([0.6, -0.3, 0.2, scalar])
    np.testing.assert_allclose(cayley_vector(q, 3), exact_vector(q, 3), rtol=4 * EPS)


@both_dimensions
@pytest.mark.parametrize("size", [1e-310, 1e-160, 1e-9, 1.0, 1e9, 1e49])
def test_rotation_of_k_of_any_size_in_every_digit(dimension, size):
    k = size * np.array([2.0, -1.0, 3.0])
    quaternion = rotation_quaternion(k, dimension)
    expected = exact_quaternion(k, dimension)
    np.testing.assert_allclose(quaternion, expected, rtol=8 * EPS, atol=1e-323)
    assert np.linalg.norm(quaternion) == pytest.approx(1, abs=4 * EPS)


@both_dimensions
@given(factor=st.sampled_from([1e-300, 1e-160, 3.0, 1e49]))
def test_size_of_the_quaternion_does_not_matter(dimension, factor):
    q = random_quaternions(20)
    expected = cayley_vector(q, dimension)
    np.testing.assert_allclose(cayley_vector(factor * q, dimension), expected, rtol=16 * EPS)


@given(quaternions().filter(lambda q: np.linalg.norm(q[:3]) > 1e-3))
def test_sign_of_the_quaternion_counts_in_dimension_4_alone(q):
    k = cayley_vector(q)
    # Vector parts, and with them k, are good to a few eps of themselves.
    np.testing.assert_allclose(cayley_vector(-q), shadow(k), rtol=16 * EPS, atol=TINY)
    if abs(q[3]) > TINY:
        np.testing.assert_array_equal(cayley_vector(-q, 3), cayley_vector(q, 3))


@given(directions())
def test_shadow_is_the_same_rotation_by_a_whole_turn_less(k):
    other = shadow(k)
    np.testing.assert_allclose(shadow(other), k, rtol=16 * EPS, atol=TINY)
    np.testing.assert_allclose(
        rotation_quaternion(other), -rotation_quaternion(k), rtol=0, atol=16 * EPS
    )
    np.testing.assert_allclose(np.linalg.norm(other), 1 / np.linalg.norm(k), rtol=8 * EPS)


def test_vectors_that_are_infinite_are_refused():
    with pytest.raises(
        ValueError, match=r"^quaternion: expected no whole turn, where k is infinite\.$"
    ):
        cayley_vector([IDENTITY, -3 * IDENTITY])
    with pytest.raises(
        ValueError,
        match=r"^quaternion: expected no half turn, where k is infinite\.$",
    ):
        cayley_vector([IDENTITY, [0, 3, 4, 0]], dimension=3)
    with pytest.raises(ValueError, match=r"^vector: expected nonzero vectors, got a zero vector"):
        shadow([AXIS, np.zeros(3)])
    with pytest.raises(
        ValueError, match=r"^vector: expected vectors with a finite shadow, got one too short\.$"
    ):
        shadow([AXIS, 1e-310 * AXIS])


@both_dimensions
def test_zero_quaternion_is_refused(dimension):
    with pytest.raises(ValueError, match=r"^quaternion: expected nonzero quaternions, got a zero"):
        cayley_vector([IDENTITY, np.zeros(4)], dimension)


# The Riccati equations


@both_dimensions
@given(k=whole_vectors, rate=whole_vectors)
def test_1_4_in_matrices(dimension, k, rate):
    """Whole numbers, so that both sides are exact."""
    operator, omega = skew_operator(k, dimension), skew_operator(rate, dimension)
    unit, factor = np.eye(dimension), {4: 4, 3: 2}[dimension]
    derivative = factor * skew_operator(riccati_rate(k, rate, dimension), dimension)
    np.testing.assert_array_equal(
        derivative, operator @ omega @ operator + omega @ operator - operator @ omega - omega
    )
    np.testing.assert_array_equal(derivative, -(unit + operator) @ omega @ (unit - operator))


@given(whole_vectors, whole_vectors)
def test_1_10_in_quaternions(k, rate):
    derivative = pure(4 * riccati_rate(k, rate))
    outer = multiply(multiply(IDENTITY - pure(k), pure(rate)), IDENTITY + pure(k))
    np.testing.assert_array_equal(derivative, -outer)


@given(whole_vectors, whole_vectors)
def test_1_6_and_1_7_in_components(k, rate):
    f, f0 = np.cross(rate, k), -(rate @ k)
    np.testing.assert_array_equal(
        4 * riccati_rate(k, rate), f0 * k - np.cross(f + 2 * rate, k) - rate
    )
    assert f @ k == 0


@both_dimensions
@given(q=quaternions().filter(lambda q: q[3] > 0.3), rate=vectors(1))
def test_rate_is_the_derivative_of_k_along_the_exact_motion(dimension, q, rate):
    def k(time):
        return cayley_vector(multiply(q, from_rotation_vector(time * rate)), dimension)

    # Five points. Left out: h^4/30 times the fifth derivative of a tangent of the angle over 4 or
    # 2 at rates below 2 rad/s, where |k| is up to 0.75 or 3.2: below 10 or 1e5. Rounding:
    # differences of numbers up to 4, each good to 16 eps, over h.
    h = 2.0**-10
    slope = (8 * (k(h) - k(-h)) - (k(2 * h) - k(-2 * h))) / (12 * h)
    bound = h**4 / 30 * (10 if dimension == 4 else 1e5) + 64 * EPS / h
    np.testing.assert_allclose(riccati_rate(k(0), rate, dimension), slope, rtol=0, atol=bound)


# Integration of (1.10)


def tumbling(time):
    """A rate without a fixed axis, below 4 rad/s, that passes half a turn ten times in 20 s."""
    return np.array([2 * np.cos(time), 1.5 * np.sin(0.7 * time), 2.5 + 0.5 * np.cos(2 * time)])


def reference(rate, end):
    """Quaternion equation, integrated independently; a function of time."""
    answer = solve_ivp(
        lambda time, q: 0.5 * right_matrix(pure(rate(time))) @ q,
        (0, end),
        IDENTITY,
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        dense_output=True,
    )
    return lambda times: answer.sol(times).T


TIMES = np.linspace(0, 20, 401)


@pytest.fixture(scope="module")
def exact():
    return reference(tumbling, 20)


@pytest.fixture(scope="module")
def tumbled():
    return integrate_riccati(tumbling, TIMES)


# The integrator errs by about its tolerance, 1e-10, a step, and takes some 200 steps.
INTEGRATED = 2e-8

# Length of k at which it gives way to its shadow, and the scalar part there.
SWITCH = 1.2
SWITCH_SCALAR = (1 - SWITCH**2) / (1 + SWITCH**2)


@pytest.mark.parametrize("shadow_switch", [True, False])
def test_riccati_gives_the_attitude_of_the_quaternion_equation(exact, shadow_switch):
    solution = integrate_riccati(tumbling, TIMES, shadow_switch=shadow_switch)
    np.testing.assert_array_equal(solution.time, TIMES)
    # Signs included. Without the switch |k| grows to 12, and no error of k gives one of the
    # attitude of more than twice its size.
    np.testing.assert_allclose(solution.attitude, exact(TIMES), rtol=0, atol=INTEGRATED)
    # Continuous: no step is longer than half the rate allows in 0.05 s.
    assert np.linalg.norm(np.diff(solution.attitude, axis=0), axis=-1).max() < 4 / 2 * 0.05
    assert len(solution.switches) == (10 if shadow_switch else 0)


def test_vector_is_that_of_the_attitude_or_its_shadow(tumbled):
    switched = np.searchsorted(tumbled.switches, TIMES, side="left") % 2
    signs = 1 - 2 * switched[:, np.newaxis]
    np.testing.assert_array_equal(tumbled.attitude, signs * rotation_quaternion(tumbled.vector))


def test_switches_are_where_the_vector_is_a_fifth_longer_than_its_shadow_may_be(exact, tumbled):
    times = np.linspace(0, 20, 20001)
    expected, side = [], 1
    for time, scalar in zip(times, exact(times)[:, 3], strict=True):
        if side * scalar < SWITCH_SCALAR:
            expected.append(time)
            side = -side
    # The grid is of 1 ms; each switch is within the last step of it.
    np.testing.assert_allclose(tumbled.switches, np.array(expected) - 5e-4, rtol=0, atol=5.1e-4)
    scalars = np.abs(exact(tumbled.switches)[:, 3])
    np.testing.assert_allclose(scalars, -SWITCH_SCALAR, rtol=0, atol=INTEGRATED)


def test_smaller_tolerance_takes_more_evaluations_and_errs_less(exact):
    times = TIMES[::50]  # steps are no longer than the gaps
    rough, fine = (
        integrate_riccati(tumbling, times, tolerance=tolerance) for tolerance in (1e-5, 1e-12)
    )
    errors = [np.abs(answer.attitude - exact(times)).max() for answer in (rough, fine)]
    assert rough.evaluations < fine.evaluations
    # A hundred steps of 1e-5 at least, and some three hundred of 1e-12.
    assert 1e-6 < errors[0] < 1e-2
    assert errors[1] < 1e-9


def test_without_the_switch_it_ends_before_a_whole_turn():
    """About a fixed axis, where |k| = tan(phi/4) is a million 4e-6 before a whole turn."""
    times = np.linspace(0, 9, 901)
    solution = integrate_riccati(lambda time: AXIS, times, shadow_switch=False)
    np.testing.assert_array_equal(solution.time[:-1], times[times < 2 * np.pi])
    assert solution.time[-1] == pytest.approx(4 * np.arctan(1e6), abs=INTEGRATED)
    assert np.linalg.norm(solution.vector[-1]) == pytest.approx(1e6, rel=1e-6)
    assert len(solution.vector) == len(solution.attitude) == len(solution.time)
    assert len(solution.switches) == 0
    # The arc tangent divides errors of k by 1 + |k|^2 again.
    angles = -4 * np.arctan(solution.vector @ AXIS)
    np.testing.assert_allclose(angles, solution.time, rtol=0, atol=INTEGRATED)
    turned = from_rotation_vector(solution.time[:, np.newaxis] * AXIS)
    np.testing.assert_allclose(solution.attitude, turned, rtol=0, atol=INTEGRATED)


@pytest.mark.parametrize("turns", [0.4, 1.0, 7.3])
def test_with_the_switch_whole_turns_are_nothing_special(turns):
    times = np.linspace(0, 2 * np.pi * turns, 50)
    solution = integrate_riccati(lambda time: AXIS, times)
    expected = from_rotation_vector(times[:, np.newaxis] * AXIS)
    np.testing.assert_allclose(solution.attitude, expected, rtol=0, atol=INTEGRATED)
    expected = 4 * np.arctan(SWITCH) + 2 * np.pi * np.arange(round(turns))
    np.testing.assert_allclose(solution.switches, expected, rtol=0, atol=INTEGRATED)


@pytest.mark.parametrize(
    "times",
    [[0, 1, 1], [1, 0], [0], 3.0, [[0, 1], [2, 3]]],
    ids=["repeated", "falling", "single", "number", "table"],
)
def test_times_that_do_not_increase_are_refused(times):
    with pytest.raises(
        ValueError, match=r"^times: expected at least two increasing times \(m,\), got "
    ):
        integrate_riccati(tumbling, times)


def test_integration_that_fails_says_so():
    """The rate tan(t) has no integral beyond pi/2."""
    with pytest.raises(RuntimeError, match=r"^The integration after 1\.\d+ s failed: "):
        integrate_riccati(lambda time: np.tan(time) * AXIS, [0, 1, 2, 3], tolerance=1e-3)


def test_short_turn_within_a_long_rest_is_seen():
    """Steps are no longer than the widest gap of the times."""
    times = np.linspace(0, 100, 101)
    solution = integrate_riccati(
        lambda time: (1 - np.cos(2 * np.pi * time)) * AXIS if 70 < time < 71 else 0 * AXIS, times
    )
    expected = from_rotation_vector(np.where(times < 70.5, 0.0, 1.0)[:, np.newaxis] * AXIS)
    np.testing.assert_allclose(solution.attitude, expected, rtol=0, atol=INTEGRATED)


# A body that turns by just half a turn and rests there, as on a turn table; and one that rests just
# where k gives way to its shadow. Whether |k| ends above, at or below the limit is a matter of
# rounding, so many durations are tried. Steps that lead out of a rest are long and see little of
# the turn that begins in them: 3e-6 was seen to be lost.
AFTER_REST = 1e-4


def turn_and_rest(angle, duration, then):
    """Rate of a turn in `duration`, a rest as long, and `then` times the same turn."""
    calls = 0

    def rate(time):
        nonlocal calls
        calls += 1
        # Three turns or rests of some hundred calls each.
        assert calls < 5000, "the integration does not come to an end"
        place, phase = divmod(time / duration, 1)
        times = (1, 0, then)[int(place)] if place < 3 else 0
        return times * angle / duration * (1 - np.cos(2 * np.pi * phase)) * AXIS

    return rate


@pytest.mark.parametrize("angle", [np.pi, 4 * np.arctan(SWITCH)], ids=["half turn", "switch"])
@pytest.mark.parametrize("then", [-1, 1])
def test_rest_where_rounding_decides(angle, then):
    for duration in np.linspace(0.3, 2.9, 6):
        times = duration * np.array([0, 1, 2, 2.5, 3])
        solution = integrate_riccati(turn_and_rest(angle, duration, then), times)
        np.testing.assert_array_equal(solution.time, times)
        angles = angle * np.array([0, 1, 1, 1 + then / 2, 1 + then])
        expected = from_rotation_vector(np.outer(angles, AXIS))
        np.testing.assert_allclose(solution.attitude, expected, rtol=0, atol=AFTER_REST)
        assert np.linalg.norm(solution.vector, axis=-1).max() <= SWITCH + INTEGRATED


@given(st.floats(-3.14, 3.14), directions())
def test_dimension_3_is_minus_the_tangent_of_half_the_angle(angle, direction):
    axis = direction / np.linalg.norm(direction)
    size = np.tan(angle / 2)
    np.testing.assert_allclose(
        cayley_vector(turn(angle, axis), 3),
        -size * axis,
        rtol=8 * EPS,
        atol=TINY + 2 * (1 + size**2) * EPS * abs(angle),
    )


def test_quaternion_matrix_of_half_a_turn_is_no_exception():
    np.testing.assert_array_equal(
        cayley_transform(right_matrix([1, 0, 0, 0])), skew_operator([-1, 0, 0])
    )


@pytest.mark.parametrize("angle", [0.1, 3.0, np.pi, 6.0])
def test_shadow_belongs_to_the_angle_less_a_turn(angle):
    k = -np.tan(angle / 4) * AXIS
    expected = -np.tan((angle - 2 * np.pi) / 4) * AXIS
    # Quarter angles up to pi/2, good to an eps, and d tan = 1 + tan^2; the shadow divides by tan^2.
    np.testing.assert_allclose(
        shadow(k), expected, rtol=0, atol=4 * (1 + 1 / np.tan(angle / 4) ** 2) * EPS
    )
