"""Wu (1)-(5): what a unit says, its noise, and its errors taken out again."""

from dataclasses import FrozenInstanceError, fields

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.constants import g
from scipy.stats import chi2

from driftlab.imu import (
    PERFECT,
    TYPICAL,
    Noise,
    Spread,
    Unit,
    checked_unit,
    compensate,
    measure,
    random_units,
)
from driftlab.motion.turntable import Record
from support import EPS, matrices, numbers, vectors

BENT = np.array([[0.03, -0.08, 0.05], [0.09, -0.02, 0.07], [-0.06, 0.04, 0.01]])
OTHER = np.array([[-0.05, 0.02, 0.09], [0.03, 0.06, -0.04], [0.08, 0.01, -0.07]])
UNIT = Unit(np.array([0.1, -0.2, 0.3]), BENT, np.array([-0.4, 0.5, 0.6]), OTHER)
SILENT = Noise(0, 0, 0)

units = st.builds(Unit, vectors(1.0), matrices(0.2), vectors(1.0), matrices(0.2))
rows = arrays(float, (4, 3), elements=numbers(1.0))
every_field = pytest.mark.parametrize("name", Unit._fields)


def record_of(angle, velocity, interval):
    """A record of these increments; sensors do not ask for the attitude."""
    return Record(interval, np.asarray(angle), np.asarray(velocity), np.zeros((len(angle) + 1, 4)))


STANDING = record_of(np.zeros((20000, 3)), np.zeros((20000, 3)), 0.25)


def assert_normal(values, deviation):
    """Values (n, m): rows and columns independent, of mean zero and this standard deviation.

    Each bound is passed by chance once in a million draws; the seeds are fixed.
    """
    unit = values / deviation
    low, high = chi2.ppf([0.5e-6, 1 - 0.5e-6], len(unit)) / len(unit)
    squares = (unit**2).mean(axis=0)
    assert (low < squares).all()
    assert (squares < high).all()
    # Means and correlations of n normal numbers have deviations of 1/sqrt(n); 4.9 of them.
    bound = 4.9 / np.sqrt(len(unit))
    assert (np.abs(unit.mean(axis=0)) < bound).all()
    products = unit.T @ unit / len(unit)
    assert (np.abs(products[np.triu_indices(unit.shape[1], 1)]) < bound).all()
    assert (np.abs((unit[1:] * unit[:-1]).mean(axis=0)) < bound).all()


# What a unit says


@given(rows, rows, units, st.floats(1e-3, 10))
def test_unit_says_the_equations(angle, velocity, unit, interval):
    """Measured rate = (E + K) rate + bias, integrated over an interval."""
    said = measure(record_of(angle, velocity, interval), unit)
    for measured, true, bias, error in zip(
        said, (angle, velocity), unit[::2], unit[1::2], strict=True
    ):
        for k in range(4):
            expected = true[k] + error @ true[k] + interval * bias
            # A few operations on numbers up to 11.
            np.testing.assert_allclose(measured[k], expected, rtol=0, atol=32 * EPS)


@given(rows, rows, units, st.floats(1e-3, 10))
def test_compensating_the_true_errors_gives_the_true_increments(angle, velocity, unit, interval):
    said = measure(record_of(angle, velocity, interval), unit)
    found = compensate(*said, unit, interval)
    # Numbers up to 11, subtracted and divided by a triad of condition below 4.
    np.testing.assert_allclose(found[0], angle, rtol=0, atol=256 * EPS)
    np.testing.assert_allclose(found[1], velocity, rtol=0, atol=256 * EPS)


def test_compensation_undoes_the_matrix_after_the_bias():
    """In this order: a bias is what the sensor says at rest, not what it senses."""
    ones = np.ones((1, 3))
    found = compensate(ones, 2 * ones, UNIT, 0.5)
    np.testing.assert_allclose(
        (np.eye(3) + BENT) @ found[0][0] + 0.5 * UNIT.gyro_bias, ones[0], rtol=4 * EPS
    )
    np.testing.assert_allclose(
        (np.eye(3) + OTHER) @ found[1][0] + 0.5 * UNIT.accelerometer_bias, 2 * ones[0], rtol=8 * EPS
    )


@given(rows, rows)
def test_perfect_unit_says_the_truth(angle, velocity):
    said = measure(record_of(angle, velocity, 0.1), PERFECT)
    np.testing.assert_array_equal(said, [angle, velocity])
    np.testing.assert_array_equal(compensate(angle, velocity, PERFECT, 0.1), [angle, velocity])


