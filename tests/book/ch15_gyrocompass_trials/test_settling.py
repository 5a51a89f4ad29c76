"""Noise of a horizon that settles and then oscillates: against Lyapunov's equation."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import solve_continuous_lyapunov

from driftlab.book.ch15_gyrocompass_trials.experiments.settling import (
    damped_rate_standard_deviation,
    schuler_deviation,
)
from driftlab.earth import EARTH_RADIUS, gravity
from driftlab.gyrocompass.levelling_loop import damped_gains, schuler_gains

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


# A damped horizon


@dampings
@pytest.mark.parametrize("frequency", [0.002, 0.02])
def test_settled_deviation_solves_lyapunovs_equation(frequency, damping):
    matrix = loop(damped_gains(frequency, GRAVITY, damping))
    covariance = solve_continuous_lyapunov(matrix, -DRIVE)
    found = damped_rate_standard_deviation(WALK, frequency, damping)
    assert found == pytest.approx(np.sqrt(covariance[1, 1]), rel=1e-9)


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


def test_schuler_deviation_grows_with_the_square_root_of_the_time():
    """In whole halves of a swing exactly: as a random walk of N ws/sqrt(2)."""
    halves = np.pi / SCHULER * np.array([[1, 2, 3], [10, 100, 1000]])
    found = schuler_deviation(WALK, halves, GRAVITY)
    assert found.shape == (2, 3)
    np.testing.assert_allclose(found, WALK * SCHULER * np.sqrt(halves / 2), rtol=1e-9)
