"""The levelling loop as a linear filter: its poles and responses, against closed forms."""

import numpy as np
import pytest

from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.levelling_loop import Gains, damped_gains, level_loop, schuler_gains
from support import EPS

LATITUDE = float(np.radians(51.5))
GRAVITY = float(gravity(LATITUDE))
VERTICAL_RATE = EARTH_RATE * np.sin(LATITUDE)


def test_poles_of_a_damped_loop_solve_its_equation() -> None:
    for ratio in (0.1, 0.5, 1.5):
        gains = damped_gains(0.02, GRAVITY, ratio)
        poles = level_loop(gains, GRAVITY).poles(1e-3)
        product, total = np.prod(poles), np.sum(poles)
        assert product == pytest.approx(0.02**2, rel=1e-12)
        assert total == pytest.approx(-2 * ratio * 0.02 + 1e-3j, rel=1e-12)
    plus, minus = level_loop(schuler_gains(), GRAVITY).poles(VERTICAL_RATE)
    assert plus.imag + minus.imag == pytest.approx(VERTICAL_RATE, rel=1e-9)
    assert abs(plus.real) < 16 * EPS * abs(plus)


def test_responses_to_noise_add_up_to_the_closed_form() -> None:
    """The area below |response|^2 is the variance wn/(4 zeta) of a second-order low-pass."""
    loop = level_loop(damped_gains(0.02, GRAVITY), GRAVITY)
    frequency = np.geomspace(1e-6, 10.0, 4001)
    power = np.abs(loop.gyro_bias(frequency).rate) ** 2
    area = np.trapezoid(power * frequency, np.log(frequency)) / np.pi
    assert np.sqrt(area) == pytest.approx(np.sqrt(0.02 / np.sqrt(8)), rel=1e-3)


def test_only_an_untuned_loop_with_a_log_feels_the_acceleration() -> None:
    frequency = [1e-5, 1e-3, 1.0]
    tuned = Gains(2e-4, 1 / EARTH_RADIUS)
    with_log = level_loop(tuned, GRAVITY, speed_log=True)
    assert not with_log.acceleration(frequency).rate.any()
    assert not level_loop(tuned, GRAVITY).speed_log_error(frequency).rate.any()
    stiff = Gains(2e-4, 2 / EARTH_RADIUS)
    # What is wanted in place of k2 = 1/R is felt as if it were an error of the accelerometer.
    felt = level_loop(stiff, GRAVITY, speed_log=True).acceleration(frequency).tilt
    wrong = level_loop(Gains(0.0, stiff.integral), GRAVITY).accelerometer_bias(frequency).tilt
    assert np.all(np.abs(felt) < np.abs(wrong))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"gains": Gains(-1.0, 1e-7)}, r"^gains\.proportional: expected at least 0"),
        ({"gains": Gains(0.0, 0.0)}, r"^gains\.integral: expected a positive"),
        ({"gravity": 0.0}, r"^gravity: expected m/s\^2, 1.2 to 50, got 0"),
        ({"radius": -1.0}, "^radius: expected a positive"),
    ],
)
def test_impossible_loops_are_refused(arguments: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        level_loop(**{"gains": schuler_gains(), "gravity": GRAVITY, **arguments})  # type: ignore[arg-type]


@pytest.mark.parametrize("speed_log", [False, True])
def test_responses_solve_the_equations_of_the_loop(speed_log: bool) -> None:
    """Tilt and integral turn as gravity, drift and the ship's way make them, one swing at a time.

    The horizon turns by k1 f and the integral r, which grows by k2 f, with f what is felt: g times
    the tilt, the accelerometer's error, the ship's acceleration, which the log explains to k1.
    """
    (k1, k2), g, radius = Gains(3e-3, 4e-5), 9.8, 5e4
    loop = level_loop(Gains(k1, k2), g, speed_log=speed_log, radius=radius)
    swings = np.array([1e-3, 0.02, 0.5])
    for place, swing in enumerate(swings):
        s = 1j * swing
        equations = np.array([[s + k1 * g, 1], [-k2 * g, s]])
        way = 1 / (radius * s)  # rate of the local level for an acceleration
        for response, inputs, told in (
            (loop.gyro_bias, [-1, 0], 0),
            (loop.accelerometer_bias, [-k1, k2], 0),
            (loop.acceleration, [way - (0 if speed_log else k1), k2], way),
            (loop.speed_log_error, [k1 * s if speed_log else 0, 0], 1 / radius if speed_log else 0),
        ):
            tilt, integral = np.linalg.solve(equations, np.array(inputs, complex))
            found = response(swings)
            np.testing.assert_allclose(found.tilt[place], tilt, rtol=1e-9, atol=1e-15)
            np.testing.assert_allclose(found.rate[place], told - integral, rtol=1e-9, atol=1e-15)
