"""Signs of other books, each tested against matrices, SciPy and the book's own definitions."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.axes import _axes_rotation
from driftlab.calibration.body_axes import attitude_error as error_of_part_iii
from driftlab.conventions import (
    ATTITUDE_ERRORS,
    convert_attitude_error,
    mirror_heading,
    position_angle,
    scalar_first,
    scalar_last,
)
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.quaternion import from_rotation_vector, multiply, to_matrix
from driftlab.vectors import cross_matrix
from support import EPS, order_of, quaternions, random_quaternions

few = settings(max_examples=30)
small_errors = st.tuples(*[st.floats(-1e-3, 1e-3)] * 3).map(np.array)
definitions = st.sampled_from(list(ATTITUDE_ERRORS))


def computed_matrix(error, definition, attitude):
    """Computed matrix of an error, by the formula that the definition is stated with."""
    true, cross = to_matrix(attitude), cross_matrix(error)
    return {
        "phi": (np.eye(3) - cross) @ true,
        "titterton-weston": (np.eye(3) - cross) @ true,
        "groves": (np.eye(3) + cross) @ true,
        "larin": true @ (np.eye(3) + cross),
    }[definition]


@few
@given(small_errors, definitions, definitions, quaternions())
def test_every_definition_describes_the_same_computed_matrix(error, source, target, attitude):
    found = convert_attitude_error(error, source, target, attitude)
    np.testing.assert_allclose(
        computed_matrix(found, target, attitude),
        computed_matrix(error, source, attitude),
        rtol=0,
        atol=16 * EPS,
    )
    back = convert_attitude_error(found, target, source, attitude)
    np.testing.assert_allclose(back, error, rtol=0, atol=1e-3 * 16 * EPS)


def test_error_of_part_one_becomes_that_of_part_three():
    """Twice the vector part of Larin's quaternion, against the attitude error of chapter 10."""
    rate, bent, time = np.array([0.3, -0.2, 0.5]), np.array([[0, 2, 1], [1, 0, 3], [2, 1, 0]]), 4.0

    def gap(size):
        measured = rate + size * bent @ rate
        true = from_rotation_vector(rate * time)
        larin = 2 * error_quaternion(rate, measured, time)[:3]
        phi = convert_attitude_error(larin, "larin", "phi", true)
        return np.abs(phi - error_of_part_iii(from_rotation_vector(measured * time), true)).max()

    # The first order is equal; what is left is of the second at least.
    assert order_of(gap) > 1.9


def test_no_zero_gets_a_minus_sign():
    assert not np.signbit(convert_attitude_error(np.zeros(3), "groves", "phi")).any()


def local_axes(latitude, longitude):
    """Rows East, North, Up in Earth-centred axes, by SciPy."""
    return _axes_rotation("NED", "ENU") @ (
        Rotation.from_euler("ZY", [longitude, -latitude - np.pi / 2]).as_matrix().T
    )


def test_psi_and_phi_angles_differ_by_the_position_angle():
    latitude, longitude = 0.8, 0.4
    true = to_matrix(random_quaternions(seed=8))
    phi, step = np.array([0.7, -0.4, 0.5]), np.array([0.3, -0.6])

    def gap(size):
        change = local_axes(latitude + size * step[0], longitude + size * step[1])
        to_computer = change @ local_axes(latitude, longitude).T
        psi = size * phi - position_angle(latitude, *(size * step))
        # Both models describe one computed matrix.
        by_phi = Rotation.from_rotvec(-size * phi).as_matrix() @ true
        by_psi = Rotation.from_rotvec(-psi).as_matrix() @ to_computer @ true
        return np.abs(by_phi - by_psi).max()

    assert order_of(gap) > 1.9


def test_headings_are_mirrored_and_wrapped():
    degrees = np.array([0.0, 30.0, 90.0, 270.0, 350.0, -30.0])
    found = np.degrees(mirror_heading(np.radians(degrees)))
    np.testing.assert_allclose(found, [0, -30, -90, 90, 10, 30], rtol=0, atol=1e-12)
    np.testing.assert_allclose(mirror_heading(mirror_heading(0.3)), 0.3, rtol=0, atol=2 * EPS)


@few
@given(quaternions(), quaternions())
def test_scalar_first_and_last(first, second):
    np.testing.assert_array_equal(scalar_last(scalar_first(first)), first)
    assert scalar_first(first)[0] == first[3]
    # Hamilton's product written scalar first, by its textbook formula.
    (a, *u), (b, *v) = scalar_first(first), scalar_first(second)
    product = [a * b - np.dot(u, v), *(a * np.array(v) + b * np.array(u) + np.cross(u, v))]
    np.testing.assert_allclose(scalar_last(product), multiply(first, second), rtol=0, atol=16 * EPS)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("phi", "savage"), "target: expected one of phi, titterton-weston, groves, larin, got 's"),
        (("psi", "phi"), "source: expected one of phi"),
        (("larin", "phi"), "true_attitude: expected quaternions, as 'larin' and 'phi' have di"),
    ],
)
def test_unknown_definitions_are_refused(arguments, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        convert_attitude_error([0.0, 0.0, 1e-3], *arguments)
