"""Trials of the filter: whether its errors are as large as it says, and how they are counted."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.constants import arcsecond
from scipy.linalg import expm
from scipy.spatial.transform import Rotation
from scipy.stats import binom, chi2, norm

from driftlab.calibration.body_axes import attitude_error, attitude_of_axes, imu_errors_in_frame
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.filter import Calibration
from driftlab.calibration.observability import UnobservableWarning
from driftlab.calibration.simulation import Trial, TurntableTrial, _estimation_errors
from driftlab.higher_order_errors import NO_HIGHER_ORDER_ERRORS
from driftlab.imu import (
    TYPICAL_ERRORS,
    ImuErrors,
    ImuNoise,
    PriorStandardDeviations,
    random_imu_errors,
)
from driftlab.motion.scheme import EIGHTEEN_ROTATIONS, NINETEEN_POSITIONS, Scheme
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotate
from driftlab.vectors import cross_matrix
from support import EPS, matrices, quaternions, vectors

FRAMES = tuple(ERROR_MODELS)
every_frame = pytest.mark.parametrize("frame", FRAMES)
SLOW = Scheme(
    NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=45.0, rate=np.radians(4)
)
"""Slower, so that samples of a quarter of a second are not wider than a degree."""
TRIAL = TurntableTrial(SLOW, sample_interval=0.25, update_interval=3.0)
BRIEF = replace(
    TRIAL, scheme=Scheme(SLOW.rotations, SLOW.start, dwell=6.0), sample_interval=0.5, keep=20
)
"""Five minutes and quick; not to be trusted with digits."""


def between(tails, freedom):
    """Bounds of a chi-square number that keep out `tails` on both sides together."""
    return chi2.ppf([tails / 2, 1 - tails / 2], freedom)


# Consistency: many runs


@pytest.fixture(scope="module")
def many():
    """A hundred units of the kind that the filter is told."""
    return TRIAL.run(np.random.default_rng(0), 100)


def test_errors_at_the_end_are_as_large_as_the_filter_says(many):
    squares = many.nees[:, -1]
    low, high = between(0.05, 27 * 100)
    assert low < squares.sum() < high


def test_errors_are_as_large_as_the_filter_says_all_the_time(many):
    # At each of 22 times, hardly independent: one in ten thousand of the tails for each.
    assert many.errors.shape == (100, 22, 27)
    low, high = between(1e-4, 27 * 100)
    sums = many.nees.sum(axis=0)
    assert (low < sums).all()
    assert (sums < high).all()


def test_single_runs_scatter_like_chi_square(many):
    """The sum of all could be right with some runs far too good and others far too bad."""
    squares = np.sort(many.nees[:, -1])
    expected = chi2.cdf(squares, 27)
    # Kolmogorov and Smirnov: 1.63/sqrt(n) keeps out one in a hundred.
    steps = np.arange(101) / 100
    furthest = max((expected - steps[:-1]).max(), (steps[1:] - expected).max())
    assert furthest < 1.63 / np.sqrt(100)


def test_each_error_scatters_as_its_deviation_says(many):
    scaled = many.errors[:, -1] / many.calibration.standard_deviations[:, -1]
    # Bonferroni: one in a hundred for all 27 states together.
    low, high = between(0.01 / 27, 100)
    squares = (scaled**2).sum(axis=0)
    names = np.array(many.calibration.model.names)
    assert not names[(squares < low) | (squares > high)].size
    # And about zero: the mean has a deviation of a tenth.
    most = norm.isf(0.005 / 27) / np.sqrt(100)
    assert not names[np.abs(scaled.mean(axis=0)) > most].size


def test_innovations_are_as_large_as_the_filter_says(many):
    nis = many.calibration.nis
    updates = nis.shape[-1]
    assert updates == (19 * 45 + 18 * 24) // 3
    low, high = between(0.05, 3 * 100 * updates)
    assert low < nis.sum() < high


def test_innovations_leave_their_bounds_as_often_as_they_should(many):
    """Innovations of different updates are independent, so the number outside is binomial."""
    nis = many.calibration.nis
    sums, updates = nis.sum(axis=0), nis.shape[-1]
    low, high = between(0.05, 3 * 100)
    outside = np.count_nonzero((sums < low) | (sums > high))
    assert binom.ppf(0.005, updates, 0.05) <= outside <= binom.ppf(0.995, updates, 0.05)


def test_innovations_do_not_remember(many):
    """Of n products of independent (s - 3)/sqrt(6), the sum has the deviation sqrt(n)."""
    nis = (many.calibration.nis - 3) / np.sqrt(6)
    lags = range(1, 21)
    products = [nis[:, lag:] * nis[:, :-lag] for lag in lags]
    scaled = np.array([product.sum() / np.sqrt(product.size) for product in products])
    low, high = between(0.01, len(lags))
    assert low < (scaled**2).sum() < high


def test_noise_of_the_sensors_is_as_large_as_the_filter_says():
    """Where it is most of an innovation: gyros of 0.1 deg/sqrt(h), tilting while forces act."""
    noise = ImuNoise(angle_random_walk=3e-5, velocity_random_walk=3e-4, reference_velocity=1e-4)
    trial = replace(BRIEF, noise=noise, sample_interval=0.25).run(np.random.default_rng(0), 20)
    shown = trial.calibration.nis
    low, high = between(0.05, 3 * shown.size)
    assert low < shown.sum() < high
    # In 3 s, m/s: from tilting on the way, from the accelerometers, from the table.
    own = np.array([9.8 * 3e-5 * 3**1.5 / np.sqrt(3), 3e-4 * np.sqrt(3), 1e-4])
    assert own[0] > own[1] > own[2]


def test_units_are_of_the_kind_that_the_filter_is_told(many):
    prior = TRIAL.prior
    sizes = np.where(np.eye(3), prior.scale_factor, prior.installation)
    squares = [
        ((part / size) ** 2).sum()
        for part, size in zip(
            many.imu_errors, (prior.gyro_bias, sizes, prior.accelerometer_bias, sizes), strict=True
        )
    ]
    for square, freedom in zip(squares, (300, 900, 300, 900), strict=True):
        low, high = between(0.01, freedom)
        assert low < square < high


def test_trial_is_consistent_for_one_unit_again_and_again():
    """The filter ends with so much less doubt than it began with that all of it is noise.

    So the errors of fifty runs are as independent as those of fifty units.
    """
    trial = replace(TRIAL, update_interval=6.0).run(np.random.default_rng(0), 50, TYPICAL_ERRORS)
    for part, true in zip(trial.imu_errors, TYPICAL_ERRORS, strict=True):
        np.testing.assert_array_equal(part, np.broadcast_to(true, (50, *true.shape)))
    low, high = between(0.05, 27 * 50)
    assert low < trial.nees[:, -1].sum() < high
    errors = trial.errors[:, -1] / trial.calibration.standard_deviations[:, -1]
    scatter = ((errors - errors.mean(axis=0)) ** 2).sum(axis=0)
    low, high = between(0.01 / 27, 49)
    assert ((low < scatter) & (scatter < high)).all()


@pytest.mark.parametrize(
    ("frame", "latitude", "seed"), [("accelerometers", -1.0, 1), ("upper triangle", 0.2, 2)]
)
def test_trial_is_consistent_elsewhere_with_other_axes_and_rotations(frame, latitude, seed):
    scheme = Scheme(EIGHTEEN_ROTATIONS.rotations, dwell=30.0, rate=np.radians(5))
    prior = PriorStandardDeviations(
        installation=10 * arcsecond
    )  # triangles are soon of second order
    trial = replace(
        TRIAL, scheme=scheme, latitude=latitude, frame=frame, prior=prior, update_interval=6.0
    ).run(np.random.default_rng(seed), 50)
    low, high = between(0.05, 27 * 50)
    assert low < trial.nees[:, -1].sum() < high
    low, high = between(0.05, 3 * trial.calibration.nis.size)
    assert low < trial.calibration.nis.sum() < high


@pytest.mark.parametrize(
    ("frame", "runs"),
    [
        ("averaged", 8),
        *(pytest.param(f, 40, marks=pytest.mark.long) for f in ("averaged", "lower triangle")),
    ],
)
def test_second_pass_is_consistent_however_bent_the_units_are(frame, runs):
    """Units bent by 400 arc seconds: one pass is far too sure of itself, two are not."""
    prior = PriorStandardDeviations(installation=400 * arcsecond)
    trial = replace(TRIAL, frame=frame, prior=prior, update_interval=6.0)
    once, twice = (
        replace(trial, passes=passes).run(np.random.default_rng(3), runs) for passes in (1, 2)
    )
    low, high = between(0.05, 27 * runs)
    assert once.nees[:, -1].sum() > 1.5 * high
    assert low < twice.nees[:, -1].sum() < high
    low, high = between(0.01, 3 * twice.calibration.nis.size)
    assert low < twice.calibration.nis.sum() < high
    # Both passes are of one record.
    for part, other in zip(once.imu_errors, twice.imu_errors, strict=True):
        np.testing.assert_array_equal(part, other)


# Units, attitudes and axes


@given(
    gyro=matrices(0.05),
    accelerometer=matrices(0.05),
    frame=st.sampled_from(FRAMES),
    rate=vectors(1.0),
)
def test_unit_in_other_axes_says_the_same(gyro, accelerometer, frame, rate):
    imu_errors = ImuErrors(
        np.array([1.0, 2.0, 3.0]), gyro, np.array([4.0, 5.0, 6.0]), accelerometer
    )
    turned, turn = imu_errors_in_frame(imu_errors, frame)
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), rtol=0, atol=16 * EPS)
    assert np.linalg.det(turn) > 0
    for before, after in (
        (gyro, turned.gyro_error_matrix),
        (accelerometer, turned.accelerometer_error_matrix),
    ):
        # (I + K) w, with w in either axes.
        np.testing.assert_allclose(
            rate + before @ rate, (np.eye(3) + after) @ (turn @ rate), rtol=0, atol=64 * EPS
        )
    # A bias is the sensor's own.
    for name in ("gyro_bias", "accelerometer_bias"):
        np.testing.assert_array_equal(getattr(turned, name), getattr(imu_errors, name))
    chosen = (
        turned.accelerometer_error_matrix if "accelerometers" in frame else turned.gyro_error_matrix
    )
    left_out = {
        "averaged": chosen - chosen.T,
        "averaged accelerometers": chosen - chosen.T,
        "lower triangle": np.tril(chosen, -1),
    }.get(frame, np.triu(chosen, 1))
    # Rounding of a decomposition of order three, and of two products.
    np.testing.assert_allclose(left_out, 0, atol=128 * EPS)
    # So the 21 numbers of the model are all of it.
    model = ERROR_MODELS[frame]
    whole = model.imu_errors(model.state(turned))
    for one, other in zip(whole, turned, strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=128 * EPS)


def test_axes_of_a_triad_that_is_flat_are_refused():
    flat = TYPICAL_ERRORS._replace(gyro_error_matrix=np.diag([0.0, 0.0, -1.0]))
    with pytest.raises(
        ValueError, match=r"^gyro_error_matrix: expected a right-handed triad I \+ K"
    ):
        imu_errors_in_frame(flat, "averaged")
    with pytest.raises(ValueError, match=r"^frame: expected one of averaged, .*, got 'mine'\.$"):
        imu_errors_in_frame(TYPICAL_ERRORS, "mine")


@given(attitude=quaternions(), turn=quaternions(), vector=vectors())
def test_attitude_of_turned_axes_maps_turned_components(attitude, turn, vector):
    matrix = Rotation.from_quat(turn).as_matrix()
    turned = attitude_of_axes(attitude, matrix)
    np.testing.assert_allclose(
        rotate(turned, matrix @ vector), rotate(attitude, vector), rtol=0, atol=1e-13
    )


@given(true=quaternions(), phi=vectors(1.5))
def test_attitude_error_is_the_rotation_that_was_made(true, phi):
    """exp(-[phi×]) C is computed, with a phi of up to 2.6 rad: exactly, not only when small."""
    computed = multiply(from_rotation_vector(-phi), true)
    np.testing.assert_allclose(attitude_error(computed, true), phi, rtol=0, atol=1e-12)
    np.testing.assert_allclose(attitude_error(-3 * computed, true), phi, rtol=0, atol=1e-12)
    before, after = (Rotation.from_quat(q).as_matrix() for q in (true, computed))
    np.testing.assert_allclose(after, expm(-cross_matrix(phi)) @ before, rtol=0, atol=1e-12)


@every_frame
def test_errors_of_a_perfect_calibration_are_zero(frame):
    """And each error that is put in comes out with its sign: true minus found for sensors."""
    model, rng = ERROR_MODELS[frame], np.random.default_rng(4)
    units = random_imu_errors(PriorStandardDeviations(), rng, 2)
    true, turn = imu_errors_in_frame(units, frame)
    attitude = Rotation.from_quat(rng.normal(size=(5, 4))).as_quat()
    state = np.repeat(model.state(true)[:, np.newaxis], 5, axis=1)
    found = Calibration(
        model,
        np.arange(5.0),
        state,
        np.broadcast_to(4 * np.eye(model.size), (2, 5, model.size, model.size)),
        multiply(attitude, conjugate(Rotation.from_matrix(turn).as_quat())[:, np.newaxis]),
        np.zeros((2, 5, 3)),
        np.zeros((2, 5)),
    )
    np.testing.assert_allclose(
        _estimation_errors(found, units, attitude, NO_HIGHER_ORDER_ERRORS), 0, atol=16 * EPS
    )
    put_in = 1e-5 * rng.standard_normal((2, 5, model.size))
    wrong = found._replace(
        state=state - np.concatenate([np.zeros((2, 5, 6)), put_in[..., 6:]], axis=-1),
        attitude=multiply(from_rotation_vector(-put_in[..., :3]), found.attitude),
        velocity=put_in[..., 3:6],
    )
    errors = _estimation_errors(wrong, units, attitude, NO_HIGHER_ORDER_ERRORS)
    np.testing.assert_allclose(errors, put_in, rtol=0, atol=16 * EPS)
    # Squared, in units of a deviation of two.
    trial = Trial(wrong, units, errors)
    np.testing.assert_allclose(trial.nees, (errors**2).sum(-1) / 4, rtol=1e-12)


# How a trial runs


def test_errors_count_against_the_attitude_at_the_times_of_the_history():
    trial = replace(BRIEF, keep=1).run(np.random.default_rng(5))
    record = turntable_trajectory(BRIEF.scheme, BRIEF.latitude, 0.5, multiple_of=6)
    places = np.round(trial.calibration.times / 0.5).astype(int)
    np.testing.assert_array_equal(places, np.arange(6, len(record.attitude), 6))
    np.testing.assert_array_equal(
        trial.errors,
        _estimation_errors(
            trial.calibration,
            trial.imu_errors,
            record.attitude[places],
            NO_HIGHER_ORDER_ERRORS,
        ),
    )
    # A place too early or too late would be wrong by degrees.
    assert np.abs(trial.errors[:, :3]).max() < 10 * BRIEF.prior.attitude


@pytest.mark.filterwarnings("ignore::driftlab.calibration.observability.UnobservableWarning")
def test_settings_reach_the_filter_and_the_table():
    """Each of them changes what comes out."""
    quick = replace(BRIEF, scheme=Scheme("+90X +90Y", dwell=6.0))
    usual = quick.run(np.random.default_rng(1)).calibration
    for name, value in {
        "scheme": replace(quick.scheme, dwell=9.0),
        "latitude": 0.3,
        "frame": "lower triangle",
        "prior": PriorStandardDeviations(scale_factor=5e-5),
        "noise": ImuNoise(reference_velocity=0.02),
        "sample_interval": 0.25,
        "update_interval": 1.0,
        "keep": 7,
    }.items():
        other = replace(quick, **{name: value}).run(np.random.default_rng(1)).calibration
        assert not np.array_equal(other.standard_deviations, usual.standard_deviations), name


def test_attitude_of_the_table_does_not_tell_that_of_the_axes():
    """Their misalignment is half the difference of two errors of installation."""
    prior = PriorStandardDeviations(attitude=0.0)
    trial = replace(BRIEF, prior=prior, keep=1).run(np.random.default_rng(1))
    expected = prior.installation / np.sqrt(2)
    # 3 s of random walk and of an unknown bias are 0.6 arc seconds beside 28.
    np.testing.assert_allclose(trial.calibration.standard_deviations[0, :3], expected, rtol=2e-3)
    assert (np.abs(trial.errors[0, :3]) < 4 * expected).all()


def test_scheme_that_leaves_errors_unobservable_is_warned_of_by_name():
    trial = replace(BRIEF, scheme=Scheme("+90Z +90Z", dwell=12.0))
    with pytest.warns(UnobservableWarning, match=r"^scheme: leaves \d+ directions of 27") as caught:
        trial.run(np.random.default_rng(0))
    (warning,) = caught
    named = re.split(r", | among ", str(warning.message).rstrip("."))
    # Gravity stays along z, and so do all accelerometers' errors that are not of the third column.
    for error in ("scale x", "scale y", *(f"installation {ij}" for ij in ("xy", "yx", "zx", "zy"))):
        assert f"accelerometer {error}" in named
    # Turned about z is what these were, and seen is the velocity.
    assert "gyro scale z" not in named
    assert not any(name.startswith("velocity") for name in named)


# Refusals


@pytest.mark.parametrize(
    ("name", "bad", "words"),
    [
        ("latitude", np.pi / 2, "at most 89.9 degrees from the equator"),
        ("frame", "mine", r"one of averaged, .*, got 'mine'\.$"),
        ("keep", 0, r"a whole number of at least 1, got 0\.$"),
        ("sample_interval", 0.0, r"a positive number, got 0\.0\.$"),
        ("update_interval", 0.05, r"an even number of samples, got 1 of 0\.05 s\.$"),
        ("scheme", "+90X", r"a Scheme such as .* or the name of one .*, got '\+90X'\.$"),
        ("noise", ImuNoise(reference_velocity=0.0), "a deviation of the reference velocity above"),
        (
            "assumed_noise",
            ImuNoise(reference_velocity=0.0),
            "a deviation of the reference velocity above 0",
        ),
        ("update_interval", 0.11, r"an even number of samples, got 2\.2 of 0\.05 s\.$"),
    ],
)
def test_bad_settings_are_refused_by_name(name, bad, words):
    with pytest.raises(ValueError, match=f"^{name}: expected {words}"):
        TurntableTrial(**{name: bad})


@pytest.mark.parametrize(
    ("sample", "update"), [(0.05, 0.1), (0.1, 0.6), (0.1, 1.0), (1 / 3, 2.0), (0.7, 4.2)]
)
def test_even_numbers_of_samples_may_be_rounded(sample, update):
    trial = TurntableTrial(sample_interval=sample, update_interval=update)
    assert trial == TurntableTrial(sample_interval=sample, update_interval=update)
