"""What a voyage refuses; what it finds is tested with the figures that show it."""

import numpy as np
import pytest

from driftlab.book.scenarios import ship_manoeuvre
from driftlab.gyrocompass.simulation import simulate_compass

WAY = ship_manoeuvre(0.9, 5.0, 0.3, 0.5, 60.0)


def test_one_drift_is_the_same_drift_in_each_interval():
    drift = np.array([1e-7, -2e-7, 3e-8])
    once = simulate_compass(WAY, drift)
    each = simulate_compass(WAY, np.tile(drift, (len(WAY.increments.angle), 1)))
    assert np.array_equal(once.heading_error, each.heading_error)


@pytest.mark.parametrize("log", [False, True])
def test_several_drifts_at_once_are_as_many_voyages(log):
    drifts = 1e-7 * np.random.default_rng(3).normal(size=(2, 7, *WAY.increments.angle.shape))
    arguments = {
        "accelerometer_bias_body": [1e-4, 0.0, 2e-4],
        "damping": 0.2,
        "tilt": 1e-4,
        "log": log,
    }
    together = simulate_compass(WAY, drifts, **arguments)
    for run in np.ndindex(2, 7):
        alone = simulate_compass(WAY, drifts[run], **arguments)
        for name in ("heading_error", "tilt", "yaw_error", "compass_error"):
            np.testing.assert_array_equal(getattr(together, name)[run], getattr(alone, name))
        np.testing.assert_array_equal(together.formula.heading[run], alone.formula.heading)
    np.testing.assert_array_equal(together.speed_error, alone.speed_error)
    np.testing.assert_array_equal(together.times, alone.times)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"gyro_bias_body": [1e-7, np.nan, 0.0]}, "^gyro_bias_body: expected finite"),
        (
            {"gyro_bias_body": np.zeros((7, 3))},
            r"^gyro_bias_body, accelerometer_bias_body: expected shapes \(\.\.\., 120, 3\) or",
        ),
        (
            {"accelerometer_bias_body": np.zeros((120, 3))},
            r"^gyro_bias_body, accelerometer_bias_body: .* got \(3,\) and \(120, 3\)",
        ),
        (
            {"accelerometer_bias_body": [0.0, np.inf, 0.0]},
            "^accelerometer_bias_body: expected finite",
        ),
        ({"tuning_factor": 0.0}, "^tuning_factor: expected a positive number"),
        ({"damping": np.nan}, "^damping: expected finite"),
        ({"damping": -0.5}, "^gains, increments.interval: expected a horizon that follows"),
        ({"tilt": np.inf}, "^tilt: expected finite"),
    ],
)
def test_a_voyage_refuses(arguments, words):
    with pytest.raises(ValueError, match=words):
        simulate_compass(WAY, **{"gyro_bias_body": np.zeros(3), **arguments})


@pytest.mark.parametrize(("name", "place"), [("latitude", 0), ("speed", 1), ("interval", 4)])
def test_a_ship_refuses(name, place):
    arguments = [0.9, 5.0, 0.3, 0.5, 60.0]
    arguments[place] = np.nan
    with pytest.raises(ValueError, match=rf"^{name}: expected"):
        ship_manoeuvre(*arguments)
