"""States by choice: lever arms, time skew, g^2 and g-sensitivity in the filter of chapter 11."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from driftlab.calibration import error_dynamics
from driftlab.calibration.error_dynamics import (
    _higher_order_effects,
    free_transition,
    linearize_along,
    transition_of_increments,
)
from driftlab.calibration.error_model import ERROR_MODELS, FULL, _unpacked
from driftlab.calibration.observability import unobservable_subspace
from driftlab.calibration.simulation import TurntableTrial
from driftlab.higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS,
    TERMS,
    _rate_changes,
    higher_order_effects,
)
from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS, ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import EIGHTEEN_ROTATIONS, NINETEEN_POSITIONS, Scheme
from driftlab.motion.turntable import turntable_trajectory
from numerical_growth import numerical_growth
from support import EPS

GROUPS = ("lever arms", "time skew", "accelerometer quadratic", "gyro g-sensitivity")
AVERAGED = ERROR_MODELS["averaged"]
LARGER = AVERAGED.with_states(*GROUPS)
NEW = slice(27, 49)
LATITUDE = float(np.radians(37.5))
QUICK = TurntableTrial(
    replace(NINETEEN_POSITIONS, dwell=45.0), sample_interval=0.25, update_interval=3.0, keep=10**6
)
ARMS = NO_HIGHER_ORDER_ERRORS._replace(lever_arms=0.03 * np.eye(3))
"""Each accelerometer three centimetres out on its own axis."""


def test_states_are_added_behind_and_only_once():
    assert LARGER.size == 49
    assert LARGER.names[:27] == AVERAGED.names
    assert len(set(LARGER.names)) == 49
    assert AVERAGED.with_states() is AVERAGED
    both = AVERAGED.with_states("lever arms", "time skew")
    assert AVERAGED.with_states("time skew", "lever arms") is both
    assert AVERAGED.with_states("time skew").with_states("lever arms").names == both.names


def test_state_of_the_errors_of_a_state_is_the_state():
    states = np.random.default_rng(1).standard_normal((2, 3, 49))
    found = LARGER.state(LARGER.imu_errors(states), LARGER.higher_order_errors(states))
    np.testing.assert_allclose(found[..., 6:], states[..., 6:], rtol=0, atol=16 * EPS)
    none = LARGER.higher_order_errors(LARGER.state(TYPICAL_ERRORS))
    assert not any(np.any(part) for part in none)


def test_prior_deviations_are_those_that_are_told():
    prior = PriorStandardDeviations(lever_arm=2.0, time_skew=3.0, gyro_g_sensitivity=5.0)
    covariance = LARGER.covariance(prior, [0, 0, 0, 1])
    np.testing.assert_allclose(
        covariance[:27, :27], AVERAGED.covariance(prior, [0, 0, 0, 1]), rtol=1e-12, atol=1e-23
    )
    sizes = [2.0] * 9 + [3.0] + [prior.accelerometer_quadratic] * 3 + [5.0] * 9
    np.testing.assert_allclose(covariance[NEW, NEW], np.diag(sizes) ** 2)
    assert not covariance[:27, NEW].any()


def test_effects_of_states_are_what_their_errors_feel():
    rng = np.random.default_rng(8)
    angle, velocity, change, state = (rng.standard_normal(size) for size in [(5, 3)] * 3 + [22])
    shares = _higher_order_effects(GROUPS, np.full(5, 0.1), angle, velocity, change)
    felt = higher_order_effects(0.1, angle, velocity, _unpacked(state, GROUPS), change)
    for rows, expected in zip(shares, felt, strict=True):
        np.testing.assert_allclose(rows @ state, expected, rtol=0, atol=1e-12)


def test_growth_is_that_of_the_nonlinear_navigation():
    """By differences of two navigations, each new state by itself."""
    turns = Scheme("+40X -30Z +50Y", ("North", "West", "Up"), dwell=0.1, rate=np.radians(30))
    record = turntable_trajectory(turns, LATITUDE, 0.01, multiple_of=2)
    increments = record.increments
    duration = 0.01 * len(increments.angle)
    found = transition_of_increments(
        LARGER,
        free_transition(LATITUDE, duration),
        record.attitude[0::2],
        increments,
        _rate_changes(0.01, increments.angle),
    )
    expected = numerical_growth(record, LATITUDE, LARGER)
    # A jump of the rate stands in the middle of a pair, which turns by 0.01 rad in all.
    size = np.abs(expected[3:, NEW]).max(axis=0)
    assert (np.abs(found[3:6, NEW] - expected[3:, NEW]) < 0.01 * size).all()
    sensitive = slice(40, 49)
    size = np.abs(expected[:3, sensitive]).max(axis=0)
    assert (np.abs(found[:3, sensitive] - expected[:3, sensitive]) < 1e-3 * size).all()
    np.testing.assert_array_equal(found[6:], np.eye(49)[6:])


def test_growth_along_a_scheme_has_its_jumps():
    """The steps without data and those of increments, over a turn that begins and ends."""
    scheme = Scheme("+90X", ("North", "West", "Up"), dwell=5.0)
    whole = np.eye(49)
    for matrix in linearize_along(scheme, LATITUDE, LARGER).transitions:
        whole = matrix @ whole
    record = turntable_trajectory(scheme, LATITUDE, 0.01, multiple_of=2)
    increments, found = record.increments, np.eye(49)
    changes = _rate_changes(0.01, increments.angle)
    for begin in range(0, len(increments.angle), 100):
        rows = slice(begin, begin + 100)
        found = (
            transition_of_increments(
                LARGER,
                free_transition(LATITUDE, 1.0),
                record.attitude[begin : begin + 101 : 2],
                increments.part(begin, begin + 100),
                changes[rows],
            )
            @ found
        )
    # The increments put half of a jump into the interval before it: half of 1.7 milliradians.
    for states in (slice(27, 36), slice(36, 37), slice(37, 40), slice(40, 49)):
        size = np.abs(found[3:6, states]).max()
        assert np.abs(whole[3:6, states] - found[3:6, states]).max() < 1.7e-3 * size


def test_a_jump_of_the_rate_tilts_by_what_a_gyro_feels_of_it(monkeypatch):
    """No error of the book is such, so one stands in here: a gyro that lags by its constant."""
    name = "gyro scale-factor asymmetry"
    lag = TERMS[name]._replace(effect=lambda times, angle, velocity, change: change)
    monkeypatch.setattr(error_dynamics, "TERMS", {name: lag})
    way = linearize_along(Scheme("+90Z", dwell=2.0), LATITUDE, AVERAGED.with_states(name))
    whole, tilts = np.eye(30), []
    for _, steps in way.segments:
        for matrix in way.transitions[steps]:
            whole = matrix @ whole
        tilts.append(whole[:3, 27:])
    rate = np.diag([0.0, 0.0, -way.segments[1][0].rate])
    # The Earth turns by a milliradian in the 13 s.
    for found, expected in zip(tilts, (0 * rate, rate, 0 * rate), strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-3 * np.abs(rate).max())


def test_states_that_are_known_to_be_zero_change_nothing():
    surely = PriorStandardDeviations(
        lever_arm=0, time_skew=0, accelerometer_quadratic=0, gyro_g_sensitivity=0
    )
    trial = replace(QUICK, scheme=Scheme("+90X +90Y", dwell=9.0), prior=surely)
    with pytest.warns(UserWarning, match="unobservable"):
        plain, more = (
            replace(trial, states=states).run(
                np.random.default_rng(2), imu_errors=TYPICAL_ERRORS, higher_order=given
            )
            for states, given in (((), None), (GROUPS, NO_HIGHER_ORDER_ERRORS))
        )
    standard_deviations = plain.calibration.standard_deviations[-1]
    gaps = more.calibration.state[-1, :27] - plain.calibration.state[-1]
    assert np.abs(gaps[6:] / standard_deviations[6:]).max() < 1e-6
    np.testing.assert_allclose(more.calibration.nis, plain.calibration.nis, rtol=1e-6)


@pytest.fixture(scope="module")
def twenty():
    """Twenty typical units with all errors of higher order, and a filter that looks for them."""
    hurried = replace(QUICK.scheme, dwell=12.0)
    return replace(QUICK, scheme=hurried, states=GROUPS).run(np.random.default_rng(3), 20)


def test_errors_are_as_large_as_the_filter_says(twenty):
    # One in a thousand of a chi-square sum is outside.
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 49 * 20)
    assert low < twenty.nees[:, -1].sum() < high
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 3 * twenty.calibration.nis.size)
    assert low < twenty.calibration.nis.sum() < high


def test_a_filter_of_27_states_is_wrong_by_many_deviations_and_its_innovations_say_little():
    """Without noise, so that nothing hides what three centimetres do."""
    quiet = replace(
        QUICK,
        noise=ImuNoise(0.0, 0.0, 0.0),
        assumed_noise=ImuNoise(),
        prior=PriorStandardDeviations(attitude=1e-9),
    )
    biases = [AVERAGED.names.index(f"accelerometer bias {axis}") for axis in "xyz"]
    wrong, right = (
        replace(quiet, states=states).run(
            np.random.default_rng(4), imu_errors=NO_ERRORS, higher_order=ARMS
        )
        for states in ((), ("lever arms",))
    )
    ratio = wrong.errors[-1, biases] / wrong.calibration.standard_deviations[-1, biases]
    assert ratio.min() > 3  # as noise alone would make one of three in a hundred and twenty runs
    # Noise would make the mean one, and scatter it by so much: three of chi-square an update.
    nis = wrong.calibration.nis
    assert nis.mean() / 3 < 2 * np.sqrt(2 / (3 * nis.size))
    # What is left is the pull of the prior P0 towards zero: the error P P0^-1 x of the truth x.
    # The filter is linear but for a fiftieth of a deviation.
    model, covariance = right.calibration.model, right.calibration.covariance[-1]
    before = model.covariance(quiet.prior, quiet.scheme.start_attitude)
    truth = model.state(NO_ERRORS, ARMS)
    pulled = covariance @ np.linalg.lstsq(before, truth, rcond=1e-12)[0]
    gap = (np.abs(right.errors[-1]) - np.abs(pulled)) / right.calibration.standard_deviations[-1]
    assert np.abs(gap[6:]).max() < 0.02
    assert np.abs(right.errors[-1] / right.calibration.standard_deviations[-1])[6:].max() < 1


@pytest.mark.parametrize("scheme", [NINETEEN_POSITIONS, EIGHTEEN_ROTATIONS])
def test_all_new_states_can_be_seen(scheme):
    assert not unobservable_subspace(linearize_along(scheme, LATITUDE, LARGER)).descriptions
    everything = FULL.with_states(*GROUPS)
    told = unobservable_subspace(linearize_along(scheme, LATITUDE, everything)).descriptions
    assert told == [
        f"both triads turned together about {axis}, the attitude with them" for axis in "xyz"
    ]


def test_a_second_pass_finds_what_the_first_found():
    trial = replace(QUICK, scheme=replace(QUICK.scheme, dwell=6.0), states=("lever arms",))
    once, twice = (
        replace(trial, passes=passes).run(np.random.default_rng(5), 3).calibration
        for passes in (1, 2)
    )
    gap = (once.state - twice.state)[:, -1] / once.standard_deviations[:, -1].clip(1e-30)
    # Of second order in what the first pass corrected; ten other seeds gave up to 0.03.
    assert np.abs(gap[:, 6:]).max() < 0.06
