"""Biases that vary as Gauss-Markov processes: simulated, filtered, and what it costs."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import degree, g, hour, micro
from scipy.stats import chi2, norm

from driftlab.calibration import (
    ERROR_MODELS,
    TurntableTrial,
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
from driftlab.motion.scheme import NINETEEN_POSITIONS

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
MODEL = ERROR_MODELS["averaged"]
BIASES = [
    MODEL.names.index(f"{kind} bias {x}") for kind in ("gyro", "accelerometer") for x in "xyz"
]
TRIAL = TurntableTrial(
    replace(NINETEEN_POSITIONS, dwell=63.0),
    sample_interval=0.25,
    update_interval=9.0,
    keep=10_000,
)
RUNS = 200


def bounds(freedom, count):
    """Of the mean of `count` chi-square numbers, over their freedom, one in 10 000 outside."""
    return chi2.ppf([0.5e-4, 1 - 0.5e-4], freedom * count) / (freedom * count)


# The process


@pytest.mark.parametrize("seconds", [0.5, 20.0, 2000.0])
def test_a_process_is_discretised_exactly(seconds):
    way = linearize_along(NINETEEN_POSITIONS, 0.7, MODEL).transitions[15]
    rows, added = _moving_states(MODEL, VARYING, way, seconds)
    sizes, times = np.repeat([GYRO, ACCELEROMETER], 3), np.repeat([300.0, 1000.0], 3)
    kept, gained = rows[6:, 6:12], added[6:, 6:]
    np.testing.assert_allclose(kept, np.diag(np.exp(-seconds / times)))
    np.testing.assert_allclose(
        gained, np.diag(sizes**2 * (1 - np.exp(-2 * seconds / times))), atol=0
    )
    # Stationary, and two intervals are one of twice the length.
    np.testing.assert_allclose(kept**2 @ sizes**2 + gained.diagonal(), sizes**2)
    twice, both = _moving_states(MODEL, VARYING, way, 2 * seconds)
    np.testing.assert_allclose(twice[6:, 6:12], kept @ kept)
    np.testing.assert_allclose(both[6:, 6:], kept @ gained @ kept + gained, atol=1e-40)
    # In an interval it acts as a bias does, and what it gains acts in the same interval.
    np.testing.assert_allclose(rows[:6, 6:12], way[:6, BIASES] @ kept, atol=1e-40)
    np.testing.assert_allclose(added[:6, 6:], way[:6, BIASES] @ gained, atol=1e-40)
    white = process_noise(VARYING, way[3:6, :3], np.asarray(seconds))
    of_process = way[:6, BIASES] @ gained @ way[:6, BIASES].T
    np.testing.assert_allclose(added[:6, :6], white + of_process, rtol=1e-9, atol=1e-30)
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


@pytest.mark.parametrize("passes", [1, 2])
@pytest.mark.parametrize("noise", [VARYING, QUIET])
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


def test_a_filter_of_constants_is_too_sure_and_its_innovations_hide_it():
    """With instabilities of the accelerometers at twice what it states for their biases."""
    constants = replace(TRIAL, noise=VARYING, assumed_noise=ImuNoise())
    found = constants.run(np.random.default_rng(1), RUNS)
    squares = found.nees[:, -1] / 27
    assert squares.mean() - 4 * squares.std(ddof=1) / np.sqrt(RUNS) > 6
    assert np.mean(innovation_test(found.calibration).verdict == "consistent") > 0.9
    told = replace(constants, assumed_noise=None).run(np.random.default_rng(1), RUNS)
    # What it finds is hardly worse; what it states of the accelerometers is three times too small.
    worse = np.std(found.errors[:, -1, BIASES], axis=0) / np.std(told.errors[:, -1, BIASES], axis=0)
    assert worse.max() < 1.15
    ratio = (told.calibration.standard_deviations / found.calibration.standard_deviations)[0, -1]
    assert ratio[BIASES[:3]].max() < 1.3
    assert (ratio[BIASES[3:]] > 2.5).all()


def test_in_gyros_a_hundredth_of_a_degree_an_hour_is_little_beside_their_random_walk():
    of_gyros = replace(VARYING, accelerometer_bias_instability=0.0)
    constants = replace(TRIAL, noise=of_gyros, assumed_noise=ImuNoise())
    found = constants.run(np.random.default_rng(1), RUNS)
    assert found.nees[:, -1].mean() / 27 < 1.2
