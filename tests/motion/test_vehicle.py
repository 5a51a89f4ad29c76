"""Sensor increments of a voyage against differences of positions in inertial space."""

import numpy as np
import pytest

from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import from_euler_angles, navigation_frame_rate
from driftlab.motion.vehicle import smooth_step, static_imu, vehicle_trajectory
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotate

LATITUDE, GRAVITY = 0.9, 9.81


def test_at_rest_the_increments_are_those_of_a_body_at_rest():
    attitude = from_euler_angles(0.5, -0.3, 0.2)
    found = vehicle_trajectory(LATITUDE, np.zeros((5, 2)), 0.5, -0.3, 0.2, interval=0.5)
    rate, force = static_imu(attitude, LATITUDE)
    assert np.allclose(found.increments.angle, 0.5 * rate, rtol=1e-9, atol=1e-18)
    assert np.allclose(found.increments.velocity, 0.5 * force, rtol=1e-9, atol=1e-15)
    assert np.allclose(found.attitude, attitude)
    assert np.array_equal(found.times, [0, 0.5, 1, 1.5, 2])


def test_angle_increments_of_a_level_voyage_are_the_rate_of_the_local_axes():
    velocity = np.broadcast_to([20.0, 30.0], (11, 2))
    found = vehicle_trajectory(LATITUDE, velocity, 0.0, interval=1.0)
    middle = 0.5 * (found.latitude[1:] + found.latitude[:-1])
    expected = navigation_frame_rate(middle, velocity[1:])
    assert np.allclose(found.increments.angle, expected, rtol=1e-8, atol=1e-16)


def test_specific_force_is_acceleration_in_inertial_space_minus_gravitation():
    """Differences of the position vector know nothing of Coriolis terms."""
    times = np.arange(2001) * 0.1
    speed = np.stack([30 * np.sin(0.05 * times), 40 + 20 * np.cos(0.03 * times)], axis=-1)
    found = vehicle_trajectory(LATITUDE, speed, 0.0, interval=0.1, gravity=GRAVITY)
    # Positions by the motion's own integrals, in closed form.
    north = 30 / 0.05 * (1 - np.cos(0.05 * times))
    place = LATITUDE + north / EARTH_RADIUS
    east_rate = (40 + 20 * np.cos(0.03 * times)) / (EARTH_RADIUS * np.cos(place))
    steps = 0.05 * (east_rate[1:] + east_rate[:-1])
    longitude = EARTH_RATE * times + np.concatenate([[0.0], np.cumsum(steps)])
    up = np.stack(
        [np.cos(place) * np.cos(longitude), np.cos(place) * np.sin(longitude), np.sin(place)],
        axis=-1,
    )
    acceleration = EARTH_RADIUS * np.diff(up, n=2, axis=0) / 0.01
    axis = np.array([0.0, 0.0, EARTH_RATE])
    here = up[1:-1]
    # What is called gravity has the centrifugal part of the turning Earth in it.
    gravitation = -GRAVITY * here + np.cross(axis, np.cross(axis, EARTH_RADIUS * here))
    force = acceleration - gravitation
    east = np.stack([-np.sin(longitude), np.cos(longitude), 0 * longitude], axis=-1)[1:-1]
    local = np.stack(
        [np.sum(force * axis, axis=-1) for axis in (np.cross(here, east), here, east)], axis=-1
    )
    middle = 0.5 * (found.increments.velocity[1:] + found.increments.velocity[:-1]) / 0.1
    # Second differences of 6.4e6 m lose digits: 1e-9 m of rounding over 0.01 s^2.
    assert np.abs(middle - local).max() < 2e-5 + 1e-3 * 0.1**2


def test_body_increments_are_local_ones_seen_from_the_body():
    velocity = np.stack([np.linspace(0, 5, 21), np.linspace(0, -3, 21)], axis=-1)
    level = vehicle_trajectory(LATITUDE, velocity, 0.0, interval=0.5)
    tilted = vehicle_trajectory(LATITUDE, velocity, 0.6, 0.3, -0.2, interval=0.5)
    back = conjugate(from_euler_angles(0.6, 0.3, -0.2))
    for name in ("angle", "velocity"):
        expected = rotate(back, getattr(level.increments, name))
        assert np.allclose(getattr(tilted.increments, name), expected, rtol=1e-9, atol=1e-13)


