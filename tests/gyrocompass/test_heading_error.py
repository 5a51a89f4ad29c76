"""Coriolis forces of an even motion: against differences, and against what sensors integrate."""

import numpy as np
import pytest

from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.frames import navigation_frame_rate
from driftlab.gyrocompass.heading_error import coriolis_correction
from driftlab.gyrocompass.levelling import LevelFrame, propagate_level_frame
from driftlab.gyrocompass.levelling_loop import schuler_gains
from driftlab.increments import Increments
from driftlab.motion.vehicle import vehicle_trajectory
from driftlab.quaternion import conjugate, multiply, rotate, to_rotation_vector
from support import EPS

LATITUDE = 0.9
VELOCITIES = np.array([[10.0, 0.0], [0.0, 10.0], [-30.0, 20.0], [200.0, -150.0], [0.0, -460.0]])


@pytest.mark.parametrize("latitude", [-1.2, -0.3, 0.9, 1.4])
@pytest.mark.parametrize("radius", [EARTH_RADIUS, 1e6], ids=["Earth", "small"])
def test_it_is_coriolis_less_what_the_horizon_has_to_follow(latitude, radius):
    """(w + U)×v, less R times the change of the level rates that moves on with the latitude."""
    found = coriolis_correction(latitude, VELOCITIES, radius)
    turn = navigation_frame_rate(latitude, VELOCITIES, radius) + navigation_frame_rate(latitude)
    moving = np.insert(VELOCITIES, 1, 0.0, axis=-1)
    total = np.cross(turn, moving)[:, [0, 2]]
    # W3 turns the horizon about North, W1 the other way about East: rates' = (W3, -W1)/R. The rate
    # about North is U cos(latitude) + east/R; both velocities are even. Central differences.
    time = 1e-3 * radius / 1000
    ahead, behind = (
        EARTH_RATE * np.cos(latitude + sign * time * VELOCITIES[:, 0] / radius) for sign in (1, -1)
    )
    followed = np.stack([np.zeros(5), radius * (ahead - behind) / (2 * time)], axis=-1)
    # Differences lose digits: rates of 7e-5 over times of 1 s, on a radius of 6e6 m.
    bound = 8 * EPS * EARTH_RATE * radius / time + 1e-6 * np.abs(total).max()
    np.testing.assert_allclose(found, total - followed, rtol=0, atol=bound)
    assert np.abs(found).max() > 1e3 * bound


def test_sensors_of_an_even_voyage_say_it():
    """Means of the increments, less what a horizon that is turned by W/R must follow."""
    for velocity in VELOCITIES:
        way = vehicle_trajectory(LATITUDE, np.tile(velocity, (3, 1)), 0.4, interval=1.0)
        force = rotate(way.attitude[:-1], way.increments.velocity)[:, [0, 2]].mean(axis=0)
        change = np.diff(navigation_frame_rate(way.latitude), axis=0)[:, 0].mean()
        north, east = coriolis_correction(way.latitude[1], velocity)
        # Within a second the body turns under the force by up to 1e-4, one half of it in the mean.
        lag = 9.9 * np.linalg.norm(way.increments.angle, axis=-1).max() ** 2
        gravity_seen = force - [0.0, EARTH_RADIUS * change]
        np.testing.assert_allclose(gravity_seen, [north, east], rtol=0, atol=2 * lag)
        assert max(abs(north), abs(east)) > 50 * lag


@pytest.mark.parametrize("velocity", VELOCITIES[:4], ids=str)
def test_a_horizon_that_is_freed_of_it_stays_level_and_one_that_is_not_does_not(velocity):
    interval, pull = 2.0, float(gravity(LATITUDE))
    way = vehicle_trajectory(LATITUDE, np.tile(velocity, (1201, 1)), 0.4, interval=interval)
    middle = 0.5 * (way.latitude[1:] + way.latitude[:-1])
    rates = navigation_frame_rate(way.latitude, way.velocity)
    known = np.insert(coriolis_correction(middle, velocity), 1, 0.0, axis=-1)
    known = interval * rotate(conjugate(way.attitude[:-1]), known)

    def tilt(force):
        found = propagate_level_frame(
            LevelFrame(way.attitude[0], rates[0, [0, 2]]),
            Increments(interval, way.increments.angle, force),
            schuler_gains(),
            navigation_frame_rate(middle, velocity)[:, 1],
        )
        error = to_rotation_vector(multiply(found.attitude, conjugate(way.attitude[1:])))
        return np.abs(error[:, [0, 2]]).max()

    left, whole = tilt(way.increments.velocity - known), tilt(way.increments.velocity)
    # After forty minutes, half a swing: twice the angle at which the force stands to gravity.
    size = np.linalg.norm(coriolis_correction(LATITUDE, velocity)) / pull
    assert size < whole < 2.5 * size
    assert left < 0.01 * whole


def test_on_a_flat_earth_the_horizon_has_followed_half_of_the_force_to_the_east():
    """2 U sin(latitude) v to the North, and once to the East."""
    found = coriolis_correction(LATITUDE, [3.0, 5.0], radius=1e30)
    vertical = EARTH_RATE * np.sin(LATITUDE)
    np.testing.assert_allclose(found, [10 * vertical, -3 * vertical], rtol=4 * EPS)
