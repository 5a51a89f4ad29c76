"""The ways of the type test: speeds, accelerations and angles as they are told, and how long."""

import numpy as np
import pytest
from scipy.constants import g

from driftlab.earth import EARTH_RADIUS
from driftlab.frames import to_euler_angles
from driftlab.gyrocompass.type_test import _quay, _rolling, _speeding_up, _turning

LATITUDE, STEP = 0.8, 0.5
SWING = 2 * np.pi * np.sqrt(EARTH_RADIUS / g)


def times_of(way):
    return STEP * np.arange(len(way.velocity))


def between(values, times, points):
    return np.stack([np.interp(points, times, column) for column in values.T], axis=-1)


def test_at_the_quay_nothing_moves():
    way = _quay(LATITUDE, 30.0, STEP)
    assert way.velocity.shape == (61, 2)
    assert not way.velocity.any()
    assert len(way.increments.angle) == 60
    np.testing.assert_allclose(to_euler_angles(way.attitude).heading, 0, atol=1e-9)


@pytest.mark.parametrize("speed", [10.0, 36.0])
def test_speed_comes_after_a_minute_with_two_metres_a_second_squared(speed):
    way = _speeding_up(LATITUDE, speed, STEP)
    times = times_of(way)
    assert times[-1] == pytest.approx(60 + speed / 2 + 2 * SWING, abs=STEP / 2)
    points = np.array([0.0, 60.0, 61.0, 60 + speed / 2 - 1, 60 + speed / 2, 60 + SWING])
    north, east = between(way.velocity, times, points).T
    np.testing.assert_allclose(north, [0, 0, 2, speed - 2, speed, speed], atol=1e-9)
    assert not east.any()


@pytest.mark.parametrize("speed", [10.0, 36.0])
def test_the_turn_goes_through_west_at_twenty_degrees_a_second(speed):
    way = _turning(LATITUDE, speed, STEP)
    times, begin = times_of(way), 120 + speed / 2
    assert times[-1] == pytest.approx(begin + SWING / 2 + 60, abs=STEP / 2)
    points = np.array([60.0, 60 + speed / 2, begin, begin + 4.5, begin + 9.0, begin + 600])
    velocity = between(way.velocity, times, points)
    expected = speed * np.array([[0, 0], [1, 0], [1, 0], [0, -1], [-1, 0], [-1, 0]])
    np.testing.assert_allclose(velocity, expected, atol=1e-9)
    heading = np.unwrap(to_euler_angles(way.attitude).heading)
    turned = np.interp(points[2:], times, heading) - heading[0]
    np.testing.assert_allclose(turned, [0, np.pi / 2, np.pi, np.pi], atol=1e-6)


def test_a_ship_at_sea_rolls_pitches_yaws_and_sways():
    way = _rolling(LATITUDE, STEP, 120.0)
    times = times_of(way)
    assert times[-1] == 120.0
    angles = to_euler_angles(way.attitude)
    for found, size, period in (
        (angles.roll, 20.0, 6.0),
        (angles.pitch, 10.0, 10.0),
        (angles.heading, 5.0, 15.0),
    ):
        expected = np.radians(size) * np.sin(2 * np.pi * times / period)
        off = (found - expected + np.pi) % (2 * np.pi) - np.pi
        assert np.abs(off).max() < 1e-9
    # To the North-East and back, with a metre a second squared at most.
    speed = 15 / (2 * np.pi) * np.sin(2 * np.pi * times / 15)
    np.testing.assert_allclose(way.velocity, np.sqrt(0.5) * np.stack([speed, speed], axis=-1))
