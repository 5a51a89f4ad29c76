"""Every step formula against the matrix function it is named after, and its leading error."""

from math import factorial

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from driftlab.drift.error_kinematics import rate_matrix
from driftlab.drift.step_formulas import STEP_FORMULAS
from driftlab.quaternion import from_rotation_vector, rotation_angle
from support import EPS, IDENTITY, directions, same_rotation, vectors

every_formula = pytest.mark.parametrize("name", STEP_FORMULAS)
quarter_turns = vectors(0.9)  # |f| up to pi/2


def cross_matrix(f):
    """X with X v = f x v, so that exp(X) rotates by f."""
    x, y, z = f
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def pade(x, degree):
    """Diagonal Pade approximant of exp(x); degree 1 is the Cayley transform."""
    squares = x @ x / 12 if degree == 2 else 0
    return np.linalg.solve(np.eye(len(x)) - x / 2 + squares, np.eye(len(x)) + x / 2 + squares)


def taylor(x, degree):
    return sum(np.linalg.matrix_power(x, k) / factorial(k) for k in range(degree + 1))


def runge_kutta(derivative, start):
    """The classical method, one step of length 1."""
    k1 = derivative(start)
    k2 = derivative(start + k1 / 2)
    k3 = derivative(start + k2 / 2)
    k4 = derivative(start + k3)
    return start + (k1 + 2 * k2 + 2 * k3 + k4) / 6


def kutta_merson(derivative, start):
    """Merson's five stages, one step of length 1."""
    k1 = derivative(start)
    k2 = derivative(start + k1 / 3)
    k3 = derivative(start + (k1 + k2) / 6)
    k4 = derivative(start + (k1 + 3 * k3) / 8)
    k5 = derivative(start + (k1 - 3 * k3 + 4 * k4) / 2)
    return start + (k1 + 4 * k4 + k5) / 6


def half(f):
    """Omega/2 of a step of length 1, whose exponential is the exact step."""
    return 0.5 * rate_matrix(f)


def from_matrix(matrix):
    return Rotation.from_matrix(matrix).as_quat()


REFERENCES = {
    "exact": lambda f: expm(half(f)) @ IDENTITY,
    "taylor-1": lambda f: taylor(half(f), 1) @ IDENTITY,
    "taylor-2": lambda f: taylor(half(f), 2) @ IDENTITY,
    "taylor-3": lambda f: taylor(half(f), 3) @ IDENTITY,
    "taylor-4": lambda f: taylor(half(f), 4) @ IDENTITY,
    "kutta-merson": lambda f: kutta_merson(lambda q: half(f) @ q, IDENTITY),
    "cayley": lambda f: pade(half(f), 1) @ IDENTITY,
    "pade": lambda f: from_matrix(pade(cross_matrix(f), 2)),
    "pade-half": lambda f: pade(half(f), 2) @ IDENTITY,
}


def normalised(quaternion):
    return quaternion / np.linalg.norm(quaternion)


def test_every_formula_has_a_reference():
    assert REFERENCES.keys() == STEP_FORMULAS.keys()


@every_formula
@given(f=quarter_turns)
def test_step_is_what_its_name_says(name, f):
    # Matrices of norm up to 2, solved or exponentiated, and normalised: some tens of roundings.
    step, expected = normalised(STEP_FORMULAS[name](f)), normalised(REFERENCES[name](f))
    assert same_rotation(step, expected, 64 * EPS)


@given(quarter_turns)
def test_taylor_1_is_the_cayley_transform_of_the_rotation_matrix(f):
    step = normalised(STEP_FORMULAS["taylor-1"](f))
    assert same_rotation(step, from_matrix(pade(cross_matrix(f), 1)), 64 * EPS)


@given(quarter_turns)
def test_taylor_4_is_the_classical_runge_kutta_step(f):
    step = runge_kutta(lambda quaternion: half(f) @ quaternion, IDENTITY)
    np.testing.assert_allclose(STEP_FORMULAS["taylor-4"](f), step, rtol=0, atol=8 * EPS)


@every_formula
@given(f=directions(), angle=st.floats(1e-3, 1))
def test_axis_is_kept(name, f, angle):
    axis = f / np.linalg.norm(f)
    vector = STEP_FORMULAS[name](angle * axis)[:3]
    np.testing.assert_allclose(vector / np.linalg.norm(vector), axis, rtol=0, atol=8 * EPS)


@pytest.mark.parametrize(
    ("name", "power", "divisor"),
    [
        # From tan(phi/2) = phi/2 + phi^3/24 + phi^5/240 + ... and the formula's own series.
        ("taylor-1", 3, -12),
        ("taylor-2", 3, 24),
        ("taylor-3", 5, 480),
        ("taylor-4", 5, -1920),
        ("kutta-merson", 5, -11520),
        ("cayley", 3, -48),
        ("pade", 5, -720),
        ("pade-half", 5, -11520),
    ],
)
def test_leading_angle_error_of_a_step(name, power, divisor):
    p = 0.1
    error = rotation_angle(STEP_FORMULAS[name]([0, 0, p])) - p
    # What follows is smaller by a multiple of p^2 below 1.
    np.testing.assert_allclose(error, p**power / divisor, rtol=p**2)


def test_exact_step_is_the_exponential_itself():
    assert STEP_FORMULAS["exact"] is from_rotation_vector


@every_formula
def test_no_rotation_is_the_identity(name):
    np.testing.assert_array_equal(STEP_FORMULAS[name](np.zeros(3)), IDENTITY)


def test_formulas_cannot_be_replaced():
    with pytest.raises(TypeError, match="does not support item assignment"):
        STEP_FORMULAS["exact"] = None
