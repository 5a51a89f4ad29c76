"""Gyro noise against its covariance matrix, and means of it against direct sums over all pairs."""

from dataclasses import FrozenInstanceError, fields, replace

import numpy as np
import pytest
from scipy.linalg import cholesky, solve_triangular, toeplitz
from scipy.stats import chi2

from driftlab.allan import allan_deviation
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.gyrocompass.noise_fit import fit_gyro_noise
from support import EPS

MIXED = GyroNoise(white=0.7, gauss_markov=1.3, correlation_time=4.0, interval=0.5)
WHITE = GyroNoise(white=0.7, gauss_markov=0.0)
SLOW = GyroNoise(white=0.0, gauss_markov=1.3, correlation_time=4.0, interval=0.5)
ROUNDED = GyroNoise(
    white=0.7, gauss_markov=1.3, correlation_time=4.0, interval=0.5, quantisation=0.4
)
kinds = pytest.mark.parametrize(
    "noise", [MIXED, WHITE, SLOW, ROUNDED], ids=["mixed", "white", "gauss_markov", "rounded"]
)


def covariance(noise, count):
    """Covariance matrix of `count` samples: exp(-|i - j| h/T) of the slow part, white, rounding.

    Neighbours share one rounding of the angle, with opposite signs.
    """
    delays = noise.interval * np.arange(count)
    rounding = (noise.quantisation / noise.interval) ** 2
    neighbours = np.zeros(count)
    neighbours[:2] = (2 * rounding, -rounding)[:count]
    return (
        noise.gauss_markov**2 * toeplitz(np.exp(-delays / noise.correlation_time))
        + noise.white**2 * np.eye(count)
        + toeplitz(neighbours)
    )


def assert_standard_normal(values):
    """Rows (n, m) of independent numbers with mean zero and deviation one.

    Each bound is passed by chance once in a million draws; the seeds are fixed.
    """
    low, high = chi2.ppf([0.5e-6, 1 - 0.5e-6], len(values)) / len(values)
    squares = (values**2).mean(axis=0)
    assert (low < squares).all()
    assert (squares < high).all()
    # Means and correlations of n normal numbers have deviations of 1/sqrt(n); 4.9 of them.
    bound = 4.9 / np.sqrt(len(values))
    assert (np.abs(values.mean(axis=0)) < bound).all()
    products = values.T @ values / len(values)
    assert (np.abs(products[np.triu_indices(values.shape[1], 1)]) < bound).all()


# Samples


@kinds
def test_samples_have_the_covariance_of_a_gauss_markov_process_and_white_noise(noise):
    """With the root of that matrix taken out, nothing but independent unit numbers is left."""
    rows = noise.samples(30, np.random.default_rng(1), 20000)
    root = cholesky(covariance(noise, 30), lower=True)
    assert_standard_normal(solve_triangular(root, rows.T, lower=True).T)


# Deviation of the mean


@kinds
@pytest.mark.parametrize("count", [1, 2, 3, 17, 400])
def test_deviation_of_mean_is_the_sum_over_all_pairs(noise, count):
    expected = np.sqrt(covariance(noise, count).sum()) / count
    assert noise.standard_deviation_of_mean(count) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("window", [0.01, 0.3, 1.0, 10.0, 1000.0])
def test_slow_noise_in_short_steps_is_averaged_as_in_continuous_time(window):
    """2 sigma^2 (x - 1 + exp(-x))/x^2, with x the window in correlation times."""
    steps = 2000
    noise = GyroNoise(0.0, 1.3, 1.0, window / steps)
    expected = 1.3 * np.sqrt(2 * (window + np.expm1(-window))) / window
    # A sum for an integral: second order in the step, down to the digits that short steps cost.
    allowed = max((window / steps) ** 2, 1e-8)
    assert noise.standard_deviation_of_mean(steps) == pytest.approx(expected, rel=allowed)


