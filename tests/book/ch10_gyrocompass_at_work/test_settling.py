"""Noise of a horizon that settles and then oscillates: against Lyapunov's equation."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.linalg import solve_continuous_lyapunov

from driftlab.book.ch10_gyrocompass_at_work.experiments.settling import (
    damped_rate_standard_deviation,
    schuler_deviation,
)
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.levelling import LevelFrame, propagate_level_frame
from driftlab.gyrocompass.levelling_loop import damped_gains, schuler_gains
from driftlab.increments import Increments
from driftlab.motion.vehicle import static_imu
from support import EPS

GRAVITY = float(gravity(0.0))
SCHULER = np.sqrt(GRAVITY / EARTH_RADIUS)
WALK = 3e-6
TIMES = np.array([0.0, 20.0, 300.0, 1000.0, 2532.0, 5064.0, 20000.0])
dampings = pytest.mark.parametrize("damping", [0.2, np.sqrt(0.5), 1.0, 2.0])


def loop(gains):
    """System matrix (2, 2) of tilt and integral: each turns the horizon, gravity feels the tilt."""
    return np.array([[-gains.proportional * GRAVITY, 1.0], [-gains.integral * GRAVITY, 0.0]])


DRIVE = np.diag([WALK**2, 0.0])
"""White gyro noise goes into the tilt alone."""


def responses(gains, interval, count):
    """Rates (count,) that a unit angle of the gyro about East leaves after 1, 2 ... intervals.

    The noise of a linear loop is their sum of squares. On the equator the horizon does not turn in
    azimuth, so its two swings are apart.
    """
    rate, force = (interval * part for part in static_imu([0.0, 0.0, 0.0, 1.0], 0.0))
    angle = 1e-7
    # In run j the gyro errs in the interval j before the last; in the last run never.
    gyro = np.broadcast_to(rate, (count + 1, count, 3)).copy()
    steps = np.arange(count)
    gyro[steps, count - 1 - steps, 2] += angle
    start = LevelFrame(np.array([0.0, 0.0, 0.0, 1.0]), np.array([EARTH_RATE, 0.0]))
    last = propagate_level_frame(
        start, Increments(interval, gyro, np.broadcast_to(force, gyro.shape)), gains, 0.0
    ).last
    return (last.rate[:-1, 1] - last.rate[-1, 1]) / angle


# A damped horizon


@dampings
@pytest.mark.parametrize("frequency", [0.002, 0.02])
def test_settled_deviation_solves_lyapunovs_equation(frequency, damping):
    matrix = loop(damped_gains(frequency, GRAVITY, damping))
    covariance = solve_continuous_lyapunov(matrix, -DRIVE)
    found = damped_rate_standard_deviation(WALK, frequency, damping)
    assert found == pytest.approx(np.sqrt(covariance[1, 1]), rel=1e-9)


@dampings
def test_settled_deviation_is_that_of_a_low_pass_filter(damping):
    """White noise through |1/((1 - x^2)^2 + (2 zeta x)^2)|, with x the frequency over wn."""
    area, _ = quad(lambda x: 1 / ((1 - x**2) ** 2 + (2 * damping * x) ** 2), 0, np.inf)
    # A density of N^2 on both sides, over the angular frequency: N^2/pi from 0.
    expected = WALK * np.sqrt(0.02 * area / np.pi)
    assert damped_rate_standard_deviation(WALK, 0.02, damping) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("damping", [0.5, np.sqrt(0.5), 1.2])
def test_settled_deviation_is_that_of_the_instrument(damping):
    frequency, interval = 0.02, 2.0
    answers = responses(damped_gains(frequency, GRAVITY, damping), interval, 300)
    # Noise of N sqrt(h) in each interval. The step is of second order, and so is the sum.
    simulated = WALK * np.sqrt(interval * np.sum(answers**2))
    assert simulated == pytest.approx(
        damped_rate_standard_deviation(WALK, frequency, damping), rel=5e-3
    )


def test_default_damping_is_that_of_the_tuning():
    matrix = loop(damped_gains(0.02, GRAVITY))
    covariance = solve_continuous_lyapunov(matrix, -DRIVE)
    assert damped_rate_standard_deviation(WALK, 0.02) == pytest.approx(
        np.sqrt(covariance[1, 1]), rel=1e-9
    )


# A horizon that swings


def test_schuler_deviation_solves_lyapunovs_equation_in_time():
    matrix = loop(schuler_gains())
    # Scaled, so that tilt and rate are of one size: the tilt counts in units of rate over Schuler.
    scale = np.diag([SCHULER, 1.0]) / (WALK * SCHULER)
    system = scale @ matrix @ np.linalg.inv(scale)
    drive = scale @ DRIVE @ scale

    def grows(_, state):
        covariance = state.reshape(2, 2)
        return (system @ covariance + covariance @ system.T + drive).ravel()

    solved = solve_ivp(grows, (0, TIMES[-1]), np.zeros(4), "DOP853", TIMES, rtol=1e-11, atol=1e-13)
    expected = WALK * SCHULER * np.sqrt(np.maximum(solved.y[3], 0))
    found = schuler_deviation(WALK, TIMES, GRAVITY)
    np.testing.assert_allclose(found, expected, rtol=1e-7, atol=0)


def test_schuler_deviation_is_that_of_the_instrument():
    interval, count = 10.0, 400
    answers = responses(schuler_gains(), interval, count)
    simulated = WALK * np.sqrt(interval * np.cumsum(answers**2))
    times = interval * np.arange(1, count + 1)
    expected = schuler_deviation(WALK, times, GRAVITY)
    later = times > 300
    # A tilt about East also turns with the Earth, which makes the swing faster by half of this.
    allowed = (EARTH_RATE / SCHULER) ** 2
    np.testing.assert_allclose(simulated[later], expected[later], rtol=allowed)


def test_schuler_deviation_grows_with_the_square_root_of_the_time():
    """In whole halves of a swing exactly: as a random walk of N ws/sqrt(2)."""
    halves = np.pi / SCHULER * np.array([[1, 2, 3], [10, 100, 1000]])
    found = schuler_deviation(WALK, halves, GRAVITY)
    assert found.shape == (2, 3)
    np.testing.assert_allclose(found, WALK * SCHULER * np.sqrt(halves / 2), rtol=1e-9)


def test_schuler_deviation_begins_with_the_tilt_that_noise_leaves():
    """N ws^2 sqrt(t^3/3): a random walk of the tilt, integrated."""
    times = np.array([5.0, 10.0])
    expected = WALK * SCHULER**2 * np.sqrt(times**3 / 3)
    # The next term of the series is smaller by (ws t)^2/5.
    np.testing.assert_allclose(schuler_deviation(WALK, times, GRAVITY), expected, rtol=1e-4)
    assert schuler_deviation(WALK, np.zeros(1), GRAVITY) == 0


def test_radius_and_gravity_count_as_schulers_frequency():
    found = schuler_deviation(WALK, TIMES, 4 * GRAVITY)
    np.testing.assert_allclose(
        found, schuler_deviation(WALK, TIMES, GRAVITY, EARTH_RADIUS / 4), rtol=64 * EPS
    )
    # Twice the frequency is half of the time scale.
    np.testing.assert_allclose(
        found[1:], np.sqrt(2) * schuler_deviation(WALK, 2 * TIMES[1:], GRAVITY), rtol=1e-6
    )
