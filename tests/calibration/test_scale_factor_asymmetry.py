"""Scale-factor asymmetry, against a simulation in fine steps that shares nothing with the model."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import g, micro

from driftlab.calibration import ERROR_MODELS, calibrate, from_json, innovation_test, to_json
from driftlab.higher_order_errors import NO_HIGHER_ORDER_ERRORS, higher_order_effects
from driftlab.imu import TYPICAL_ERRORS, ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments, compensate, measure
from driftlab.motion import NINETEEN_POSITIONS, turntable_trajectory

LATITUDE = 0.7
STATES = "gyro scale-factor asymmetry", "accelerometer scale-factor asymmetry"
MODEL = ERROR_MODELS["averaged"].with_states(*STATES)
TRUE = NO_HIGHER_ORDER_ERRORS._replace(
    gyro_scale_factor_asymmetry=np.array([30.0, -20.0, 10.0]) * micro,
    accelerometer_scale_factor_asymmetry=np.array([-15.0, 25.0, 5.0]) * micro,
)
NOISE = ImuNoise(reference_velocity=1e-4)
FINE, MANY = 0.025, 10  # s, and so many fine steps in an increment


def sensed(rate, bias, matrix, asymmetry):
    """What a triad shows of rates or forces (n, 3): each sensor by its own two scale factors."""
    shown = np.empty_like(rate)
    for i, row in enumerate(np.eye(3) + matrix):
        halves = np.where(rate >= 0, 1 + asymmetry, 1 - asymmetry)  # positive and negative input
        shown[:, i] = (rate * halves) @ row + bias[i]
    return shown


@pytest.fixture(scope="module")
def log():
    """A unit on a table in fine steps, with noise, added up to increments of a quarter second."""
    scheme = replace(NINETEEN_POSITIONS, dwell=60.0)
    fine = turntable_trajectory(scheme, LATITUDE, FINE, multiple_of=2 * MANY)
    rng = np.random.default_rng(4)
    errors = TYPICAL_ERRORS
    rows = []
    for true, bias, matrix, asymmetry, walk in (
        (fine.increments.angle, errors.gyro_bias, errors.gyro_error_matrix,
         TRUE.gyro_scale_factor_asymmetry, NOISE.angle_random_walk),
        (fine.increments.velocity, errors.accelerometer_bias, errors.accelerometer_error_matrix,
         TRUE.accelerometer_scale_factor_asymmetry, NOISE.velocity_random_walk),
    ):  # fmt: skip
        shown = FINE * sensed(true / FINE, bias, matrix, asymmetry)
        shown += walk * np.sqrt(FINE) * rng.standard_normal(shown.shape)
        rows.append(shown.reshape(-1, MANY, 3).sum(axis=1))
    reference = NOISE.reference_velocity * rng.standard_normal((len(rows[0]) // 8, 3))
    return fine, Increments(MANY * FINE, *rows), reference


def calibrated(log, model, **more):
    fine, increments, reference = log
    return calibrate(
        increments, reference, latitude=LATITUDE, start=fine.attitude[0], model=model,
        noise=NOISE, prior=PriorStandardDeviations(scale_factor_asymmetry=30 * micro), **more,
    )  # fmt: skip


def test_the_filter_finds_it_and_without_its_states_is_wrong(log):
    found = calibrated(log, MODEL)
    assert innovation_test(found).verdict == "consistent"
    errors = found.state[-1] - MODEL.state(TYPICAL_ERRORS, TRUE)
    standard_deviations = found.standard_deviations[-1]
    # The axes of the model and of the table differ by half an arc minute: second order.
    states = [k for k, name in enumerate(MODEL.names) if "asymmetry" in name]
    assert len(states) == 6
    assert np.abs(errors[states] / standard_deviations[states]).max() < 4
    assert (standard_deviations[states[:3]] < 2 * micro).all()
    scale = [k for k, name in enumerate(MODEL.names) if name.startswith("gyro scale x")]
    assert np.abs(errors[scale] / standard_deviations[scale]).max() < 4
    plain = calibrated(log, ERROR_MODELS["averaged"], check=False)
    assert innovation_test(plain).verdict == "wrong"


def test_what_is_found_goes_through_json(log):
    found = calibrated(log, MODEL, keep=10**6)
    kept = from_json(to_json(found)).higher_order
    np.testing.assert_array_equal(
        kept.gyro_scale_factor_asymmetry,
        found.model.higher_order_errors(found.state[-1]).gyro_scale_factor_asymmetry,
    )
    assert "lever_arms" not in to_json(found)
    assert '"unit": "1"' in to_json(found).split("gyro_scale_factor_asymmetry")[1][:30]


def test_increments_of_one_direction_are_exact_and_compensation_is_the_inverse():
    rng = np.random.default_rng(1)
    true = Increments(0.1, 0.01 * rng.standard_normal((50, 3)), g * rng.standard_normal((50, 3)))
    expected = [
        0.1 * sensed(rows / 0.1, bias, matrix, asymmetry)
        for rows, bias, matrix, asymmetry in (
            (true.angle, TYPICAL_ERRORS.gyro_bias, TYPICAL_ERRORS.gyro_error_matrix,
             TRUE.gyro_scale_factor_asymmetry),
            (true.velocity, TYPICAL_ERRORS.accelerometer_bias,
             TYPICAL_ERRORS.accelerometer_error_matrix, TRUE.accelerometer_scale_factor_asymmetry),
        )
    ]  # fmt: skip
    shown = measure(true, TYPICAL_ERRORS, higher_order=TRUE)
    for found, right in zip((shown.angle, shown.velocity), expected, strict=True):
        # Some eight operations on either side, in another order.
        rounding = 16 * np.finfo(float).eps * np.abs(right).max()
        np.testing.assert_allclose(found, right, rtol=0, atol=rounding)
    back = compensate(shown, TYPICAL_ERRORS, higher_order=TRUE)
    # To the third order in 30 ppm.
    np.testing.assert_allclose(back.velocity, true.velocity, rtol=0, atol=1e-12)


@pytest.mark.parametrize("back", [0.0, 0.1, 0.3])
def test_a_sign_that_changes_within_an_interval_is_missed_by_the_smaller_part_twice(back):
    """A sensor that turns by 1 - back, and back again by back."""
    angle = np.array([[1 - 2 * back, 0.0, 0.0]])
    felt, _ = higher_order_effects(1.0, angle, np.zeros((1, 3)), TRUE)
    size = TRUE.gyro_scale_factor_asymmetry[0]
    np.testing.assert_allclose(size - felt[0, 0], 2 * size * back, rtol=0, atol=1e-18)
