"""Rotating a vector by a quaternion, against SciPy's Rotation and the sandwich product."""

import numpy as np
import pytest
from hypothesis import given
from scipy.spatial.transform import Rotation

from driftlab.quaternion import (
    from_rotation_vector,
    rotate,
    to_matrix,
)
from support import EPS, IDENTITY, quaternions, vectors

# Vectors up to 10 in each component, so up to 17.4 long. Two cross products and three sums, each
# of numbers up to twice that long: some ten roundings. The norm of q is good to an eps, too.
BOUND = 20 * 17.4 * EPS


def test_quarter_turn_about_up_takes_east_to_north():
    quarter = np.sqrt(0.5) * np.array([0, 0, 1, 1])
    turned = rotate(quarter, np.eye(3))
    np.testing.assert_allclose(turned, [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], rtol=0, atol=4 * EPS)


def test_no_rotation_changes_nothing():
    vector = np.array([0.3, -1e50, 5e-300])
    np.testing.assert_array_equal(rotate(IDENTITY, vector), vector)


@pytest.mark.parametrize("norm", [1e-200, 0.999, 1.0, -2.0, 1e49])
@given(quaternions(), vectors())
def test_a_quaternion_of_any_norm_and_sign_is_scipys_rotation(norm, q, vector):
    """As one is that was written down with three decimals."""
    same = Rotation.from_quat(q)
    np.testing.assert_allclose(rotate(norm * q, vector), same.apply(vector), rtol=0, atol=BOUND)
    np.testing.assert_allclose(to_matrix(norm * q), same.as_matrix(), rtol=0, atol=20 * EPS)


@pytest.mark.parametrize("function", [lambda q: rotate(q, [1, 0, 0]), to_matrix])
def test_a_zero_quaternion_is_no_rotation(function):
    with pytest.raises(ValueError, match=r"^quaternion: expected nonzero quaternions, got a zero"):
        function([0, 0, 0, 0])


@given(vectors())
def test_axis_of_a_rotation_has_the_same_components_in_both_frames(rotation_vector):
    turned = rotate(from_rotation_vector(rotation_vector), rotation_vector)
    size = np.linalg.norm(rotation_vector)
    np.testing.assert_allclose(turned, rotation_vector, rtol=0, atol=8 * EPS * size)