def test_smooth_step_rises_once():
    times = np.linspace(0, 10, 1001)
    rise = smooth_step(times, 2.0, 5.0)
    assert (rise[times <= 2] == 0).all()
    assert (rise[times >= 7] == 1).all()
    assert (np.diff(rise) >= 0).all()
    assert np.abs(np.diff(rise, n=2)).max() < 1.01 * 5.7735 / 25 * 0.01**2


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"latitude": np.pi / 2}, "^latitude: expected at most 89.9 degrees"),
        ({"velocity": np.zeros((1, 2))}, r"^velocity: expected shape \(n \+ 1, 2\)"),
        ({"velocity": np.zeros((2, 3, 2))}, r"^velocity: expected shape \(n \+ 1, 2\)"),
        ({"interval": 0.0}, "^interval: expected a positive number"),
        ({"gravity": -9.8}, "^gravity: expected m/s\\^2, 1.2 to 50, got -9.8"),
        ({"radius": 0.0}, "^radius: expected a positive number"),
        ({"heading": np.zeros((5, 1))}, r"^heading: expected shape \(n \+ 1,\)"),
        ({"pitch": np.zeros((1, 5))}, r"^pitch: expected shape \(n \+ 1,\)"),
    ],
)
def test_refusals(arguments, words):
    good = {"latitude": 0.9, "velocity": np.zeros((5, 2)), "heading": 0.0, "interval": 1.0}
    with pytest.raises(ValueError, match=words):
        vehicle_trajectory(**{**good, **arguments})


def test_a_way_over_the_pole_is_refused():
    with pytest.raises(ValueError, match=r"^latitude: expected at most 89.9 degrees"):
        vehicle_trajectory(1.5, np.broadcast_to([100.0, 0.0], (101, 2)), 0.0, interval=60.0)


def test_any_radius_will_do():
    """A small planet: everything that has R in it is larger."""
    velocity, radius = np.broadcast_to([20.0, 30.0], (11, 2)), 1e5
    found = vehicle_trajectory(0.5, velocity, 0.0, interval=1.0, gravity=GRAVITY, radius=radius)
    assert found.latitude[-1] == pytest.approx(0.5 + 200.0 / radius)
    middle = 0.5 * (found.latitude[1:] + found.latitude[:-1])
    rate = navigation_frame_rate(middle, velocity[1:], radius)
    assert np.allclose(found.increments.angle, rate, rtol=1e-6)
    turn = rate + navigation_frame_rate(middle)
    moving = np.array([20.0, 0.0, 30.0])
    expected = np.array([0.0, GRAVITY, 0.0]) + np.cross(turn, moving)
    assert np.allclose(found.increments.velocity, expected, rtol=0, atol=2e-6)


def test_increments_of_a_turning_body_are_means_of_a_force_that_stands_still():
    """Against a sum over many small parts of the interval; the angle is a large one."""
    heading, pitch, roll = [0.0, 0.15], [0.0, 0.1], [0.0, -0.1]
    # In a thousandth of a second the Earth turns by nothing that matters.
    found = vehicle_trajectory(LATITUDE, np.zeros((2, 2)), heading, pitch, roll, interval=1e-3)
    fractions = (np.arange(2000) + 0.5) / 2000
    turned = from_rotation_vector(fractions[:, np.newaxis] * found.increments.angle[0])
    body = multiply(found.attitude[0], turned)
    force = static_imu(body, LATITUDE)[1].mean(axis=0)
    angle = np.linalg.norm(found.increments.angle[0])
    mean = found.increments.velocity[0] / 1e-3
    assert np.allclose(mean, force, rtol=0, atol=9.8 * angle**4 / 200)