def test_each_of_many_units_has_its_own_errors():
    rng = np.random.default_rng(4)
    many = random_units(Spread(scale=0.1, installation=0.1), rng, 2, 3)
    angle, velocity = rng.normal(size=(2, 5, 3))
    record = record_of(angle, velocity, 0.1)
    said = measure(record, many)
    found = compensate(*said, many, 0.1)
    for index in np.ndindex(2, 3):
        one = Unit(*(field[index] for field in many))
        alone = measure(record, one)
        for k in range(2):
            np.testing.assert_allclose(said[k][index], alone[k], rtol=0, atol=16 * EPS)
            np.testing.assert_allclose(found[k][index], (angle, velocity)[k], atol=64 * EPS)


def test_measuring_leaves_the_record_alone():
    record = record_of(np.ones((4, 3)), np.ones((4, 3)), 0.1)
    for rows_of_record in record[1:3]:
        rows_of_record.setflags(write=False)
    measure(record, UNIT, Noise(1.0, 1.0), np.random.default_rng(0))


# Noise


@pytest.mark.parametrize("interval", [0.01, 4.0])
def test_noise_is_white_and_as_large_as_stated(interval):
    """A random walk of q has a variance of q^2 t, so increments have q^2 times the interval."""
    noise = Noise(angle_random_walk=3e-3, velocity_random_walk=5e-2)
    record = STANDING._replace(interval=interval)
    angle, velocity = measure(record, PERFECT, noise, np.random.default_rng(1))
    root = np.sqrt(interval)
    assert_normal(np.hstack([angle / 3e-3, velocity / 5e-2]), root)


def test_noise_comes_on_top_of_what_is_said():
    noise, unit = Noise(1e-3, 1e-2), TYPICAL
    record = record_of(np.ones((5, 3)), 2 * np.ones((5, 3)), 0.1)
    plain = measure(record, unit)
    noisy = measure(record, unit, noise, np.random.default_rng(7))
    alone = measure(record._replace(angle_increments=np.zeros((5, 3)),
                                    velocity_increments=np.zeros((5, 3))),
                    PERFECT, noise, np.random.default_rng(7))  # fmt: skip
    for total, said, random in zip(noisy, plain, alone, strict=True):
        assert (random != 0).all()
        np.testing.assert_allclose(total - said, random, rtol=0, atol=8 * EPS)


def test_units_draw_noise_of_their_own():
    many = random_units(Spread(), np.random.default_rng(1), 4)
    record = record_of(np.zeros((5000, 3)), np.zeros((5000, 3)), 1.0)
    noise = Noise(1.0, 1.0)
    plain, noisy = measure(record, many), measure(record, many, noise, np.random.default_rng(2))
    draws = np.stack(noisy) - np.stack(plain)
    # 24 columns: two kinds of sensor, four units, three axes.
    assert_normal(np.moveaxis(draws, 2, 0).reshape(5000, 24), 1.0)


def test_same_seed_gives_the_same_noise():
    said = [measure(STANDING, TYPICAL, Noise(), np.random.default_rng(5)) for _ in range(2)]
    np.testing.assert_array_equal(*said)


@pytest.mark.parametrize("noise", [None, SILENT, Noise(0, 0, 1.0)], ids=str)
def test_without_sensor_noise_no_generator_is_needed(noise):
    np.testing.assert_array_equal(measure(STANDING, UNIT, noise), measure(STANDING, UNIT))


@pytest.mark.parametrize("noise", [Noise(), Noise(1.0, 0.0), Noise(0.0, 1.0)], ids=str)
def test_noise_without_a_generator_is_refused(noise):
    with pytest.raises(ValueError, match=r"^rng: expected a numpy Generator .* got None\.$"):
        measure(STANDING, UNIT, noise)


# Random units


def test_random_units_are_as_large_as_their_spread():
    spread = Spread(1e-3, gyro_bias=2.0, accelerometer_bias=3.0, scale=5.0, installation=7.0)
    many = random_units(spread, np.random.default_rng(6), 100, 50)
    sizes = np.where(np.eye(3) == 1, 5.0, 7.0)
    values = np.concatenate(
        [
            many.gyro_bias / 2,
            (many.gyro_error / sizes).reshape(100, 50, 9),
            many.accelerometer_bias / 3,
            (many.accelerometer_error / sizes).reshape(100, 50, 9),
        ],
        axis=-1,
    )
    assert_normal(values.reshape(5000, 24), 1.0)


@pytest.mark.parametrize("shape", [(), (4,), (2, 3)], ids=str)
def test_random_units_have_the_shape_that_was_asked_for(shape):
    many = random_units(Spread(), np.random.default_rng(0), *shape)
    for field, plain in zip(many, PERFECT, strict=True):
        assert field.shape == shape + plain.shape


