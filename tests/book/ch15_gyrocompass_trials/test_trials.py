"""Trials on a dial table against closed forms, and the range of a sample against known laws."""

from math import comb

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation
from scipy.stats import beta, binom, chi, kstest

from driftlab.book.ch15_gyrocompass_trials.experiments.trials import (
    largest_range_over_standard_deviation,
    range_over_standard_deviation,
    turntable_heading_error,
)
from driftlab.earth import EARTH_RATE, gravity
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.quaternion import rotate
from support import EPS, order_of, range_distribution

LATITUDE = np.radians(51.5)
LEVEL_RATE = EARTH_RATE * np.cos(LATITUDE)
DIAL = np.radians(np.arange(-360.0, 361.0, 15.0))
GYRO_BIAS = np.array([0.6, -0.9, 0.8]) * 1e-2 * LEVEL_RATE
ACCELEROMETER_BIAS = np.array([3e-3, -5e-3, 4e-3]) * float(gravity(LATITUDE))
NONE = np.zeros(3)


def wrapped(angle):
    return np.angle(np.exp(1j * angle))


# On the dial table


@pytest.mark.parametrize("north", [0.002, -1.0, 3.0, 4.0])
def test_a_dial_that_is_not_set_to_north_adds_its_error(north):
    errors = turntable_heading_error(DIAL, NONE, NONE, LATITUDE, north_error=north)
    np.testing.assert_allclose(errors, wrapped(north), rtol=0, atol=32 * EPS)
    assert (np.abs(errors) <= np.pi).all()


def test_drifts_on_a_level_table_in_closed_form():
    """The heading is the direction of the level rate in the body: exactly, not to first order."""
    errors = turntable_heading_error(DIAL, GYRO_BIAS, NONE, LATITUDE)
    forward = LEVEL_RATE * np.cos(DIAL) + GYRO_BIAS[0]
    right = LEVEL_RATE * np.sin(DIAL) + GYRO_BIAS[2]
    expected = wrapped(np.arctan2(right, forward) - DIAL)
    np.testing.assert_allclose(errors, expected, rtol=0, atol=32 * EPS)
    assert np.abs(errors).max() > 0.009


def test_a_leaning_table_turns_the_bow_by_the_rotation_alone():
    """The compass finds the true heading of the leaning body: where its bow points."""
    tilt = np.array([0.2, -0.3])
    errors = turntable_heading_error(DIAL, NONE, NONE, LATITUDE, north_error=0.1, tilt=tilt)
    heading = DIAL + 0.1
    # A positive heading is West of North, and West is minus East.
    level = np.stack([np.cos(heading), np.zeros_like(DIAL), -np.sin(heading)], axis=-1)
    bow = Rotation.from_rotvec([0.2, 0.0, -0.3]).apply(level)
    expected = wrapped(np.arctan2(-bow[:, 2], bow[:, 0]) - DIAL)
    np.testing.assert_allclose(errors, expected, rtol=0, atol=64 * EPS)


def test_a_tilt_does_harm_only_in_second_order_and_a_wrong_north_in_first():
    tilt = np.array([1.0, 0.0])

    def harm(**table):
        return np.abs(turntable_heading_error(DIAL, NONE, NONE, LATITUDE, **table)).max()

    assert order_of(lambda size: harm(tilt=size * tilt)) == pytest.approx(2, abs=0.01)
    assert order_of(lambda size: harm(north_error=size)) == pytest.approx(1, abs=1e-9)
    # Half of its square times the cosine and the sine of the angle to the bow: at most a quarter.
    assert harm(tilt=1e-3 * tilt) == pytest.approx(1e-6 / 4, rel=1e-5)


def test_a_pitched_and_rolled_table_of_a_perfect_compass_shows_the_dial():
    pitch, roll = np.meshgrid([-1.2, 0.3, 1.4], [-3.0, 0.2, 2.0])
    table = {"pitch": pitch, "roll": roll}
    errors = turntable_heading_error(0.7, NONE, NONE, LATITUDE, **table)
    np.testing.assert_allclose(errors, 0, rtol=0, atol=256 * EPS)


@pytest.mark.parametrize(
    "table", [{"north_error": 0.3}, {"pitch": 0.8, "roll": -1.1}], ids=["turned", "pitched"]
)
def test_a_pitched_unit_has_the_errors_of_its_alignment_to_first_order(table):
    north, pitch, roll = (table.get(name, 0.0) for name in ("north_error", "pitch", "roll"))
    attitude = from_euler_angles(DIAL + north, pitch, roll)

    def gap(size):
        biases = size * GYRO_BIAS, size * ACCELEROMETER_BIAS
        shown = turntable_heading_error(DIAL, *biases, LATITUDE, **table)
        local = (rotate(attitude, bias) for bias in biases)
        return np.abs(
            shown - north - alignment_errors(DIAL + north, pitch, LATITUDE, *local).heading
        )

    assert order_of(lambda size: gap(size).max()) == pytest.approx(2, abs=0.02)


