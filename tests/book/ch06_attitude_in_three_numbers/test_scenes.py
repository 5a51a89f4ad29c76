"""The scene of chapter 06: the lamp throws the package's vectors, and steps over where it does."""

import numpy as np
import pytest

from driftlab.attitude import integrate_riccati
from driftlab.attitude.riccati import SWITCH
from driftlab.book.ch06_attitude_in_three_numbers.experiments import shadow_steps
from driftlab.book.ch06_attitude_in_three_numbers.scenes import LAMP, ray

AXIS = np.array([2.0, -1.0, 2.0]) / 3


def test_heights_are_the_tangent_of_a_quarter_and_the_shadow_its_inverse() -> None:
    data = shadow_steps(AXIS)
    quarter = data.angle / 4
    with np.errstate(divide="ignore", invalid="ignore"):
        right = np.tan(quarter), -1 / np.tan(quarter)
    for row, formula in zip(data.heights, right, strict=True):
        known = np.isfinite(row)
        assert (~known).sum() in (1, 2)  # a whole turn; none and two
        np.testing.assert_allclose(row[known], formula[known], rtol=1e-9, atol=1e-12)


def test_the_riccati_equation_is_followed_and_stepped_over_at_the_same_angles() -> None:
    data = shadow_steps(AXIS)
    few = slice(None, None, 10)
    found = integrate_riccati(lambda _: AXIS, data.angle[few])
    np.testing.assert_allclose(found.switches, data.steps, rtol=1e-8)
    heights = data.heights[data.used, np.arange(len(data.used))]
    np.testing.assert_allclose(found.vector, -np.outer(heights, AXIS)[few], atol=1e-8)
    np.testing.assert_allclose(found.attitude, data.attitude[few], atol=1e-8)


@pytest.mark.parametrize("switch", [1.0, SWITCH, 3.0])
def test_the_vector_in_use_is_never_longer_than_the_switch(switch: float) -> None:
    data = shadow_steps(AXIS, switch)
    assert data.in_use.max() <= switch
    at = data.angle[1:][np.diff(data.used) != 0]
    step = data.angle[1]
    assert np.all((at >= data.steps - 1e-9) & (at <= data.steps + step + 1e-9))


def test_without_a_switch_it_becomes_infinite() -> None:
    data = shadow_steps(AXIS, np.inf)
    assert np.isnan(data.in_use).sum() == 1
    assert np.isnan(data.in_use[len(data.angle) // 2])
    assert data.steps.size == 0


def test_each_ray_meets_the_point_and_its_image() -> None:
    data = shadow_steps(AXIS)
    half = data.angle / 2
    circle = np.stack([np.cos(half), np.zeros_like(half), np.sin(half)], axis=-1)
    for row, sign in zip(data.heights, (1, -1), strict=True):
        direction = ray(row)[:, 1] - LAMP
        for place in (sign * circle, np.stack([0 * row, 0 * row, row], axis=-1)):
            known = np.isfinite(place).all(axis=-1) & (np.abs(place) < 5).all(axis=-1)
            away = np.cross(direction, place - LAMP)[known]
            np.testing.assert_allclose(away, 0, atol=1e-7)
            reached = np.einsum("mi,mi->m", direction, place - LAMP)[known]
            assert np.all(reached <= np.sum(direction**2, axis=-1)[known] + 1e-7)


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match=r"switch: expected a length of at least 1, got 0\.5"):
        shadow_steps(AXIS, 0.5)
