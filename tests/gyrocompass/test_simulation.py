"""What a voyage refuses; what it finds is tested with the figures that show it."""

import numpy as np
import pytest

from driftlab.book.scenarios import ship_manoeuvre
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.heading_error import speed_error
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from support import EPS, largest

WAY = ship_manoeuvre(0.9, 5.0, 0.3, 0.5, 60.0)
SWING = float(np.sqrt(gravity(0.9) / EARTH_RADIUS))
NONE = np.zeros(3)


def same_voyage(one, other):
    """Histories of angles, errors of angles of up to one, after as many rounded steps."""
    np.testing.assert_allclose(one, other, rtol=0, atol=len(other) * EPS)


def test_one_drift_is_the_same_drift_in_each_interval():
    drift = np.array([1e-7, -2e-7, 3e-8])
    once = simulate_gyrocompass(WAY, drift)
    each = simulate_gyrocompass(WAY, np.tile(drift, (len(WAY.increments.angle), 1)))
    same_voyage(once.heading_error, each.heading_error)


@pytest.mark.parametrize("speed_log", [False, True])
def test_several_drifts_at_once_are_as_many_voyages(speed_log):
    drifts = 1e-7 * np.random.default_rng(3).normal(size=(2, 7, *WAY.increments.angle.shape))
    arguments = {
        "accelerometer_bias_body": [1e-4, 0.0, 2e-4],
        "damping": 0.2,
        "tilt": 1e-4,
        "speed_log": speed_log,
    }
    together = simulate_gyrocompass(WAY, drifts, **arguments)
    for run in np.ndindex(2, 7):
        alone = simulate_gyrocompass(WAY, drifts[run], **arguments)
        for name in ("heading_error", "tilt", "yaw_error", "compass_error"):
            same_voyage(getattr(together, name)[run], getattr(alone, name))
        same_voyage(together.formula.heading[run], alone.formula.heading)
    np.testing.assert_array_equal(together.speed_error, alone.speed_error)
    np.testing.assert_array_equal(together.times, alone.times)


@pytest.mark.parametrize("damping", [0.2, 0.5, 0.9])
def test_velocity_damping_does_not_feel_that_a_ship_gathers_way_and_turns(damping):
    way = ship_manoeuvre(0.9, 20.0, 2.0, -1.5)
    quiet, alone = (
        simulate_gyrocompass(way, NONE, damping=damping, speed_log=speed_log)
        for speed_log in (True, False)
    )
    assert largest(quiet.tilt) < 1e-3 * largest(alone.tilt)
    assert largest(quiet.heading_error) < 1e-3 * largest(alone.heading_error)


@pytest.mark.parametrize(("damping", "factor"), [(0.2, 1.0), (0.5, 1.0), (0.7, 2.0)])
def test_under_way_velocity_damping_lets_a_tilt_go_as_at_rest(damping, factor):
    way = ship_manoeuvre(0.9, 20.0, 2.0, -1.5)
    settings = {"damping": damping, "speed_log": True, "tuning_factor": factor}
    tilt, times = 1e-4, way.times[1:]
    bent, straight = (
        simulate_gyrocompass(way, NONE, tilt=lean, **settings) for lean in (tilt, 0.0)
    )
    natural = SWING * np.sqrt(factor)
    ringing = natural * np.sqrt(1 - damping**2)
    # The rate at the start is that of the proportional part: chi' = -2 zeta w chi.
    sine = damping * natural / ringing * np.sin(ringing * times)
    expected = tilt * np.exp(-damping * natural * times) * (np.cos(ringing * times) - sine)
    # The turning Earth leaves a little of the swing about East to that about North.
    gap = largest((bent.tilt - straight.tilt)[:, 1] - expected)
    assert gap < 2 * EARTH_RATE / natural * tilt


def test_an_error_of_the_log_tilts_a_damped_horizon_by_its_second_derivative():
    """chi'' + 2 zeta w chi' + w^2 chi = k1 e'', with e what the log tells too much to the North."""
    damping, interval = 0.5, 4.0
    way = ship_manoeuvre(0.9, 0.0, 0.0, 0.0, interval)
    size, period = 0.2, 3000.0
    error = np.zeros((len(way.times), 2))
    error[:, 0] = size * np.sin(2 * np.pi * way.times / period)
    run = simulate_gyrocompass(way, NONE, damping=damping, speed_log=True, speed_log_error=error)
    k1 = 2 * damping * SWING / float(gravity(0.9))
    s = 2j * np.pi / period
    expected = np.abs(k1 * s**2 * size / (s**2 + 2 * damping * SWING * s + SWING**2))
    settled = run.times > 5000
    # The log's Coriolis force tilts the other axis, and the turning Earth mixes both a little.
    assert largest(run.tilt[settled, 1]) == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("damping", [0.0, 0.5])
def test_a_current_is_in_the_speed_error_and_not_in_the_horizon(damping):
    way = ship_manoeuvre(0.9, 10.0, 0.3, 0.5)
    current = np.array([0.4, -0.3])
    settings = {"damping": damping, "speed_log": True}
    true, wrong = (
        simulate_gyrocompass(way, NONE, speed_log_error=error, **settings)
        for error in ([0.0, 0.0], -current)
    )
    place, velocity = way.latitude[1:], way.velocity[1:]
    missed = speed_error(place, velocity) - speed_error(place, velocity - current)
    np.testing.assert_array_equal(wrong.speed_error, true.speed_error)
    # What else there is: a Coriolis tilt of the current, and the drift of a wrong azimuth rate.
    tilt = EARTH_RATE * np.linalg.norm(current) / float(gravity(0.9))
    turning = np.linalg.norm(current) * np.tan(0.9) / EARTH_RADIUS / SWING
    gap = largest(wrong.heading_error - true.heading_error - missed)
    assert gap < turning + 2 * tilt * SWING / EARTH_RATE < 0.2 * largest(missed)
    assert largest(wrong.tilt - true.tilt) < 3 * tilt


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            {"gyro_bias_body": np.zeros((7, 3))},
            r"^gyro_bias_body, accelerometer_bias_body: expected shapes \(\.\.\., 120, 3\) or",
        ),
        (
            {"accelerometer_bias_body": np.zeros((120, 3))},
            r"^gyro_bias_body, accelerometer_bias_body: .* got \(3,\) and \(120, 3\)",
        ),
        ({"tuning_factor": 0.0}, "^tuning_factor: expected a positive number"),
        ({"damping": -0.5}, "^damping: expected a number of at least 0, got -0.5"),
        (
            {"speed_log_error": np.zeros((120, 2)), "speed_log": True},
            r"^speed_log_error: .* \(121, 2\) or \(2,\), got",
        ),
        ({"speed_log_error": [0.1, 0.0]}, "^speed_log_error: expected zeros without a log"),
        ({"tilt": 1.0}, r"^tilt: expected rad, at most 0\.1, got 1"),
        ({"gyro_bias_body": [0.05, 0.0, 0.0]}, "^gyro_bias_body: expected rad/s, .* got 0.05. Is"),
    ],
)
def test_a_voyage_refuses(arguments, words):
    with pytest.raises(ValueError, match=words):
        simulate_gyrocompass(WAY, **{"gyro_bias_body": np.zeros(3), **arguments})
