"""What a voyage refuses; what it finds is tested with the figures that show it."""

import numpy as np
import pytest

from driftlab.book.scenarios import ship
from driftlab.gyrocompass.simulation import take_along

WAY = ship(0.9, 5.0, 0.3, 0.5, 60.0)


def test_one_drift_is_the_same_drift_in_each_interval():
    drift = np.array([1e-7, -2e-7, 3e-8])
    once = take_along(WAY, drift)
    each = take_along(WAY, np.tile(drift, (len(WAY.angle_increments), 1)))
    assert np.array_equal(once.heading_error, each.heading_error)


@pytest.mark.parametrize("log", [False, True])
def test_several_drifts_at_once_are_as_many_voyages(log):
    drifts = 1e-7 * np.random.default_rng(3).normal(size=(2, 7, *WAY.angle_increments.shape))
    arguments = {"offset": [1e-4, 0.0, 2e-4], "damping": 0.2, "tilt": 1e-4, "log": log}
    together = take_along(WAY, drifts, **arguments)
    for run in np.ndindex(2, 7):
        alone = take_along(WAY, drifts[run], **arguments)
        for name in ("heading_error", "tilt", "yaw_error", "compass_error"):
            np.testing.assert_array_equal(getattr(together, name)[run], getattr(alone, name))
        np.testing.assert_array_equal(together.formula.heading[run], alone.formula.heading)
    np.testing.assert_array_equal(together.deviation, alone.deviation)
    np.testing.assert_array_equal(together.times, alone.times)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"drift": [1e-7, np.nan, 0.0]}, "^drift: expected finite"),
        ({"drift": np.zeros((7, 3))}, r"^drift, offset: expected shapes \(\.\.\., 120, 3\) or"),
        ({"offset": np.zeros((120, 3))}, r"^drift, offset: .* got \(3,\) and \(120, 3\)"),
        ({"offset": [0.0, np.inf, 0.0]}, "^offset: expected finite"),
        ({"tuning_factor": 0.0}, "^tuning_factor: expected a positive number"),
        ({"damping": np.nan}, "^damping: expected finite"),
        ({"damping": -0.5}, "^tuning, interval: expected a horizon that follows"),
        ({"tilt": np.inf}, "^tilt: expected finite"),
    ],
)
def test_a_voyage_refuses(arguments, words):
    with pytest.raises(ValueError, match=words):
        take_along(WAY, **{"drift": np.zeros(3), **arguments})


@pytest.mark.parametrize(("name", "place"), [("latitude", 0), ("speed", 1), ("interval", 4)])
def test_a_ship_refuses(name, place):
    arguments = [0.9, 5.0, 0.3, 0.5, 60.0]
    arguments[place] = np.nan
    with pytest.raises(ValueError, match=rf"^{name}: expected"):
        ship(*arguments)
