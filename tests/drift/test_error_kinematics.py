"""Larin, section 1: the matrices of the paper, the error equation, and its exact solution."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from driftlab.drift.error_kinematics import (
    error_composition_matrix,
    error_quaternion,
    error_rate_matrix,
    rate_matrix,
)
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    left_matrix,
    multiply,
    pure,
    right_matrix as right,
    to_rotation_vector,
)
from support import EPS, IDENTITY, matrices, quaternions, vectors

RATE = np.array([0.7, -1.1, 0.4])
MEASURED = np.array([0.72, -1.13, 0.37])

integer_rates = arrays(int, 3, elements=st.integers(-1000, 1000))


def exact_error(rate, measured_rate, time):
    """exp(Omega_e t/2) [0, 0, 0, 1] in forty digits, rounded once."""
    with mpmath.workdps(40):
        matrix = mpmath.matrix(error_rate_matrix(rate, measured_rate).tolist())
        column = mpmath.expm(matrix * mpmath.mpf(time) / 2)[:, 3]
        return np.array([float(x) for x in column])


@given(integer_rates)
def test_1_1_matrix_of_the_paper(rate):
    w1, w2, w3 = rate
    expected = [[0, w3, -w2, w1], [-w3, 0, w1, w2], [w2, -w1, 0, w3], [-w1, -w2, -w3, 0]]
    np.testing.assert_array_equal(rate_matrix(rate), expected)


@given(arrays(int, 4, elements=st.integers(-1000, 1000)))
def test_1_3_matrix_of_the_paper(attitude):
    l1, l2, l3, l0 = attitude
    expected = [[l0, l3, -l2, -l1], [-l3, l0, l1, -l2], [l2, -l1, l0, -l3], [l1, l2, l3, l0]]
    np.testing.assert_array_equal(error_composition_matrix(attitude), expected)


@given(integer_rates, integer_rates)
def test_1_4_matrix_of_the_paper(rate, measured_rate):
    (w1, w2, w3), (wx, wy, wz) = rate, measured_rate
    expected = [
        [0, wz + w3, -(wy + w2), wx - w1],
        [-(wz + w3), 0, wx + w1, wy - w2],
        [wy + w2, -(wx + w1), 0, wz - w3],
        [-(wx - w1), -(wy - w2), -(wz - w3), 0],
    ]
    np.testing.assert_array_equal(error_rate_matrix(rate, measured_rate), expected)


@given(quaternions(), quaternions())
def test_1_3_is_the_rotation_from_body_to_apparent_frame(attitude, apparent):
    error = error_composition_matrix(attitude) @ apparent
    np.testing.assert_allclose(multiply(attitude, error), apparent, rtol=0, atol=16 * EPS)


def test_1_4_follows_from_1_1_to_1_3_for_changing_rates():
    """Three differential equations, integrated independently, and (1.3) between their answers."""

    def rates(time):
        true = np.array([np.sin(time), 0.5 * np.cos(2 * time), 0.3 * time])
        return true, true + 0.1 * np.array([np.cos(3 * time), time, -1])

    def derivative(time, state):
        attitude, apparent, error = state.reshape(3, 4)
        true, measured = rates(time)
        return 0.5 * np.concatenate(
            [
                rate_matrix(true) @ attitude,
                rate_matrix(measured) @ apparent,
                error_rate_matrix(true, measured) @ error,
            ]
        )

    start = np.tile(IDENTITY, 3)
    answer = solve_ivp(derivative, (0, 4), start, method="DOP853", rtol=1e-12, atol=1e-13)
    attitude, apparent, error = answer.y[:, -1].reshape(3, 4)
    assert np.linalg.norm(error[:3]) > 0.1  # there is an error to speak of
    # Global error: some hundred steps of 1e-12 each.
    composed = error_composition_matrix(attitude) @ apparent
    np.testing.assert_allclose(error, composed, rtol=0, atol=1e-10)


@given(integer_rates, integer_rates)
def test_halves_of_omega_e_commute(rate, measured_rate):
    """Integers, so that both products are exact."""
    first, second = right(pure(measured_rate)), left_matrix(pure(rate))
    np.testing.assert_array_equal(error_rate_matrix(rate, measured_rate), first - second)
    np.testing.assert_array_equal(first @ second, second @ first)


# Norms of Omega t/2 and of Omega_e t/2 below 4.2 from here on: expm is then one Pade approximant
# of degree 13, without squarings that would double its error.
@given(vectors(1), st.floats(-1, 1))
def test_attitude_solves_1_1(rate, time):
    expected = expm(0.5 * time * rate_matrix(rate)) @ IDENTITY
    np.testing.assert_allclose(from_rotation_vector(rate * time), expected, rtol=0, atol=64 * EPS)


@given(vectors(1), vectors(1), st.floats(-1, 1))
def test_error_is_exact_in_two_ways(rate, measured_rate, time):
    error = error_quaternion(rate, measured_rate, time)
    true, apparent = (from_rotation_vector(each * time) for each in (rate, measured_rate))
    # Half angles below 1, rounded to a relative 2 eps.
    np.testing.assert_allclose(error, multiply(conjugate(true), apparent), rtol=0, atol=16 * EPS)
    exponential = expm(0.5 * time * error_rate_matrix(rate, measured_rate)) @ IDENTITY
    np.testing.assert_allclose(error, exponential, rtol=0, atol=64 * EPS)


@pytest.mark.parametrize("time", [-1.0, 0.0, 1e-9, 1.0, 100.0])
def test_error_in_every_digit(time):
    expected = exact_error(RATE, MEASURED, time)
    # Two half angles of about 0.7 |t|, each rounded to a relative 2 eps.
    bound = (4 + 3 * abs(time)) * EPS
    actual = error_quaternion(RATE, MEASURED, time)
    np.testing.assert_allclose(actual, expected, rtol=0, atol=bound)


@given(vectors(), st.floats(-10, 10))
def test_perfect_triad_has_no_error(rate, time):
    error = error_quaternion(rate, rate, time)
    np.testing.assert_allclose(error, IDENTITY, rtol=0, atol=16 * EPS)


def test_angle_of_a_billion_radians():
    error = error_quaternion(RATE, MEASURED, 1e9)
    assert np.linalg.norm(error) == pytest.approx(1, abs=8 * EPS)
    # Only the angles' own rounding, 1e9 eps, is lost.
    true, apparent = (from_rotation_vector(1e9 * each) for each in (RATE, MEASURED))
    expected = conjugate(true) @ right(apparent).T
    np.testing.assert_allclose(error, expected, rtol=0, atol=8e9 * EPS)


@given(matrices(0.3), st.floats(0.1, 3))
def test_triad_matrix_follows_from_the_error_at_any_one_time(error_matrix, time):
    """Larin, section 1: (1.4) and (1.5) may serve to find A from the error at all times."""
    triad = np.eye(3) + error_matrix
    rates = np.array([[0.3, 0.1, -0.2], [-0.1, 0.4, 0.2], [0.2, 0.1, 0.5]])
    errors = error_quaternion(rates, rates @ triad.T, time)
    # The apparent attitude is the true one times the error, and turns at the measured rate.
    apparent = multiply(from_rotation_vector(rates * time), errors)
    measured = to_rotation_vector(apparent) / time
    np.testing.assert_allclose(np.linalg.solve(rates, measured).T, triad, rtol=0, atol=500 * EPS)


@given(vectors(), vectors())
def test_no_time_no_error(rate, measured_rate):
    np.testing.assert_array_equal(error_quaternion(rate, measured_rate, 0), IDENTITY)
