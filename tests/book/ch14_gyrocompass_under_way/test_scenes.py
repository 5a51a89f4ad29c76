"""The ship and the pendulum of chapter 14: closed forms, and what is drawn of them."""

import numpy as np
import pytest
from scipy.constants import arcminute, nautical_mile

from driftlab.book import GyrocompassExplorer, SchulerPendulum, ShipUnderWay
from driftlab.book.ch14_gyrocompass_under_way.experiments import (
    DAMPING,
    GYRO_BIAS,
    schuler_pendulum,
    ship_with_compass,
)
from driftlab.book.ch14_gyrocompass_under_way.puzzle import after_gathering_way
from driftlab.book.ch14_gyrocompass_under_way.scenes.pendulum import PLATFORM_FACTOR
from driftlab.book.ch14_gyrocompass_under_way.scenes.ship import HEADING_FACTOR, TILT_FACTOR
from driftlab.book.scenarios import SCHULER_PERIOD, SPEED, SPEED_UP
from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.quaternion import rotate
from grouped import opened
from saratov import GRAVITY, LATITUDE, SCHULER
from support import largest


def test_the_pendulum_swings_with_schulers_period_and_its_line_turns() -> None:
    """Like Foucault's, but by half of the Earth's rate about Up: its azimuth turns as well."""
    swing = schuler_pendulum(arcminute)
    phase = 2 * np.pi * swing.times / SCHULER_PERIOD
    line = 0.5 * EARTH_RATE * np.sin(LATITUDE) * swing.times
    closed = arcminute * np.cos(phase) * np.cos(line)
    assert largest(swing.tilt[:, 1] - closed) < 0.02 * arcminute
    begin, end = np.searchsorted(swing.times, [0.4 * SCHULER_PERIOD, 0.6 * SCHULER_PERIOD])
    low = begin + swing.tilt[begin:end, 1].argmin()
    assert abs(swing.times[low] / (SCHULER_PERIOD / 2) - 1) < 0.01


def test_an_arc_minute_swings_the_way_by_two_nautical_miles() -> None:
    swing = schuler_pendulum(arcminute)
    # A nautical mile is 1852 m, an arc minute of the book's Earth 1853 m.
    assert abs(swing.place_error.max() / (2 * nautical_mile) - 1) < 1e-3
    assert abs(
        largest(swing.velocity_error) / (arcminute * np.sqrt(GRAVITY * EARTH_RADIUS)) - 1
    ) < (0.01)


def test_a_damped_pendulum_comes_to_rest() -> None:
    """x'' + 2 d w x' + w^2 x = 0, with the rate that the damping gives it at once."""
    swing = schuler_pendulum(arcminute, damping=DAMPING)
    slower = SCHULER * np.sqrt(1 - DAMPING**2)
    wave = np.cos(slower * swing.times)
    wave -= DAMPING * SCHULER / slower * np.sin(slower * swing.times)
    closed = arcminute * np.exp(-DAMPING * SCHULER * swing.times) * wave
    assert largest(swing.tilt[:, 1] - closed) < 0.02 * arcminute


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_only_the_earths_radius_stays_upright_on_its_way(factor: float) -> None:
    """A pendulum of another length lags or leads: a speed v begins a swing of (k - 1) v/(R w)."""
    assert largest(schuler_pendulum(0.0, speed=SPEED).tilt) < 1e-3 * arcminute
    swing = schuler_pendulum(0.0, speed=SPEED, tuning_factor=factor)
    frequency = SCHULER * np.sqrt(factor)
    expected = abs(factor - 1) * SPEED / EARTH_RADIUS / frequency
    # Two minutes of gathering way are no jump; the line of the swing turns.
    found = np.hypot(*swing.tilt.T).max()
    assert abs(found / expected - 1) < 0.03
    assert swing.length == EARTH_RADIUS / factor


