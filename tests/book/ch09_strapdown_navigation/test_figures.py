"""The figure of chapter 09, and what the chapter says of navigation errors, computed otherwise."""

import numpy as np
import pytest
from scipy.constants import degree, g, hour, micro, nautical_mile
from scipy.linalg import expm

from driftlab.book.ch09_strapdown_navigation.experiments import (
    CAUSES,
    carried_level,
    position_error,
    stops,
)
from driftlab.book.ch09_strapdown_navigation.experiments.stops import ARW, START, VRW
from driftlab.book.ch09_strapdown_navigation.puzzle import PUZZLE
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.calibration import (
    STATIC_ERROR_SOURCES,
    navigate_static,
    static_error_modes,
    static_errors,
)
from driftlab.earth import curvature_radii, gravity
from driftlab.imu import NO_ERRORS
from published import published

LATITUDE = np.radians(45.0)
LEVEL = [0.0, 0.0, 0.0, 1.0]
GYRO, PUSH = 0.01 * degree / hour, 100 * micro * g


@published("09-position-error")
def test_caption_says_what_is_drawn(figure: PublishedFigure) -> None:
    for words in ("0.01°/h", "100 µg", "7.2 nautical miles a day", "0.69", "84 min", "45°"):
        assert words in figure.caption


def test_curves_are_those_of_their_causes() -> None:
    table, sizes = position_error(), (GYRO, GYRO, PUSH)
    causes = np.zeros((3, 12))
    causes[range(3), [STATIC_ERROR_SOURCES.index(cause) for cause in CAUSES]] = sizes
    expected = static_errors(table.time, LATITUDE, causes).position
    np.testing.assert_allclose(table.position.transpose(1, 2, 0), expected, rtol=0, atol=1e-6)


def test_modes_are_what_the_chapter_says_of_each_cause() -> None:
    """Offset R b/g, line along the Earth's axis, and no day in what an accelerometer does."""
    table, modes = position_error(), static_error_modes(LATITUDE)
    _, across = curvature_radii(LATITUDE)
    east_push = STATIC_ERROR_SOURCES.index(CAUSES[2])
    offset = modes.standing[5, east_push] * float(gravity(LATITUDE)) / across
    assert offset == pytest.approx(1, rel=1e-9)
    np.testing.assert_allclose(modes.cosine[0, 5:, east_push] * PUSH, 0, atol=1e-6)
    rate = across * np.cos(LATITUDE) ** 2 * GYRO  # along the axis, then on the parallel
    assert table.line == pytest.approx(86400 * rate, rel=1e-6)
    assert table.farthest < 2.01 * across * PUSH / float(gravity(LATITUDE))


def test_puzzle_is_what_the_whole_navigation_gives() -> None:
    units = (
        NO_ERRORS._replace(accelerometer_bias=np.array([PUSH, 0, 0])),
        NO_ERRORS._replace(gyro_bias=np.array([0, GYRO, 0])),
    )
    pose = {"start": LEVEL, "reference": LEVEL, "latitude": LATITUDE, "interval": 10.0}
    for question, unit in zip(PUZZLE.questions, units, strict=True):
        run = navigate_static(unit, NO_ERRORS, LEVEL, **pose, duration=10 * hour)
        far = np.linalg.norm(run.position, axis=1).max() / nautical_mile
        assert question.truth() == pytest.approx(far, rel=5e-3)


def test_local_axes_turn_with_the_latitude() -> None:
    table = carried_level()
    north = np.stack([-np.sin(table.latitude), np.cos(table.latitude)], axis=-1)
    angle = np.arccos(north[0] @ north[-1])
    assert table.turned == pytest.approx(angle, abs=1e-12)


def test_stops_are_worth_what_units_drawn_at_random_find() -> None:
    """Five hundred units with all their noise; no filter of theirs, but the gains of theirs."""
    every, count = 300.0, 24
    table = stops(every=every, duration=every * count)
    rng, units = np.random.default_rng(12), 500
    matrix = np.zeros((12, 12))
    matrix[:7] = static_error_modes(LATITUDE).matrix
    steps = 30
    transition = expm(matrix * every / steps)
    walk = np.array([ARW] * 3 + [VRW] * 2 + [0] * 7) * np.sqrt(every / steps)
    alone = reset = update = START * rng.normal(size=(units, 12))
    covariance = np.diag(START**2)
    for k in range(1, steps * count + 1):
        kicks = walk * rng.normal(size=(units, 12))
        alone, reset, update = (each @ transition.T + kicks for each in (alone, reset, update))
        covariance = transition @ covariance @ transition.T + np.diag(walk**2)
        if k % steps == 0:
            reset[:, 3:5] = 0
            spread = covariance[3:5, 3:5] + 1e-4 * np.eye(2)
            gain = covariance[:, 3:5] @ np.linalg.inv(spread)
            update = update - (update[:, 3:5] + 0.01 * rng.normal(size=(units, 2))) @ gain.T
            covariance = covariance - gain @ covariance[3:5]
    for errors, stated in zip((alone, reset, update), table.last, strict=True):
        found = np.sqrt((errors[:, 5:7] ** 2).sum(axis=1).mean())
        # One direction at least: the standard deviation of a mean of so many squares.
        assert found == pytest.approx(stated, rel=4 * np.sqrt(0.5 / units))
