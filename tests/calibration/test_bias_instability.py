"""Biases that vary as Gauss-Markov processes: simulated, filtered, and what it costs."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import degree, g, hour, micro
from scipy.stats import chi2, norm

from driftlab.book.ch11_kalman_calibration.experiments import QUICK_TRIAL as TRIAL
from driftlab.calibration import (
    ERROR_MODELS,
    covariance_analysis,
    innovation_test,
    linearize_along,
)
from driftlab.calibration.error_dynamics import _moving_states, process_noise
from driftlab.calibration.scheme_design import DesignTask
from driftlab.checks import UnusualWarning
from driftlab.gyrocompass import GyroNoise
from driftlab.imu import NO_ERRORS, ImuErrors, ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments, measure
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES

HOURLY, MICRO_G = float(degree / hour), micro * g
GYRO, ACCELEROMETER = 0.01 * HOURLY, 10 * MICRO_G
VARYING = ImuNoise(
    gyro_bias_instability=GYRO,
    gyro_correlation_time=300.0,
    accelerometer_bias_instability=ACCELEROMETER,
    accelerometer_correlation_time=1000.0,
)
# Of a good laser gyro: the instability stands well above the rest.
QUIET = replace(
    VARYING,
    angle_random_walk=0.0005 * degree / np.sqrt(hour),
    velocity_random_walk=1 * MICRO_G,
    reference_velocity=1e-3,
)
IN_CHAPTER = ImuNoise(
    gyro_bias_instability=0.003 * HOURLY,
    gyro_correlation_time=600.0,
    accelerometer_bias_instability=5 * MICRO_G,
    accelerometer_correlation_time=600.0,
)
MODEL = ERROR_MODELS["averaged"]
BIASES = [
    MODEL.names.index(f"{kind} bias {x}") for kind in ("gyro", "accelerometer") for x in "xyz"
]
RUNS = 100


def bounds(freedom, count):
    """Of the mean of `count` chi-square numbers, over their freedom, one in 10 000 outside."""
    return chi2.ppf([0.5e-4, 1 - 0.5e-4], freedom * count) / (freedom * count)


# The process


@pytest.mark.parametrize("seconds", [0.5, 20.0, 2000.0])
def test_a_process_is_discretised_exactly(seconds):
    way = linearize_along(NINETEEN_POSITIONS, 0.7, MODEL).transitions[15]
    rows, added = _moving_states(MODEL, VARYING, way, seconds)
    times, variances = np.repeat([300.0, 1000.0], 3), np.repeat([GYRO, ACCELEROMETER], 3) ** 2
    kept, gained = np.exp(-seconds / times), variances * (1 - np.exp(-2 * seconds / times))
    np.testing.assert_allclose(rows[6:, 6:12], np.diag(kept))
    np.testing.assert_allclose(added[6:, 6:], np.diag(gained))
    # In an interval it acts as a bias does, and what it gains acts in the same interval.
    acting = way[:6, BIASES]
    np.testing.assert_allclose(rows[:6, 6:12], acting * kept, atol=1e-40)
    np.testing.assert_allclose(added[:6, 6:], acting * gained, atol=1e-40)
    white = process_noise(VARYING, way[3:6, :3], np.asarray(seconds))
    np.testing.assert_allclose(added[:6, :6] - white, acting * gained @ acting.T, rtol=1e-6)
    np.testing.assert_array_equal(np.delete(rows[:6], np.s_[6:12], axis=1), way[:6])


def test_a_simulated_process_has_the_variance_and_the_correlation_told():
    units, interval = 4000, 30.0
    true = Increments(interval, np.zeros((40, 3)), np.zeros((40, 3)))
    silent = replace(VARYING, angle_random_walk=0.0, velocity_random_walk=0.0)
    lead = ImuErrors(*(np.broadcast_to(part, (units, *part.shape)) for part in NO_ERRORS))
    _, *found = measure(true, lead, silent, np.random.default_rng(1))
    for rows, size, time in zip(found, (GYRO, ACCELEROMETER), (300.0, 1000.0), strict=True):
        draws = np.moveaxis(rows, -2, 0).reshape(40, -1) / (interval * size)
        count = draws.shape[1]  # independent ones
        low, high = chi2.ppf([1e-5, 1 - 1e-5], count) / count
        variances = np.mean(draws**2, axis=1)
        assert (low < variances).all()
        assert (variances < high).all()
        for lag in (1, 10, 33):
            expected = np.exp(-lag * interval / time)
            # The mean of products of two such numbers has the variance (1 + r^2)/count.
            spread = np.sqrt((1 + expected**2) / count)
            products = np.mean(draws[lag:] * draws[:-lag], axis=1)
            assert np.abs(products - expected).max() < norm.ppf(1 - 1e-5) * spread
    # The axes vary by themselves.
    assert np.abs(np.corrcoef(found[0][:, 7].T) - np.eye(3)).max() < 4 / np.sqrt(units)


def test_what_a_data_sheet_calls_bias_instability():
    """The numbers of `ImuNoise`: the highest point of the Allan deviation, and B of IEEE 952."""
    times = np.linspace(1.5, 2.3, 8001)
    deviations = GyroNoise(0.0, 1.0, 1.0, 1e-6).allan_deviation(times)
    assert times[deviations.argmax()] == pytest.approx(1.89, abs=0.005)
    assert deviations.max() == pytest.approx(0.617, abs=5e-4)
    assert 1 / deviations.max() == pytest.approx(1.62, abs=0.005)
    assert np.sqrt(2 * np.log(2) / np.pi) / deviations.max() == pytest.approx(1.08, abs=0.005)


def test_numbers_that_do_not_fit_are_refused():
    for sensor in ("gyro", "accelerometer"):
        words = rf"^{sensor}_correlation_time: expected a time above 0 s for a bias instability of"
        with pytest.raises(ValueError, match=words):
            ImuNoise(**{f"{sensor}_bias_instability": 1e-9})
        ImuNoise(**{f"{sensor}_correlation_time": 300.0})
    with pytest.warns(UnusualWarning, match=r"^gyro_bias_instability: .*np\.radians\(0\.003\)"):
        ImuNoise(gyro_bias_instability=0.003, gyro_correlation_time=300.0)


# The filter


def test_what_varies_too_slowly_to_see_is_a_constant_of_unknown_share():
    """Of b + m, both constant, the record shows the sum; the prior divides it, in closed form."""
    endless = replace(VARYING, gyro_correlation_time=1e15, accelerometer_correlation_time=1e15)
    prior = PriorStandardDeviations(gyro_bias=3 * GYRO, accelerometer_bias=2 * ACCELEROMETER)
    way = linearize_along(NINETEEN_POSITIONS, 0.7, MODEL)
    found = covariance_analysis(way, endless, prior)
    together = replace(
        prior,
        gyro_bias=np.hypot(prior.gyro_bias, GYRO),
        accelerometer_bias=np.hypot(prior.accelerometer_bias, ACCELEROMETER),
    )
    of_sum = covariance_analysis(way, ImuNoise(), together)
    share = np.ones(MODEL.size)
    share[BIASES] = np.repeat([9 / 10, 4 / 5], 3)
    unknown = np.zeros(MODEL.size)
    unknown[BIASES] = np.repeat([9 / 10 * GYRO**2, 4 / 5 * ACCELEROMETER**2], 3)
    expected = of_sum * np.outer(share, share) + np.diag(unknown)
    scale = np.sqrt(np.outer(expected.diagonal(), expected.diagonal()))
    np.testing.assert_allclose(found / scale, expected / scale, atol=1e-6)


def test_a_design_counts_on_the_same_covariance():
    task = DesignTask("mean", noise=VARYING)
    way = linearize_along(NINETEEN_POSITIONS.with_duration(task.duration), task.latitude, MODEL)
    expected = task.values(covariance_analysis(way, VARYING, task.prior))
    assert task.value(NINETEEN_POSITIONS) == pytest.approx(float(expected), rel=1e-6)


@pytest.mark.parametrize(
    ("noise", "passes"),
    [
        (VARYING, 1),
        *(pytest.param(*case, marks=pytest.mark.slow) for case in ((QUIET, 1), (IN_CHAPTER, 2))),
    ],
)
def test_a_filter_that_is_told_is_as_good_as_it_says(noise, passes):
    found = replace(TRIAL, noise=noise, passes=passes).run(np.random.default_rng(1), RUNS)
    low, high = bounds(27, RUNS)
    assert low < found.nees[:, -1].mean() / 27 < high
    nis = found.calibration.nis
    low, high = bounds(3, nis.size)
    assert low < nis.mean() / 3 < high
    # The states are the model's: nothing but the constants is reported.
    assert found.calibration.covariance.shape == (RUNS, 1, 27, 27)
    way = linearize_along(TRIAL.scheme, TRIAL.latitude, MODEL)
    expected = covariance_analysis(way, noise, TRIAL.prior, update=9.0)
    stated = found.calibration.standard_deviations[0, -1, BIASES]
    np.testing.assert_allclose(stated, np.sqrt(expected.diagonal())[BIASES], rtol=0.05)


@pytest.mark.slow
def test_a_filter_of_constants_is_too_sure_and_its_innovations_hide_it():
    """What chapter 11 says of the trial, the noise and the filter of its own."""
    constants = replace(TRIAL, noise=IN_CHAPTER, assumed_noise=ImuNoise())
    found, told = (
        trial.run(np.random.default_rng(1), RUNS)
        for trial in (constants, replace(constants, assumed_noise=None))
    )
    assert 2.5 < found.nees[:, -1].mean() / 27 < 3
    assert (innovation_test(found.calibration).verdict == "consistent").all()
    worse = np.std(found.errors[:, -1, BIASES], axis=0) / np.std(told.errors[:, -1, BIASES], axis=0)
    assert worse.max() < 1.1
    stated, honest = (each.calibration.standard_deviations[0, -1, BIASES] for each in (found, told))
    assert ((honest / stated)[3:] > 1.55).all()
    assert ((honest / stated)[3:] < 1.95).all()
    # Four times the instability of the gyros.
    np.testing.assert_allclose(stated[:3] / HOURLY, 0.012, atol=5e-4)
    assert (honest / stated)[:3].max() < 1.1


@pytest.mark.slow
def test_on_a_table_that_stands_the_innovations_tell():
    still = replace(IN_CHAPTER, reference_velocity=1e-4)
    constants = replace(TRIAL, noise=still, assumed_noise=ImuNoise(reference_velocity=1e-4))
    found, told = (
        trial.run(np.random.default_rng(1), RUNS)
        for trial in (constants, replace(constants, assumed_noise=None))
    )
    assert found.nees[:, -1].mean() / 27 > 20
    assert np.mean(innovation_test(found.calibration).verdict == "consistent") < 0.1
    low, high = bounds(27, RUNS)
    assert low < told.nees[:, -1].mean() / 27 < high
    stated, honest = (each.calibration.standard_deviations[0, -1, BIASES] for each in (found, told))
    assert (stated[3:] < 0.3 * MICRO_G).all()
    assert (honest[3:] > 3.3 * MICRO_G).all()
    assert (honest[3:] < 4.1 * MICRO_G).all()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "time", "velocity"),
    [
        ("18 rotations", 300.0, 1e-2),
        ("19 positions", 1000.0, 1e-4),
        pytest.param("19 positions", 300.0, 1e-2, marks=pytest.mark.long),
        pytest.param("18 rotations", 1000.0, 1e-4, marks=pytest.mark.long),
    ],
)
def test_a_quarter_of_the_stated_deviation_does_little_harm(name, time, velocity):
    white = ImuNoise(reference_velocity=velocity)
    trial = replace(TRIAL, scheme=replace(SCHEMES[name], dwell=TRIAL.scheme.dwell), noise=white)
    plain = trial.run(np.random.default_rng(1), 1)
    gyro, accelerometer = plain.calibration.standard_deviations[0, -1, BIASES].reshape(2, 3)
    quarter = replace(
        white,
        gyro_bias_instability=gyro.min() / 4,
        gyro_correlation_time=time,
        accelerometer_bias_instability=accelerometer.min() / 4,
        accelerometer_correlation_time=time,
    )
    constants = replace(trial, noise=quarter, assumed_noise=white)
    found = constants.run(np.random.default_rng(1), 2 * RUNS)
    # Chi-square of 27 degrees each: the mean is known within this, one standard deviation.
    within = np.sqrt(2 / (27 * 2 * RUNS))
    assert found.nees[:, -1].mean() / 27 < 1.1 + 2 * within
