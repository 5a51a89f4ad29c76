"""Increments, and Wu (1)-(5): what a unit says, its noise, and its errors taken out again."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays

from driftlab.imu import (
    NO_ERRORS,
    TYPICAL_ERRORS,
    ImuErrors,
    ImuNoise,
    PriorStandardDeviations,
    random_imu_errors,
)
from driftlab.increments import Increments, checked_increments, compensate, measure
from support import EPS, assert_normal, matrices, numbers, vectors

BENT = np.array([[0.03, -0.08, 0.05], [0.09, -0.02, 0.07], [-0.06, 0.04, 0.01]])
OTHER = np.array([[-0.05, 0.02, 0.09], [0.03, 0.06, -0.04], [0.08, 0.01, -0.07]])
UNIT = ImuErrors(np.array([0.1, -0.2, 0.3]), BENT, np.array([-0.4, 0.5, 0.6]), OTHER)
SILENT = ImuNoise(0, 0, 0)

units = st.builds(ImuErrors, vectors(1.0), matrices(0.2), vectors(1.0), matrices(0.2))
rows = arrays(float, (4, 3), elements=numbers(1.0))


STANDING = Increments(0.25, np.zeros((20000, 3)), np.zeros((20000, 3)))


# What a unit says


@given(rows, rows, units, st.floats(1e-3, 10))
def test_unit_says_the_equations(angle, velocity, imu_errors, interval):
    """Measured rate = (I + K) rate + bias, integrated over an interval."""
    said = measure(Increments(interval, angle, velocity), imu_errors)
    for measured, true, bias, error in zip(
        said[1:], (angle, velocity), imu_errors[::2], imu_errors[1::2], strict=True
    ):
        for k in range(4):
            expected = true[k] + error @ true[k] + interval * bias
            # A few operations on numbers up to 11.
            np.testing.assert_allclose(measured[k], expected, rtol=0, atol=32 * EPS)


@given(rows, rows, units, st.floats(1e-3, 10))
def test_compensating_the_true_errors_gives_the_true_increments(
    angle, velocity, imu_errors, interval
):
    said = measure(Increments(interval, angle, velocity), imu_errors)
    found = compensate(said, imu_errors)
    # Numbers up to 11, subtracted and divided by a triad of condition below 4.
    np.testing.assert_allclose(found.angle, angle, rtol=0, atol=256 * EPS)
    np.testing.assert_allclose(found.velocity, velocity, rtol=0, atol=256 * EPS)


def test_each_of_many_units_has_its_own_errors():
    rng = np.random.default_rng(4)
    many = random_imu_errors(PriorStandardDeviations(scale_factor=0.1, installation=0.1), rng, 2, 3)
    angle, velocity = rng.normal(size=(2, 5, 3))
    true = Increments(0.1, angle, velocity)
    said = measure(true, many)
    found = compensate(said, many)
    for index in np.ndindex(2, 3):
        one = ImuErrors(*(field[index] for field in many))
        alone = measure(true, one)
        for k in (1, 2):
            np.testing.assert_allclose(said[k][index], alone[k], rtol=0, atol=16 * EPS)
            np.testing.assert_allclose(found[k][index], true[k], atol=64 * EPS)


# Noise


@pytest.mark.parametrize("interval", [0.01, 4.0])
def test_noise_is_white_and_as_large_as_stated(interval):
    """A random walk of q has a variance of q^2 t, so increments have q^2 times the interval."""
    noise = ImuNoise(angle_random_walk=3e-4, velocity_random_walk=5e-3)
    true = STANDING._replace(interval=interval)
    _, angle, velocity = measure(true, NO_ERRORS, noise, np.random.default_rng(1))
    root = np.sqrt(interval)
    assert_normal(np.hstack([angle / 3e-4, velocity / 5e-3]), root)


def test_units_draw_noise_of_their_own():
    many = random_imu_errors(PriorStandardDeviations(), np.random.default_rng(1), 4)
    true = Increments(1.0, np.zeros((5000, 3)), np.zeros((5000, 3)))
    noise = ImuNoise(1e-3, 1e-2)
    plain, noisy = measure(true, many), measure(true, many, noise, np.random.default_rng(2))
    draws = np.stack([(noisy.angle - plain.angle) / 1e-3, (noisy.velocity - plain.velocity) / 1e-2])
    # 24 columns: two kinds of sensor, four units, three axes.
    assert_normal(np.moveaxis(draws, 2, 0).reshape(5000, 24), 1.0)


@pytest.mark.parametrize("noise", [None, SILENT, ImuNoise(0, 0, 1.0)], ids=str)
def test_without_sensor_noise_no_generator_is_needed(noise):
    for one, other in zip(measure(STANDING, UNIT, noise), measure(STANDING, UNIT), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("noise", [ImuNoise(), ImuNoise(1e-3, 0.0), ImuNoise(0.0, 1e-2)], ids=str)
def test_noise_without_a_generator_is_refused(noise):
    with pytest.raises(ValueError, match=r"^rng: expected a numpy Generator .* got None\.$"):
        measure(STANDING, UNIT, noise)


# What is no row of increments


GOOD = Increments(0.1, np.zeros((4, 3)), np.zeros((4, 3)))


def test_part_is_some_of_the_intervals():
    angle, velocity = np.random.default_rng(0).normal(size=(2, 5, 7, 3))
    found = Increments(0.1, angle, velocity).part(2, 6)
    assert found.interval == 0.1
    np.testing.assert_array_equal(found.angle, angle[:, 2:6])
    np.testing.assert_array_equal(found.velocity, velocity[:, 2:6])


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        ({"interval": 0.0}, r"^increments\.interval: expected a positive number, got 0\.0\.$"),
        (
            {"velocity": np.zeros((5, 3))},
            r"^increments\.velocity: expected as many as increments\.angle, 4, got 5",
        ),
    ],
)
def test_what_is_no_row_of_increments_is_refused_by_name(bad, words):
    for refusing in (
        checked_increments,
        lambda increments: measure(increments, UNIT),
        lambda increments: compensate(increments, UNIT),
    ):
        with pytest.raises(ValueError, match=words):
            refusing(GOOD._replace(**bad))


@pytest.mark.parametrize("name", ["gyro_error_matrix", "accelerometer_error_matrix"])
def test_nothing_is_taken_out_of_a_flat_triad(name):
    errors = UNIT._replace(**{name: np.diag([0.0, 0.0, 1.0])})
    twice = compensate(measure(GOOD, errors), errors)
    np.testing.assert_allclose(twice.angle, GOOD.angle, rtol=0, atol=1e-14)
    words = f"^{name}: expected a triad I \\+ K that spans space, got a flat one"
    with pytest.raises(ValueError, match=words):
        compensate(GOOD, UNIT._replace(**{name: -np.diag([0.0, 0.0, 1.0])}))


def test_a_bare_tuple_is_refused():
    """Two arrays without their interval would otherwise be taken for an interval and an array."""
    with pytest.raises(
        ValueError, match=r"^increments: expected an Increments.*velocity.*, got a tuple\.$"
    ):
        checked_increments((GOOD.angle, GOOD.velocity))


def test_a_mean_rate_is_over_a_time():
    with pytest.raises(ValueError, match=r"^increments\.interval: expected a positive"):
        _ = Increments(0.0, np.ones((2, 3)), np.ones((2, 3))).mean_rate


def test_noise_comes_on_top_of_what_is_said():
    noise, imu_errors = ImuNoise(1e-3, 1e-2), TYPICAL_ERRORS
    true = Increments(0.1, np.ones((5, 3)), 2 * np.ones((5, 3)))
    plain = measure(true, imu_errors)
    noisy = measure(true, imu_errors, noise, np.random.default_rng(7))
    alone = measure(
        Increments(0.1, np.zeros((5, 3)), np.zeros((5, 3))),
        NO_ERRORS,
        noise,
        np.random.default_rng(7),
    )
    for total, plain_part, random in zip(noisy[1:], plain[1:], alone[1:], strict=True):
        assert (random != 0).all()
        np.testing.assert_allclose(total - plain_part, random, rtol=0, atol=8 * EPS)
