"""What the scenes of chapter 13 claim, in closed form."""

import numpy as np
import pytest
from scipy.constants import degree, hour

from driftlab.book.ch13_finding_north.experiments import (
    HEADING,
    MAGNIFIED,
    level_box,
    over_the_top,
)
from driftlab.book.ch13_finding_north.scenes.level_box import (
    BoxOnTheWayNorth,
    inside_parts,
)
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.quaternion import conjugate, multiply, rotation_angle
from driftlab.vectors import wrap_angle
from grouped import opened

DRIFT = 0.01 * degree / hour


@pytest.mark.parametrize("heading", [0.0, 0.7, -2.0])
def test_a_level_box_errs_by_the_formula(heading) -> None:
    bias = DRIFT * np.array([0.3, -0.5, 1.0])
    found = level_box(heading, bias)
    formula = alignment_errors(heading, 0.0, found.latitude, found.gyro_bias, np.zeros(3))
    # Second order: the square of the error of the level direction.
    bound = 2 * (DRIFT / (EARTH_RATE * np.cos(found.latitude))) ** 2
    assert np.all(np.abs(found.heading_error - formula.heading) < bound)


def test_found_north_lies_where_the_drawn_arrows_end() -> None:
    """The level part of the rate and the magnified error of the gyro add up to it."""
    data = level_box(0.4, DRIFT * np.array([0.0, 0.0, 1.0]))
    parts = inside_parts(data)
    level, error = (
        next(p.points for p in parts if (p.kind, p.style) == ("arrow", style))
        for style in ("gyro", "error")
    )
    needle = next(p.points for p in parts if (p.kind, p.style) == ("line", "ghost"))[:, 1]
    np.testing.assert_allclose(error[:, 0], level[:, 1], atol=1e-12)
    np.testing.assert_allclose(np.cross(error[:, 1], needle), 0.0, atol=1e-12)
    assert np.all(np.einsum("ni,ni->n", error[:, 1], needle) > 0)
    assert np.degrees(data.magnified_error[0]) > 0.9 * MAGNIFIED * np.degrees(data.heading_error[0])


def test_the_gyro_that_points_north_or_up_does_no_harm() -> None:
    for axis, heading in ((0, 0.0), (1, 0.3), (2, np.pi / 2)):
        assert np.abs(level_box(heading, DRIFT * np.eye(3)[axis]).heading_error).max() < 1e-9


def test_the_bow_is_dragged_to_where_the_hand_is() -> None:
    scene = opened(BoxOnTheWayNorth)
    scene.set(heading=30.0)
    # In the axes of the box, a quarter turn to the left is the direction -right.
    assert scene.dragged("bow", np.array([0.0, 0.0, -0.8]))["heading"] == pytest.approx(120.0)
    assert scene.dragged("bow", np.array([-0.8, 0.0, 1e-9]))["heading"] == pytest.approx(-150.0)


def test_over_the_top_the_angles_jump_and_the_attitude_does_not() -> None:
    run = over_the_top()
    up = run.angle < np.pi / 2
    for angle, before in ((run.true_heading, HEADING), (run.true_roll, 0.0)):
        after = wrap_angle(before + np.pi)
        np.testing.assert_allclose(wrap_angle(angle[up] - before), 0.0, atol=1e-9)
        np.testing.assert_allclose(wrap_angle(angle[~up] - after), 0.0, atol=1e-9)
    # The steps of a turn of half a degree each, nothing else.
    steps = rotation_angle(multiply(conjugate(run.attitude[:-1]), run.attitude[1:]))
    np.testing.assert_allclose(steps, np.radians(0.5), atol=1e-9)
    assert run.heading_error.max() > 50 * run.heading_error[0]
    assert run.attitude_error.max() < 1.5 * run.attitude_error.min()


@pytest.mark.parametrize("aside", [2.0, 30.0])
def test_past_the_zenith_the_heading_turns_smoothly(aside) -> None:
    """By the closed form of a bow on a leaning great circle."""
    run = over_the_top(0.0, np.radians(aside))
    forward = np.cos(run.angle)
    right = -np.sin(run.angle) * np.sin(np.radians(aside))
    np.testing.assert_allclose(
        np.abs(wrap_angle(run.true_heading)), np.arctan2(np.abs(right), forward), atol=1e-9
    )
    np.testing.assert_allclose(
        np.sin(run.true_pitch), np.sin(run.angle) * np.cos(np.radians(aside)), atol=1e-12
    )


def test_the_found_attitude_stays_as_near_as_the_large_errors_let_it() -> None:
    run = over_the_top()
    away = rotation_angle(multiply(run.found, conjugate(run.attitude)))
    assert np.degrees(away.max()) < 15
    assert np.ptp(away) < 0.5 * away.max()
