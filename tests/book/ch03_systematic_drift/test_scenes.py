"""The scenes of chapter 03: the cone without drift, and what the globe shows of it."""

import numpy as np
import pytest

from driftlab.book.ch03_systematic_drift.axes import axes_without_drift, axis_tour
from driftlab.book.ch03_systematic_drift.experiments import TURNS
from driftlab.book.ch03_systematic_drift.globe import GlobeOfAxes
from driftlab.book.scenarios import LARIN_TRIAD, SKEW, SYMMETRIC
from driftlab.drift import drift_coefficient
from grouped import opened
from support import EPS

RANDOM = 1e-3 * np.random.default_rng(18).normal(size=(3, 3))
INDEFINITE = (1e-3 * SYMMETRIC, LARIN_TRIAD, RANDOM - np.eye(3) * np.trace(RANDOM) / 3)


@pytest.mark.parametrize("error_matrix", INDEFINITE)
def test_no_axis_on_the_cone_drifts(error_matrix) -> None:
    cone = axes_without_drift(error_matrix)
    assert cone.shape[0] == 2
    assert np.abs(np.linalg.norm(cone, axis=-1) - 1).max() < 1e-14
    assert np.abs(drift_coefficient(cone, error_matrix)).max() < 1e-13 * np.abs(error_matrix).max()
    assert np.allclose(cone[:, 0], cone[:, -1])


def test_the_cone_of_equal_leans_goes_through_the_edges() -> None:
    """About (1, 1, 1), with a half angle whose tangent is the square root of two."""
    cone = axes_without_drift(1e-3 * SYMMETRIC)
    along = np.abs(cone @ np.ones(3)) / np.sqrt(3)
    assert np.allclose(along, np.cos(np.arctan(np.sqrt(2))))
    assert np.allclose(along[0, 0], np.eye(3) @ np.ones(3) / np.sqrt(3))


@pytest.mark.parametrize("error_matrix", [1e-3 * SKEW, 1e-3 * np.eye(3), np.zeros((3, 3))])
def test_no_cone_if_all_axes_drift_one_way_or_none_does(error_matrix) -> None:
    assert axes_without_drift(error_matrix).shape[0] == 0


def test_the_way_leads_through_the_chosen_and_the_worst_axis() -> None:
    for start in ([1, 0, 0], [1, 1, 1], [1, -1, 0]):
        tour = axis_tour(1e-3 * SYMMETRIC, start)
        assert np.allclose(tour.axes[0], np.array(start) / np.linalg.norm(start))
        # A moment lies at most half a step of one degree off the worst axis.
        assert tour.first_order.max() == pytest.approx(2 * np.pi * 2e-3, rel=2e-4)
        # After whole turns the error is that many times the drift of one.
        assert np.allclose(np.linalg.norm(tour.error, axis=-1), TURNS * np.abs(tour.exact))


def test_both_blocks_of_the_puzzle_lean_alike_and_drift_apart() -> None:
    scene = opened(GlobeOfAxes)
    tours = []
    for preset in ("The first block", "The second block"):
        scene.preset.value = preset
        tours.append(scene.compute(scene.values))
    leans = [np.linalg.norm(tour.triad - np.eye(3), axis=1) for tour in tours]
    assert np.allclose(*leans)
    first, second = (60 * np.degrees(np.abs(tour.exact).max()) for tour in tours)
    assert first == pytest.approx(43.2, abs=0.1)
    assert second == pytest.approx(0.0324, abs=1e-4)
    # Six products of the leans, which cancel.
    assert np.abs(tours[1].coefficient).max() < 16 * EPS * leans[1].max()


def test_a_gyro_with_a_scale_error_is_dragged_from_where_it_is() -> None:
    scene = opened(GlobeOfAxes)
    scene.set(m11=2.0, m12=1.0, m13=-0.5)
    tip = scene.compute(scene.values).triad[0]
    assert scene.dragged("gyro 1", tip) == pytest.approx({"m12": 1.0, "m13": -0.5})
