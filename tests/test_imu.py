"""Errors of an inertial unit, how large they may be, and what is refused."""

from dataclasses import FrozenInstanceError, fields

import numpy as np
import pytest
from scipy.constants import g

from driftlab.imu import (
    TYPICAL_ERRORS,
    ImuErrors,
    ImuNoise,
    PriorStandardDeviations,
    random_imu_errors,
)
from support import assert_normal

BENT = np.array([[0.03, -0.08, 0.05], [0.09, -0.02, 0.07], [-0.06, 0.04, 0.01]])
OTHER = np.array([[-0.05, 0.02, 0.09], [0.03, 0.06, -0.04], [0.08, 0.01, -0.07]])
UNIT = ImuErrors(np.array([0.1, -0.2, 0.3]), BENT, np.array([-0.4, 0.5, 0.6]), OTHER)

every_field = pytest.mark.parametrize("name", ImuErrors._fields)


# Random units


def test_random_units_are_as_large_as_their_spread():
    prior = PriorStandardDeviations(
        1e-3, gyro_bias=0.2, accelerometer_bias=3.0, scale_factor=0.5, installation=0.7
    )
    many = random_imu_errors(prior, np.random.default_rng(6), 100, 50)
    sizes = np.where(np.eye(3) == 1, 0.5, 0.7)
    values = np.concatenate(
        [
            many.gyro_bias / 0.2,
            (many.gyro_error_matrix / sizes).reshape(100, 50, 9),
            many.accelerometer_bias / 3,
            (many.accelerometer_error_matrix / sizes).reshape(100, 50, 9),
        ],
        axis=-1,
    )
    assert_normal(values.reshape(5000, 24), 1.0)


# Sizes in the units of the field, each written out here once more


ARC_SECOND = np.pi / 180 / 3600
HOURLY = np.pi / 180 / 3600  # degree per hour, rad/s


def test_typical_unit_in_engineering_units():
    """Sizes of the PSINS toolbox: recovered.md, section 3."""
    np.testing.assert_allclose(TYPICAL_ERRORS.gyro_bias / HOURLY, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(TYPICAL_ERRORS.accelerometer_bias / g * 1e6, [10, 20, 30])
    off = ~np.eye(3, dtype=bool)
    for matrix, installation in (
        (TYPICAL_ERRORS.gyro_error_matrix, [10, 20, 30, 40, 50, 60]),
        (TYPICAL_ERRORS.accelerometer_error_matrix, [10, 20, 30, 10, 20, 30]),
    ):
        np.testing.assert_allclose(np.diag(matrix) * 1e6, [10, 20, 30])
        np.testing.assert_allclose(matrix[off] / ARC_SECOND, installation)


def test_default_noise_and_spread_in_engineering_units():
    noise, prior = ImuNoise(), PriorStandardDeviations()
    # 0.005 degrees after one hour.
    assert noise.angle_random_walk * np.sqrt(3600) == pytest.approx(np.radians(0.005))
    assert noise.velocity_random_walk / g * 1e6 == pytest.approx(5)
    assert noise.reference_velocity == 0.01
    assert prior.attitude / ARC_SECOND == pytest.approx(60)
    assert prior.gyro_bias / HOURLY == pytest.approx(0.3)
    assert prior.accelerometer_bias / g * 1e6 == pytest.approx(300)
    assert prior.scale_factor * 1e6 == pytest.approx(100)
    assert prior.installation / ARC_SECOND == pytest.approx(40)
    assert prior.lever_arm == 0.03
    assert prior.time_skew == 0.001
    assert prior.accelerometer_quadratic * g**2 == pytest.approx(10e-6 * g)
    assert prior.gyro_g_sensitivity * g / HOURLY == pytest.approx(0.1)


# Refusals


@pytest.mark.parametrize(
    ("kind", "name"),
    [(kind, field.name) for kind in (ImuNoise, PriorStandardDeviations) for field in fields(kind)],
)
def test_sizes_that_are_no_deviations_are_refused_by_name(kind, name):
    with pytest.raises(
        ValueError, match=rf"^{name}: expected a number of at least 0, got -1e-09\.$"
    ):
        kind(**{name: -1e-9})
    good = kind(**{name: 0})
    with pytest.raises(FrozenInstanceError):
        setattr(good, name, 1.0)