@kinds
def test_means_of_samples_are_as_large_as_stated(noise):
    rows = noise.samples(40, np.random.default_rng(4), 20000)
    # Of the means of 12 here, at the beginning and at the end of the rows, two far apart.
    means = np.stack([rows[:, :12].mean(axis=1), rows[:, -12:].mean(axis=1)], axis=1)
    ends = means / noise.standard_deviation_of_mean(12)
    low, high = chi2.ppf([0.5e-6, 1 - 0.5e-6], 20000) / 20000
    squares = (ends**2).mean(axis=0)
    assert (low < squares).all()
    assert (squares < high).all()


def test_rounding_falls_with_the_window_itself():
    noise = GyroNoise(0.0, 0.0, interval=0.5, quantisation=0.4)
    for count in (1, 10, 1000):
        assert noise.standard_deviation_of_mean(count) == pytest.approx(0.8 * np.sqrt(2) / count)
        # The same standard deviation as of an angle that is rounded to steps.
    step, rng = 0.3, np.random.default_rng(7)
    angle = np.cumsum(rng.normal(size=(4000, 11)), axis=-1)
    error = np.diff(step * np.round(angle / step) - angle)
    stated = GyroNoise(0.0, 0.0, interval=1.0, quantisation=step / np.sqrt(12))
    low, high = chi2.ppf([0.5e-6, 1 - 0.5e-6], 4000) / 4000
    squares = np.mean((error.mean(axis=-1) / stated.standard_deviation_of_mean(10)) ** 2)
    assert low < squares < high


# Allan deviation


@kinds
@pytest.mark.parametrize("count", [1, 4, 50, 1000])
def test_allan_deviation_is_half_the_square_of_neighbouring_means_differing(noise, count):
    fine = GyroNoise(
        noise.white * 20, noise.gauss_markov, 4.0, noise.interval / 400, noise.quantisation
    )
    number = 400 * count
    # Var(a - b)/2 of neighbouring means a, b, by the means of one and of both stretches.
    expected = 2 * (
        fine.standard_deviation_of_mean(number) ** 2
        - fine.standard_deviation_of_mean(2 * number) ** 2
    )
    found = noise.allan_deviation(count * noise.interval)
    # Sums for integrals: second order in the step.
    assert found**2 == pytest.approx(expected, rel=1e-5)


def test_allan_deviation_does_not_jump_where_the_series_begins():
    noise = GyroNoise(0.0, 1.0, 1000.0)
    places = np.array([0.999999, 1.000001])
    low, high = noise.allan_deviation(places)
    # Exponentials near 4 cancel to 2/3 of the third power of the thousandth of a time.
    assert high / low == pytest.approx(1.000001, abs=3 * EPS / 1e-3**3)
    # Far below, a random walk: s sqrt(2 tau/(3 T)).
    assert noise.allan_deviation(1e-6) == pytest.approx(np.sqrt(2e-9 / 3))


def test_allan_deviation_is_that_of_the_samples():
    rates = ROUNDED.samples(4000, np.random.default_rng(8), 30)
    found = allan_deviation(rates, 0.5, [20.0, 50.0])
    ratios = np.mean(found.deviation**2, axis=0) / ROUNDED.allan_deviation([20.0, 50.0]) ** 2
    # Not more degrees of freedom in a run than independent stretches.
    assert (np.abs(ratios - 1) < 4.9 * np.sqrt(2 / (30 * np.array([100, 40])))).all()


# Fit


@pytest.mark.parametrize(
    "noise", [MIXED, WHITE, SLOW, ROUNDED, replace(SLOW, quantisation=40.0)], ids=repr
)
def test_a_fit_finds_the_noise_again(noise):
    """From its own curve, to the digits of the search, and from a record to its scatter."""
    rates = noise.samples(100, np.random.default_rng(9))
    record = allan_deviation(rates, noise.interval, noise.interval * np.array([1, 2, 3, 5, 9, 20]))
    times = np.geomspace(0.5, 200.0, 20)
    exact = noise.allan_deviation(times)
    record = replace(
        record, averaging_times=times, deviation=exact, degrees_of_freedom=np.full(20, 100.0)
    )
    found = fit_gyro_noise(record)
    np.testing.assert_allclose(found.allan_deviation(times), exact, rtol=1e-3)
    assert found.interval == noise.interval
    for name in ("white", "gauss_markov", "quantisation"):
        if getattr(noise, name):
            assert getattr(found, name) == pytest.approx(getattr(noise, name), rel=0.02), name


