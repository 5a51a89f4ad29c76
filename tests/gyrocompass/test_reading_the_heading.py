"""The heading of a damped compass, from the integrals: its formula, and pulses that count."""

import numpy as np
import pytest
from scipy.constants import arcminute, degree, hour, milli

from driftlab.book.scenarios import ship_manoeuvre
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.frames import to_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.heading_error import operating_heading_error
from driftlab.gyrocompass.levelling import initial_level_frame, propagate_level_frame
from driftlab.gyrocompass.levelling_loop import Gains, damped_gains
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.increments import Increments
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import rotate
from support import largest

DRIFT = np.array([0.03, 0.05, -0.04]) * degree / hour


@pytest.mark.parametrize("speed_log", [False, True])
@pytest.mark.parametrize("damping", [0.3, 0.9])
def test_the_formula_of_a_damped_compass_needs_the_proportional_part(damping, speed_log):
    """A fast craft with drifts and offsets, set out with a tilt, gathers way and turns."""
    way = ship_manoeuvre(speed=20.0, course=0.4, turn=1.2, interval=2.0, pitch=0.6)
    run = simulate_gyrocompass(
        way,
        DRIFT,
        [2e-4, 0.0, -3e-4],
        damping=damping,
        tilt=arcminute,
        speed_log=speed_log,
        tuning_factor=1.05,
    )
    left = run.heading_error - run.formula.heading
    # Of second order: the compass's North is off by the speed error and by its own.
    angles = largest(run.heading_error) + largest(run.yaw_error) + largest(run.tilt)
    assert largest(left) < (angles + (0 if speed_log else largest(run.speed_error))) ** 2
    # The paper's formula is that of another compass, which reads the whole rate.
    whole = _of_whole_rates(run, way, DRIFT)
    assert largest(run.heading_error - whole) > 10 * largest(left)


def _of_whole_rates(run, way, drift):
    """Heading errors (n,) by the paper's formula, from what the simulation has."""
    attitude = way.attitude[1:]

    heading, pitch, _ = to_euler_angles(attitude)
    rates = np.gradient(run.tilt, way.increments.interval, axis=0)
    bias = rotate(attitude, drift)[:, [0, 2]]
    return operating_heading_error(
        way.latitude[1:], way.velocity[1:], run.tilt, rates, bias, run.yaw_error, heading, pitch
    ).heading


def test_without_a_proportional_gain_both_rates_are_one():
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], 0.9)
    increments = Increments(1.0, *(np.tile(part, (20, 1)) for part in (rate, force + 1e-4)))
    run = propagate_level_frame(
        initial_level_frame(align(rate, force)), increments, Gains(0.0, 1 / EARTH_RADIUS), rate[1]
    )
    np.testing.assert_array_equal(run.horizon_rate, run.rate)
    assert not run.proportional_rate.any()


def test_pulses_of_an_accelerometer_do_not_reach_the_heading():
    """Velocities in whole pulses of 1.2 mm/s, a hundred times a second, at rest."""
    pulse, interval, frequency, latitude = 1.2 * milli, 0.01, 0.02, 0.9
    pull, level_rate = float(gravity(latitude)), EARTH_RATE * np.cos(latitude)
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], latitude)
    count, rng = round(600 / interval), np.random.default_rng(20)
    # Noise makes the counts what they are on a real one: now one, now none.
    truth = interval * force * np.arange(1, count + 1)[:, np.newaxis]
    noisy = truth + pulse * rng.standard_normal((count, 3))
    velocity = np.diff(pulse * np.round(noisy / pulse), axis=0, prepend=0.0)
    gains = damped_gains(frequency, pull)
    run = propagate_level_frame(
        initial_level_frame(align(rate, force)),
        Increments(interval, np.tile(interval * rate, (count, 1)), velocity),
        gains,
        rate[1],
        every=10,
    )
    late = run.times > 200
    # One pulse in one interval, times k1, is more than the Earth's level rate.
    assert gains.proportional * pulse / interval > 5 * level_rate
    whole = np.arctan2(*np.moveaxis(run.horizon_rate, -1, 0)[::-1])
    assert np.degrees(np.std(whole[late])) > 60
    # The velocity itself is off by at most 1.5 pulses or so; k2 times it is what the integral errs.
    assert largest(run.heading[late]) < 6 * pulse * gains.integral / level_rate
    assert np.degrees(np.std(run.heading[late])) < 0.1
