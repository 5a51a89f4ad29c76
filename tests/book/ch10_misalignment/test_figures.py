"""The figures of chapter 10: the parts of a triad's errors, body axes, equivalent starts."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from driftlab.body_frames import misalignment_vector
from driftlab.book.ch10_misalignment.experiments import (
    SCHEME,
    error_matrix_parts,
    plane_body_axes,
    plane_split,
)
from driftlab.book.ch10_misalignment.figures.split_triad import exaggeration
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.imu import TYPICAL_ERRORS
from driftlab.vectors import cross_matrix
from published import published
from support import EPS


def test_split_triad_shows_the_whole_and_its_parts() -> None:
    data = error_matrix_parts(TYPICAL_ERRORS.gyro_error_matrix)
    np.testing.assert_allclose(data.parts[0], TYPICAL_ERRORS.gyro_error_matrix, rtol=0, atol=0)
    bound = 4 * EPS * np.abs(data.parts[0]).max()  # halves of sums, added up again
    np.testing.assert_allclose(data.parts[1:].sum(axis=0), data.parts[0], rtol=0, atol=bound)
    np.testing.assert_allclose(data.parts[3], cross_matrix(data.vector), rtol=0, atol=bound)


@given(st.floats(1e-6, 10.0))
def test_leans_are_drawn_as_large_as_the_panel_lets_them(largest: float) -> None:
    data = error_matrix_parts(largest * np.eye(3)[[1, 2, 0]])
    factor = exaggeration(data)
    assert factor <= 600
    assert factor == 600 or 0.2 < factor * largest <= 0.6


@given(st.floats(-0.7, 0.7), st.floats(-0.7, 0.7))
def test_plane_split_is_a_common_turn_and_an_opposite_one(x: float, y: float) -> None:
    """Wu (43): theta_x = eta + mu, theta_y = eta - mu."""
    split = plane_split((x, y))
    np.testing.assert_array_equal(split.whole, [x, y])
    np.testing.assert_allclose(split.misalignment, (x + y) / 2, rtol=0, atol=1e-15)
    np.testing.assert_allclose(
        split.non_orthogonality, [(x - y) / 2, (y - x) / 2], rtol=0, atol=1e-15
    )


# Farther apart than a right angle the two are left-handed.
@given(st.floats(-0.7, 0.7), st.floats(-0.7, 0.7))
def test_plane_axes_turn_by_the_mean_angle(x: float, y: float) -> None:
    """Wu (44), for angles of any size."""
    data = plane_body_axes((x, y))
    assert data.averaged == pytest.approx((x + y) / 2, abs=1e-12)
    assert data.usual == pytest.approx(x, abs=1e-12)


@published("10-equivalent-start")
def test_equivalent_start_is_of_second_order_and_exact_for_a_rotation(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    _, symmetric, skew, derivative = data.attitude_error
    assert symmetric[-1] > 10 * skew.max()
    # The total derivative, to first order: the square of some 40 arc seconds, times the turns.
    np.testing.assert_allclose(skew, derivative, rtol=0, atol=2e-7)
    large = data.size > 1e-4
    for left in (data.skew_triad[large], data.two_skew_triads[large]):
        slope = np.polyfit(np.log(data.size[large]), np.log(left), 1)[0]
        assert slope == pytest.approx(2, abs=0.05)
    assert data.turned_triad.max() < 1e-12
    gyros, accelerometers, both, both_and_start = data.velocity_error
    # What the first order leaves over is a tilt of the size squared, and as much times pi/4 again
    # for each quarter turn; gravity makes a velocity of it.
    square = np.sum(misalignment_vector(TYPICAL_ERRORS.gyro_error_matrix) ** 2)
    tilt = square * (1 + np.pi / 4 * len(SCHEME.turns))
    assert both_and_start.max() < 9.81 * tilt * data.time[-1]
    assert min(gyros.max(), accelerometers.max(), both.max()) > 100 * both_and_start.max()