def test_units_without_spread_are_perfect():
    unit = random_units(Spread(0, 0, 0, 0, 0), np.random.default_rng(0))
    for field, expected in zip(unit, PERFECT, strict=True):
        np.testing.assert_array_equal(field, expected)


# Sizes in the units of the field, each written out here once more


ARC_SECOND = np.pi / 180 / 3600
HOURLY = np.pi / 180 / 3600  # degree per hour, rad/s


def test_typical_unit_in_engineering_units():
    """Sizes of the PSINS toolbox: recovered.md, section 3."""
    np.testing.assert_allclose(TYPICAL.gyro_bias / HOURLY, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(TYPICAL.accelerometer_bias / g * 1e6, [10, 20, 30])
    off = ~np.eye(3, dtype=bool)
    for matrix, installation in (
        (TYPICAL.gyro_error, [10, 20, 30, 40, 50, 60]),
        (TYPICAL.accelerometer_error, [10, 20, 30, 10, 20, 30]),
    ):
        np.testing.assert_allclose(np.diag(matrix) * 1e6, [10, 20, 30])
        np.testing.assert_allclose(matrix[off] / ARC_SECOND, installation)


def test_default_noise_and_spread_in_engineering_units():
    noise, spread = Noise(), Spread()
    # 0.005 degrees after one hour.
    assert noise.angle_random_walk * np.sqrt(3600) == pytest.approx(np.radians(0.005))
    assert noise.velocity_random_walk / g * 1e6 == pytest.approx(5)
    assert noise.velocity == 0.01
    assert spread.attitude / ARC_SECOND == pytest.approx(60)
    assert spread.gyro_bias / HOURLY == pytest.approx(0.3)
    assert spread.accelerometer_bias / g * 1e6 == pytest.approx(300)
    assert spread.scale * 1e6 == pytest.approx(100)
    assert spread.installation / ARC_SECOND == pytest.approx(40)


def test_typical_unit_is_one_that_the_spread_can_draw():
    """A filter that is told the default spread must not be surprised: all within three of it."""
    spread = Spread()
    installation = np.where(np.eye(3) == 1, spread.scale, spread.installation)
    assert (np.abs(TYPICAL.gyro_bias) < 3 * spread.gyro_bias).all()
    assert (np.abs(TYPICAL.accelerometer_bias) < 3 * spread.accelerometer_bias).all()
    for matrix in (TYPICAL.gyro_error, TYPICAL.accelerometer_error):
        assert (np.abs(matrix) < 3 * installation).all()


# Refusals


@pytest.mark.parametrize(
    ("kind", "name"),
    [(kind, field.name) for kind in (Noise, Spread) for field in fields(kind)],
)
def test_sizes_that_are_no_deviations_are_refused_by_name(kind, name):
    with pytest.raises(
        ValueError, match=rf"^{name}: expected a number of at least 0, got -1e-09\.$"
    ):
        kind(**{name: -1e-9})
    with pytest.raises(ValueError, match=rf"^{name}: expected finite numbers, got 1 NaN"):
        kind(**{name: np.nan})
    with pytest.raises(ValueError, match=rf"^{name}: expected one number, got shape \(3,\)"):
        kind(**{name: [1.0, 2.0, 3.0]})
    good = kind(**{name: 0})
    with pytest.raises(FrozenInstanceError):
        setattr(good, name, 1.0)


@every_field
def test_units_with_nan_are_refused_by_name(name):
    bad = UNIT._replace(**{name: np.full_like(getattr(UNIT, name), np.nan)})
    for refusing in (checked_unit, lambda unit: measure(STANDING, unit)):
        with pytest.raises(ValueError, match=rf"^{name}: expected finite numbers"):
            refusing(bad)


@every_field
def test_units_of_the_wrong_shape_are_refused_by_name(name):
    bad = UNIT._replace(**{name: np.zeros(4)})
    with pytest.raises(ValueError, match=rf"^{name}: expected shape \(\.\.\., 3"):
        checked_unit(bad)


def test_units_whose_leading_axes_do_not_fit_are_refused():
    bad = UNIT._replace(gyro_bias=np.zeros((2, 3)), accelerometer_error=np.zeros((4, 3, 3)))
    with pytest.raises(ValueError, match=r"^gyro_bias, .*: expected leading axes that broadcast"):
        checked_unit(bad)


def test_checked_unit_is_the_unit_in_arrays():
    given_unit = Unit(*(field.tolist() for field in UNIT))
    for found, expected in zip(checked_unit(given_unit), UNIT, strict=True):
        assert isinstance(found, np.ndarray)
        np.testing.assert_array_equal(found, expected)