def test_the_pendulum_is_drawn_as_it_swings() -> None:
    scene = opened(SchulerPendulum)
    data = scene.compute(scene.values)
    stage = scene.view.stage(data)
    _, aside, up = rotate(stage.tracks["platform"], [0.0, 0.0, 1.0]).T
    east = np.arctan2(-aside, up) / PLATFORM_FACTOR
    assert largest(east - data.tilt[:, 1]) < 0.01 * arcminute


def test_the_ship_has_the_numbers_of_the_panel() -> None:
    panel = opened(GyrocompassExplorer)
    run = panel.compute(panel.values)
    ship = ship_with_compass(SPEED, 0.0, np.pi / 2, GYRO_BIAS)
    assert np.array_equal(ship.tilt.T, [run.tilt_north, run.tilt_east])
    # Added up elsewhere, which may round otherwise.
    shown = run.heading_error + run.speed_error
    np.testing.assert_allclose(ship.shown_error, shown, rtol=1e-12, atol=1e-16)
    with_log = ship_with_compass(SPEED, 0.0, np.pi / 2, GYRO_BIAS, speed_log=True)
    panel.set(log=True)
    assert np.array_equal(with_log.shown_error, panel.compute(panel.values).heading_error)


def test_the_first_preset_is_the_puzzle() -> None:
    scene = opened(ShipUnderWay)
    run = scene.compute(scene.values)
    after = np.searchsorted(run.times, sum(SPEED_UP))
    found = np.abs(run.tilt[after]).max() / arcminute, abs(np.degrees(run.shown_error[after]))
    assert np.allclose(found, after_gathering_way(), rtol=1e-12)


def test_the_plumb_line_leans_by_the_acceleration() -> None:
    """Forward by dv/dt over g, and at an even speed by Coriolis only."""
    run = ship_with_compass(SPEED, 0.0, 0.0, np.zeros(3))
    # The steepest slope of the smooth step is 15/8 of the mean.
    assert abs(run.lean[:, 0].max() / (15 / 8 * SPEED / SPEED_UP[1] / GRAVITY) - 1) < 0.01
    coriolis = 2 * EARTH_RATE * np.sin(LATITUDE) * SPEED / GRAVITY
    assert abs(np.hypot(*run.lean[-1]) / coriolis - 1) < 0.01


def test_the_wake_is_where_the_ship_was() -> None:
    run = ship_with_compass(SPEED, 0.0, np.pi / 2, np.zeros(3))
    assert np.allclose(run.wake[-1, -1], [0.0, 300 * SPEED])  # due West for the last five minutes
    assert not run.wake[:, 0].any()


def test_the_ghost_is_turned_and_tilted_by_the_errors() -> None:
    scene = opened(ShipUnderWay)
    scene.preset.value = "A voyage"
    run = scene.compute(scene.values)
    stage = scene.view.stage(run)
    x, y, _ = rotate(stage.tracks["ghost"], [0.0, 1.0, 0.0]).T
    # To the East of the true North by what the heading is too large; the tilt adds a little.
    assert largest(np.arctan2(x, y) - HEADING_FACTOR * run.shown_error) < np.radians(2)
    east, north, up = rotate(stage.tracks["ghost"], [0.0, 0.0, 1.0]).T
    leaning = np.hypot(east, north)
    assert np.allclose(leaning, np.sin(TILT_FACTOR * np.hypot(*run.tilt.T)))
    assert (up > 0).all()
    bow = rotate(stage.tracks["ship"], [0.0, 1.0, 0.0])
    assert np.allclose(bow[-1], [-1.0, 0.0, 0.0])  # to the West


def test_a_course_that_is_led_round_makes_a_whole_turn() -> None:
    scene = opened(ShipUnderWay)
    turns = []
    for degrees in np.arange(0, 361, 45):
        bearing = np.radians(degrees)
        place = [-np.sin(bearing), np.cos(bearing), 0.0]
        message = {"handle": "course after the turn", "direction": place}
        scene._asked(None, message, [])
        turns.append(scene.values["turn"])
    assert turns == list(np.arange(0, 361, 45))
