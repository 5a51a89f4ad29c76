"""The scene of chapter 01: what a false rate leaves of a turn."""

import numpy as np
import pytest

from driftlab.book.ch01_attitude_error_motion.experiments import SPIN, error_in_space
from driftlab.book.ch01_attitude_error_motion.scenes import RATES, RING, FalseRate
from driftlab.quaternion import conjugate, multiply, rotation_angle

DEGREE = np.radians(1.0)


def test_the_angle_is_that_between_body_and_ghost() -> None:
    data = error_in_space([0, 0, 0.2], [0.01, -0.02, 0.005])
    between = multiply(conjugate(data.attitude), data.apparent)
    np.testing.assert_allclose(rotation_angle(between), data.angle, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(data.vector, axis=-1), data.angle, atol=1e-12)


def test_a_false_rate_across_leaves_what_chapter_02_says_of_whole_turns() -> None:
    """After a whole turn the error is one about the measured rate, by the difference of angles."""
    data = error_in_space([0, 0, SPIN * DEGREE], [DEGREE, 0, 0])
    end = data.whole_turns[1]
    left = 2 * np.pi * (np.hypot(SPIN, 1) / SPIN - 1)
    np.testing.assert_allclose(data.angle[end], left, rtol=1e-12)
    assert f"{np.degrees(left):.2f}" == "1.25"
    # Half a turn later the two axes stand twice their angle apart; half of the rest is there too,
    # about an axis perpendicular to it.
    swing = np.hypot(2 * np.arctan(1 / SPIN), left / 2)
    assert data.angle[: end + 1].max() == pytest.approx(swing, rel=1e-3)
    assert f"{np.degrees(data.angle[: end + 1].max()):.2f}" == "9.55"


@pytest.mark.parametrize("rate", [0.0, SPIN])
def test_along_the_rate_or_without_one_nothing_takes_it_round(rate: float) -> None:
    data = error_in_space([0, 0, rate * DEGREE], [0, 0, DEGREE])
    np.testing.assert_allclose(data.angle, DEGREE * data.time, atol=1e-12)
    if rate:
        assert np.degrees(data.angle[data.whole_turns[1]]) == pytest.approx(30.0)
    else:
        assert data.whole_turns.tolist() == [0]


def test_the_blue_arrow_says_where_the_tip_goes_while_the_error_is_small() -> None:
    data = error_in_space([0, 0, SPIN * DEGREE], np.array([3e-6, 2e-6, -1e-6]))
    slope = np.gradient(data.vector, data.time, axis=0, edge_order=2)
    np.testing.assert_allclose(slope, data.added, atol=2e-9)


def test_whole_turns_of_all_rates_end_at_moments() -> None:
    for rate in RATES[1:]:
        data = error_in_space([0, 0, rate * DEGREE], [DEGREE, 0, 0])
        turns = data.time[data.whole_turns] * rate / 360
        np.testing.assert_allclose(turns, np.arange(len(turns)), atol=1e-12)
        assert len(turns) == int(data.time[-1] * rate / 360 + 1e-9) + 1


def test_the_ring_is_the_size_that_its_title_says() -> None:
    scene = FalseRate()
    for preset in scene.presets:
        scene.preset.value = preset
        data = scene.compute(scene.values)
        view = scene.view.stage(data).views[1]
        size = float(view.title.rpartition(" ")[2].rstrip("°"))
        trace = next(part for part in view.parts if part.kind == "trace")
        np.testing.assert_allclose(
            np.linalg.norm(trace.points, axis=-1), RING / size * np.degrees(data.angle), atol=1e-12
        )


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match="duration: expected a number above 0, got 0"):
        error_in_space([0, 0, 1], [1, 0, 0], 0)
