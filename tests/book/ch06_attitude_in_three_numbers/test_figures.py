"""The figures of chapter 06: Cayley's vectors over an angle, and Riccati's equation in turns."""

import numpy as np
import pytest

from driftlab.attitude import cayley, riccati_rate
from driftlab.book.ch06_attitude_in_three_numbers.experiments import WAYS, cayley_map
from driftlab.book.machinery.figure.publish import PublishedFigure
from published import published


def test_cayley_map_shows_the_tangents_and_says_what_is_infinite() -> None:
    degrees = np.array([-270.0, -90.0, 10.0, 130.0, 300.0])
    for phi in np.radians(degrees):
        data = cayley_map(phi, [0.3, -2, 1])
        np.testing.assert_allclose(
            data.mark[:, 0], [-np.tan(phi / 2), -np.tan(phi / 4), 1 / np.tan(phi / 4)], rtol=1e-13
        )
    for angle, infinite in ((np.pi, 0), (-2 * np.pi, 1), (0.0, 2)):
        data = cayley_map(angle, [1, 0, 0])
        assert np.flatnonzero(np.isnan(data.mark)).tolist() == [infinite]


@published("06-circles")
def test_circles_are_circles_that_obey_the_equation_and_hold_the_shadow(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    turn = data.turn[1] - data.turn[0]
    for path in np.moveaxis(np.array(data.path), 1, 2):
        np.testing.assert_allclose(path[-1], path[0], rtol=0, atol=1e-12)
        # A point and its shadow, one turn later, are the ends of a diameter for the start.
        centre = (path[0] + path[len(path) // 2]) / 2
        np.testing.assert_allclose(path[len(path) // 2], cayley.shadow(path[0]), atol=1e-12)
        radii = np.linalg.norm(path - centre, axis=-1)
        np.testing.assert_allclose(radii, radii[0], rtol=1e-12)
        assert np.linalg.svd(path - centre, compute_uv=False)[2] < 1e-12
        rates = (path[2:] - path[:-2]) / (2 * turn)
        by_equation = riccati_rate(path[1:-1], np.array([0.0, 0.0, 1.0]))
        np.testing.assert_allclose(rates, by_equation, rtol=0, atol=2e-3)
    np.testing.assert_allclose(data.shadow, cayley.shadow(np.array(data.path)[0, :, 0]))


@published("06-riccati-turns")
def test_riccati_equation_with_a_switch_stays_bounded_and_costs_less(
    figure: PublishedFigure,
) -> None:
    data = figure.data

    def length(way: str) -> tuple[np.ndarray, np.ndarray]:
        rows = np.array(data.curve) == f"|k| {way}, over turns"
        return data.x[rows], data.y[rows]

    (ended, last), (time, plain), (whole, switched) = map(length, WAYS)
    assert 0.99999 < data.given_up == ended[-1] < 1 < time[-1] == whole[-1]
    assert data.longest == last[-1] == pytest.approx(1e6, rel=1e-3)
    assert switched.max() < 1.2 + 1e-6
    # Nearest to the singularity, after a turn: the vector of an angle of 2 pi less the miss.
    assert plain[time < 1.5].max() == pytest.approx(1 / np.tan(data.miss / 4), rel=1e-2)
    plain, switched = data.fixed_errors[:, -1]
    assert plain > 1000 * switched
    # At each tolerance: errors alike, more work without the switch, and more for a closer pass.
    assert np.abs(np.log(data.worst[1] / data.worst[0])).max() < np.log(5)
    assert np.all(data.evaluations[0] > 2 * data.evaluations[1])
    assert np.all(data.evaluations[0, 1] > data.evaluations[0, 0])
    # Along each curve, a smaller tolerance is more work for less error.
    assert np.all(np.diff(data.evaluations) > 0)
    assert np.all(np.diff(data.worst) < 0)
