"""The figure of chapter 09, and what the chapter says of navigation errors, computed otherwise."""

import numpy as np
import pytest
from scipy.constants import degree, g, hour, micro, nautical_mile
from scipy.integrate import solve_ivp
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
from driftlab.calibration import STATIC_ERROR_SOURCES, navigate_static, static_error_modes
from driftlab.earth import EARTH_RATE, curvature_radii, gravity
from driftlab.imu import NO_ERRORS
from driftlab.motion.turntable import static_trajectory
from driftlab.strapdown import navigate, stationary_state
from published import published

LATITUDE = np.radians(45.0)
LEVEL = [0.0, 0.0, 0.0, 1.0]
GYRO, PUSH = 0.01 * degree / hour, 100 * micro * g


def errors_by_integration(times: np.ndarray, cause: str, size: float) -> np.ndarray:
    """East and North (k, 2) in m of the seven equations at rest, written out and integrated."""
    along, across = curvature_radii(LATITUDE)
    pull, north, up = float(gravity(LATITUDE)), *(
        EARTH_RATE * part for part in (np.cos(LATITUDE), np.sin(LATITUDE))
    )  # fmt: skip
    biases = np.zeros(5)
    biases[STATIC_ERROR_SOURCES.index(cause) - 7] = size
    east_gyro, north_gyro, up_gyro, east_push, north_push = biases

    def rates(_: float, state: np.ndarray) -> list[float]:
        phi_e, phi_n, phi_u, v_e, v_n, _, x_n = state
        return [
            up * phi_n - north * phi_u - v_n / along - east_gyro,
            -up * phi_e + v_e / across - up * x_n / along - north_gyro,
            north * phi_e + v_e * np.tan(LATITUDE) / across + north * x_n / along - up_gyro,
            -pull * phi_n + 2 * up * v_n + east_push,
            pull * phi_e - 2 * up * v_e + north_push,
            v_e,
            v_n,
        ]

    run = solve_ivp(
        rates, (0, times[-1]), np.zeros(7), "DOP853", times, rtol=1e-10, atol=1e-14, max_step=120.0
    )
    return run.y[5:].T


@pytest.mark.parametrize("cause", CAUSES)
def test_curves_are_the_solution_of_the_equations_at_rest(cause: str) -> None:
    table = position_error()
    times = np.array([0.7, 2.0, 6.0, 12.0, 24.0, 36.0, 48.0]) * hour
    size = PUSH if "accelerometer" in cause else GYRO
    right = errors_by_integration(times, cause, size)
    rows = [np.abs(table.time - t).argmin() for t in times]
    drawn = table.position[:, CAUSES.index(cause)].T[rows]
    step = table.time[1] - table.time[0]
    np.testing.assert_allclose(table.time[rows], times, rtol=0, atol=step / 2)
    exact = errors_by_integration(table.time[rows], cause, size)
    np.testing.assert_allclose(drawn, exact, rtol=0, atol=1e-6 * np.abs(right).max())


@published("09-position-error")
def test_caption_says_what_is_drawn(figure: PublishedFigure) -> None:
    for words in ("0.01°/h", "100 µg", "7.2 nautical miles a day", "0.69", "84 min", "45°"):
        assert words in figure.caption


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


@pytest.mark.parametrize("latitude", [0.0, 0.7, -1.2])
def test_a_wrong_altitude_grows_as_a_hyperbolic_cosine(latitude: float) -> None:
    """The gradient of gravity on the ellipsoid is within half a percent of 2g/R."""
    increments = static_trajectory(LEVEL, latitude, 0.5, 2400).increments
    start = stationary_state(latitude, LEVEL, altitude=1.0)
    heights = navigate(start, increments, every=600).altitude
    growth = np.sqrt(2 * gravity(latitude) / curvature_radii(latitude)[0])
    times = 300.0 * np.arange(1, 5)
    np.testing.assert_allclose(heights, np.cosh(growth * times), rtol=2e-2)


def test_an_exact_way_round_a_parallel_comes_out() -> None:
    """A unit that goes East at a constant speed: rates and force are constant in local axes."""
    speed, interval, count = 250.0, 0.5, 2400
    _, across = curvature_radii(LATITUDE)
    spin = EARTH_RATE + speed / (float(across) * np.cos(LATITUDE))
    rate = spin * np.array([0.0, np.cos(LATITUDE), np.sin(LATITUDE)])
    # What holds it on its circle, minus gravity with its centrifugal part taken out.
    radius = float(across) * np.cos(LATITUDE)
    inwards = (spin**2 - EARTH_RATE**2) * radius
    force = np.array([0.0, inwards * np.sin(LATITUDE), -inwards * np.cos(LATITUDE)])
    force[2] += float(gravity(LATITUDE))
    still = static_trajectory(LEVEL, LATITUDE, interval, count).increments
    # The mean over an interval of a force that turns with the axes is constant in body axes too.
    flown = still._replace(
        angle=np.tile(rate * interval, (count, 1)), velocity=np.tile(force * interval, (count, 1))
    )
    start = stationary_state(LATITUDE, LEVEL)._replace(velocity=np.array([speed, 0.0, 0.0]))
    end = navigate(start, flown, every=count)
    along = speed * interval * count / radius
    assert float(end.longitude[0]) == pytest.approx(along, rel=1e-7)
    assert float(end.latitude[0]) == pytest.approx(LATITUDE, abs=1e-9)
    assert float(end.altitude[0]) == pytest.approx(0, abs=0.02)  # of 300 km, in steps of a second
    np.testing.assert_allclose(end.velocity[0], [speed, 0, 0], atol=1e-4)
    np.testing.assert_allclose(np.abs(end.attitude[0]), LEVEL, atol=1e-9)


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


@pytest.mark.parametrize("latitude", [0.3, -0.8])
def test_a_velocity_of_zero_hides_five_directions(latitude: float) -> None:
    """Any attitude and any place stay where they are, with biases that suit them."""
    matrix = np.zeros((12, 12))
    matrix[:7] = static_error_modes(latitude).matrix
    for j in (0, 1, 2, 5, 6):
        still = np.eye(12)[j]
        rates = matrix @ still
        still[7:10], still[10:] = rates[:3], -rates[3:5]
        np.testing.assert_allclose(matrix @ still, 0, atol=1e-15)