@pytest.mark.parametrize("size", [1e-20, 1e-6, 1.0, 1e6, 1e20])
def test_a_fit_finds_three_parts_in_any_unit_of_the_rates(size):
    noise = GyroNoise(size, 30 * size, correlation_time=20.0, interval=0.05, quantisation=size / 50)
    times = np.geomspace(0.05, 50.0, 25)
    record = replace(
        allan_deviation(np.zeros(100), noise.interval),
        averaging_times=times,
        deviation=noise.allan_deviation(times),
        degrees_of_freedom=np.full(25, 100.0),
    )
    found = fit_gyro_noise(record)
    for field in fields(GyroNoise):
        expected = getattr(noise, field.name)
        assert getattr(found, field.name) == pytest.approx(expected, rel=1e-4, abs=0), field.name


def test_rounding_is_missed_by_a_fit_without_it():
    noise = GyroNoise(0.01, 0.0, interval=0.1, quantisation=1.0)
    record = allan_deviation(noise.samples(20_000, np.random.default_rng(10)), 0.1)
    worst = [
        np.exp(np.abs(np.log(fit.allan_deviation(record.averaging_times) / record.deviation)).max())
        for fit in (fit_gyro_noise(record, quantised=q) for q in (False, True))
    ]
    assert worst[0] > 3
    assert worst[1] < 1.5


def test_fits_refuse_what_they_cannot_do():
    rates = np.random.default_rng(0).normal(size=(2, 100))
    with pytest.raises(ValueError, match=r"^allan: expected that of one gyro.*\(2, \d+\); take"):
        fit_gyro_noise(allan_deviation(rates, 1.0))
    with pytest.raises(ValueError, match=r"^allan: expected four averaging times.*got 1\.$"):
        fit_gyro_noise(allan_deviation(rates[0], 1.0, [1.0]))
    with pytest.raises(ValueError, match=r"^averaging_times: expected numbers above 0, got 0\.$"):
        MIXED.allan_deviation([0.0, 1.0])


# Sizes in the units of the field, and refusals


def test_default_noise_in_the_units_of_the_paper():
    hourly = np.pi / 180 / 3600
    noise = GyroNoise()
    assert noise.white / hourly == pytest.approx(0.5)
    assert noise.gauss_markov / hourly == pytest.approx(0.01)
    assert (noise.correlation_time, noise.interval) == (3600, 0.1)


@pytest.mark.parametrize("name", [field.name for field in fields(GyroNoise)])
def test_impossible_noise_is_refused_by_name(name):
    kind = (
        "number of at least 0"
        if name in ("white", "gauss_markov", "quantisation")
        else "positive time"
    )
    with pytest.raises(ValueError, match=rf"^{name}: expected a {kind}, got -1e-09\.$"):
        GyroNoise(**{name: -1e-9})
    with pytest.raises(FrozenInstanceError):
        setattr(GyroNoise(), name, 1.0)


def test_slow_noise_averages_away_only_in_windows_longer_than_its_correlation_time():
    hour = 3600.0
    noise = GyroNoise(0.0, 1.0, hour, 1.0)
    assert noise.standard_deviation_of_mean(60) == pytest.approx(1, abs=0.004)
    # sqrt(2 T/t) of it, less the two ends.
    assert noise.standard_deviation_of_mean(100 * 3600) == pytest.approx(
        np.sqrt(2 / 100 * (1 - 1 / 100)), 1e-6
    )


def test_white_noise_falls_with_the_square_root():
    for count in (1, 4, 625, 10**6):
        assert WHITE.standard_deviation_of_mean(count) == pytest.approx(
            0.7 / np.sqrt(count), rel=1e-14
        )
