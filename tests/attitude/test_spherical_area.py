"""Solid angles, and Goodman and Robinson's theorem on cones of any shape."""

import numpy as np
import pytest

from driftlab.attitude.coning_algorithms import Algorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.spherical_area import solid_angle
from driftlab.book.ch18_deep_end.experiments import closed_cone, swept_in_a_sample
from driftlab.motion.profiles import Coning
from driftlab.quaternion import rotate
from support import EPS, random_quaternions

PLAIN = Algorithm("plain", 1, 0, {}, "rotation vector", 2)


@pytest.mark.parametrize("seed", range(5))
def test_triangle_is_its_spherical_excess(seed):
    a, b, c = corners = np.random.default_rng(seed).normal(size=(3, 3))

    def angle(at, one, other):
        one, other = np.cross(at, one), np.cross(at, other)
        return np.arccos(one @ other / np.linalg.norm(one) / np.linalg.norm(other))

    excess = angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - np.pi
    found = solid_angle(corners)
    assert abs(found) == pytest.approx(excess, abs=1e-12)
    assert np.sign(found) == np.sign(np.linalg.det(corners))


def test_solid_angle_does_not_depend_on_axes_first_corner_or_length():
    corners = np.random.default_rng(1).normal(size=(7, 3))
    turned = rotate(random_quaternions(4, seed=2)[:, np.newaxis], corners)
    expected = solid_angle(corners)
    np.testing.assert_allclose(solid_angle(turned), expected, rtol=0, atol=100 * EPS)
    for other in (np.roll(corners, 3, axis=0), corners * np.arange(1.0, 8)[:, np.newaxis]):
        assert solid_angle(other) == pytest.approx(expected, abs=100 * EPS)
    assert solid_angle(corners[::-1]) == pytest.approx(-expected, abs=100 * EPS)


X, Y, Z = np.eye(3)


@pytest.mark.parametrize("shift", range(4))
def test_quarter_of_the_sphere_begun_at_any_corner(shift):
    """A lune, two of whose corners are opposite but no neighbours."""
    assert solid_angle(np.roll([X, Y, -X, Z], shift, axis=0)) == pytest.approx(np.pi, abs=8 * EPS)


@pytest.mark.parametrize("shift", range(9))
def test_a_way_along_the_edges_of_a_cube_leaves_three_faces(shift):
    """All eight corners, and the middle of the first face, which takes a quarter of it away."""
    up, down = [[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]], [1, 1, -1]
    way = [up[0], [0, 0, 1], *up[1:], *(np.array(corner) * down for corner in up[::-1])]
    face = 4 * np.pi / 6
    found = solid_angle(np.roll(way, shift, axis=0))
    # A sum of ten angles of up to half a turn.
    assert found == pytest.approx(3 * face - face / 4, abs=10 * 4 * EPS)


@pytest.mark.parametrize("near", [1e-4, 1e-8, 1e-12, 1e-15])
def test_corners_that_are_nearly_opposite_cost_no_digits(near):
    # Shifting a corner along the circle on which it lies changes no area.
    shifted = [X, Y, -X * np.cos(near) - Y * np.sin(near), Z]
    expected = np.pi + near  # the other edge of that corner turns about Z
    assert solid_angle(shifted) == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize("count", [3, 4, 5, 6, 8, 360, 361])
def test_equators_are_half_the_sphere(count):
    around = 2 * np.pi * np.arange(count) / count
    corners = np.stack([np.cos(around), np.sin(around), np.zeros(count)], axis=-1)
    turned = rotate(random_quaternions(20, seed=3)[:, np.newaxis], corners)
    np.testing.assert_allclose(np.abs(solid_angle(turned)), 2 * np.pi, rtol=0, atol=1e-12)


def test_neighbours_that_are_opposite_are_refused():
    with pytest.raises(ValueError, match=r"^directions: expected neighbours that one great circle"):
        solid_angle([X, -X, Y])


def test_fewer_than_three_directions_are_refused():
    with pytest.raises(ValueError, match=r"^directions: expected shape .* at least 3, got shape"):
        solid_angle(np.eye(3)[:2])


@pytest.mark.parametrize("frequency", [1.0, -1.0])
@pytest.mark.parametrize("half_angle", [0.01, 0.7, 1.5, 2.5])
def test_gyro_along_the_axis_sums_up_minus_the_cap(half_angle, frequency):
    motion = Coning(half_angle, frequency)
    cap = np.sign(frequency) * 2 * np.pi * (1 - np.cos(half_angle))
    assert motion.increments(1e-3, 1000)[:, 2].sum() == pytest.approx(-cap, abs=1e-12)
    axis = rotate(motion.attitude(np.arange(4096) / 4096), np.array([0.0, 0.0, 1.0]))
    # Great circles between the corners leave slivers: of the order of (2 pi/4096)^2.
    missing = np.remainder(solid_angle(axis) - cap + 2 * np.pi, 4 * np.pi) - 2 * np.pi
    assert abs(missing) < (2 * np.pi / 4096) ** 2 * 2 * np.pi


@pytest.mark.parametrize(
    "shape", [(0.4, 0.4), (0.2, 0.9), (1.2, 0.5), (2.5, 1.0), (0.5, 0.3, 2), (0.5, 0.3, 3)]
)
def test_gyro_and_solid_angle_cancel_on_a_cone_of_any_shape(shape):
    summed, area = closed_cone(*shape)
    left_over = np.remainder(summed + area + np.pi, 2 * np.pi) - np.pi
    assert abs(left_over) < 1e-6 * max(1.0, abs(summed))


@pytest.mark.parametrize("sample_angle", [0.05, 0.3, 1.0])
@pytest.mark.parametrize("degrees", [1.0, 20.0, 60.0, 85.0])
def test_drift_of_a_sample_is_the_area_swept_too_little(degrees, sample_angle):
    half_angle = np.radians(degrees)
    computed, true = swept_in_a_sample(half_angle, sample_angle)
    drift = coning_drift(PLAIN, half_angle, sample_angle / (2 * np.pi), 1.0)
    # Twenty nodes integrate an arc to rounding; that of the axis in the middle is 1/a times it.
    assert computed - true == pytest.approx(drift, abs=16 * EPS / half_angle)