def test_a_leaning_table_turns_a_pitched_bow_aside_in_first_order():
    """The compass shows where the bow points, the dial does not: tan(pitch) times the tilt."""
    north, east, pitch = 2e-4, -3e-4, 1.0
    errors = turntable_heading_error(DIAL, NONE, NONE, LATITUDE, pitch=pitch, tilt=[north, east])
    expected = np.tan(pitch) * (east * np.sin(DIAL) - north * np.cos(DIAL))
    np.testing.assert_allclose(errors, expected, rtol=0, atol=10 * (north**2 + east**2))


# Range over standard deviation

spread_samples = arrays(float, st.integers(2, 12), elements=st.floats(-100, 100)).filter(
    lambda values: np.ptp(values) > 1e-3
)


@given(spread_samples)
def test_range_over_deviation_is_the_quotient(values):
    mean = sum(values) / len(values)
    variance = sum((value - mean) ** 2 for value in values) / (len(values) - 1)
    expected = (max(values) - min(values)) / variance**0.5
    # The mean of numbers up to 100, against a spread of 1e-3 at least.
    assert float(range_over_standard_deviation(values)) == pytest.approx(expected, rel=1e-9)


@given(spread_samples)
def test_no_sample_has_more_range_than_the_most_nor_less_than_halves_at_the_ends(values):
    count = len(values)
    ratio = float(range_over_standard_deviation(values))
    assert ratio <= largest_range_over_standard_deviation(count) * (1 + 1e-9)
    # The largest variance of a range: half of the values at each of its ends.
    assert ratio >= 2 * np.sqrt((count - 1) / count) * (1 - 1e-9)


@pytest.mark.parametrize("count", [2, 3, 4, 5, 26, 1001])
def test_two_at_the_ends_and_all_others_in_the_middle_have_the_most(count):
    values = np.full(count, 5.0)
    values[[0, -1]] = 3.0, 7.0
    assert range_over_standard_deviation(values) == pytest.approx(
        largest_range_over_standard_deviation(count), rel=1e-12
    )
    assert largest_range_over_standard_deviation(count) == pytest.approx(np.sqrt(2 * count - 2))


def test_range_over_deviation_asks_for_neither_place_nor_size():
    rng = np.random.default_rng(2)
    values = rng.normal(size=(3, 4, 10))
    found = range_over_standard_deviation(values)
    assert found.shape == (3, 4)
    for size in (-3.0, 1e-6, 1e6):
        np.testing.assert_allclose(
            range_over_standard_deviation(size * (values + 2)), found, rtol=1e-12
        )
    np.testing.assert_allclose(
        range_over_standard_deviation(values[1, 2]), found[1, 2], rtol=4 * EPS
    )


# Of normal samples


def normal_ranges(count, trials, rng):
    return range_over_standard_deviation(rng.standard_normal((trials, count)))


@pytest.mark.parametrize("count", [3, 10, 26])
def test_normal_ranges_times_an_independent_deviation_are_ranges(count):
    """The ratio is independent of the sample's deviation, so any other one will do for it.

    What comes out is the range of normal values in units of their true deviation: the studentized
    range with infinitely many degrees of freedom.
    """
    rng = np.random.default_rng(count)
    ratios = normal_ranges(count, 20000, rng)
    assert ratios.shape == (20000,)
    standard_deviations = chi(count - 1).rvs(20000, random_state=rng) / np.sqrt(count - 1)
    # The distance is passed by chance once in ten thousand draws; the seeds are fixed.
    assert kstest(ratios * standard_deviations, range_distribution(count)).pvalue > 1e-4


@pytest.mark.parametrize(("count", "ratio"), [(4, 2.2), (5, 2.6), (10, 4.0)])
def test_far_tail_of_normal_ranges_in_closed_form(count, ratio):
    """Beyond sqrt(3 (n - 1)/2) only one pair can be so far apart, and a pair follows a beta law."""
    top = largest_range_over_standard_deviation(count)
    assert np.sqrt(0.75) * top < ratio < top
    pair = beta.sf((ratio / top) ** 2, 0.5, (count - 2) / 2)
    trials = 100000
    seen = np.count_nonzero(normal_ranges(count, trials, np.random.default_rng(5)) > ratio)
    low, high = binom.ppf([0.5e-6, 1 - 0.5e-6], trials, comb(count, 2) * pair)
    assert 10 < low <= seen <= high


def test_equal_values_are_refused_and_small_ones_are_not():
    for equal in ([0.1, 0.1, 0.1], [1e-200, 1e-200], [[1.0, 2.0], [3.0, 3.0]]):
        with pytest.raises(ValueError, match=r"^values: expected samples that spread"):
            range_over_standard_deviation(equal)
    for size in (1e-200, 1e49):
        found = range_over_standard_deviation(size * np.array([0.0, 1.0, 3.0]))
        assert found == pytest.approx(3 / np.std([0.0, 1.0, 3.0], ddof=1), rel=1e-12)
