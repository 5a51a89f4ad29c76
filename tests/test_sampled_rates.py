"""Increments from sampled rates, by splines: exactness, order, refusals."""

import numpy as np
import pytest

from driftlab.motion.profiles import Coning
from driftlab.sampled_rates import increments_from_rates
from support import EPS

CONE = Coning(half_angle=np.radians(10), frequency=5.0)


def rates_at(rate, seconds=1.0):
    return CONE.rate(np.arange(round(rate * seconds) + 1) / rate)


@pytest.mark.parametrize("degree", [3, 5, 7])
def test_splines_integrate_polynomials_of_their_degree(degree):
    rng = np.random.default_rng(0)
    polynomial = np.polynomial.Polynomial(rng.uniform(-1, 1, degree + 1))
    times = np.sort(rng.uniform(0, 0.04, 31)) + 0.1 * np.arange(31)
    rates = polynomial(times)[:, np.newaxis] * [1.0, -2.0, 0.5]
    found = increments_from_rates(rates, 0.13, times=times, degree=degree)
    edges = times[0] + 0.13 * np.arange(len(found) + 1)
    assert edges[-1] <= times[-1] < edges[-1] + 0.13
    expected = np.diff(polynomial.integ()(edges))[:, np.newaxis] * [1.0, -2.0, 0.5]
    # The integrals grow to 3^8; splines of 31 samples magnify rounding by less than a hundred.
    bound = 100 * EPS * np.abs(polynomial.integ()(edges)).max() * 2
    np.testing.assert_allclose(found, expected, rtol=0, atol=bound)


@pytest.mark.parametrize("degree", [3, 5, 7])
def test_error_of_the_integrals_goes_with_the_degree_and_one(degree):
    def error(size):
        rate = round(12.5 / size)
        found = increments_from_rates(rates_at(rate), 1 / rate, degree=degree)
        return np.abs(np.cumsum(found - CONE.increments(1 / rate, rate), axis=0)).max()

    # The ends, where the spline has neighbours on one side only, go with one power more.
    sizes = np.array([1 / 8, 1 / 16, 1 / 32])
    slope = np.polyfit(np.log(sizes), np.log([error(size) for size in sizes]), 1)[0]
    assert degree + 0.9 < slope < degree + 2.1


def test_times_that_are_equally_spaced_are_the_interval():
    rates, times = rates_at(100), 1.7e3 + np.arange(101) / 100
    plain = increments_from_rates(rates, 0.01)
    assert plain.shape == (100, 3)
    # The differences of such times are good to 1e-13 s; rates are below 40 rad/s.
    np.testing.assert_allclose(
        increments_from_rates(rates, 0.01, times=times), plain, rtol=0, atol=1e-10
    )
    twice = increments_from_rates(rates, 0.02, times=times)
    np.testing.assert_allclose(twice, plain[::2] + plain[1::2], rtol=0, atol=1e-10)


@pytest.mark.parametrize("interval", [0.005, 0.01, 0.02, 0.1, 1 / 128])
def test_seconds_since_1970_lose_no_interval(interval):
    rng = np.random.default_rng(4)
    for count in (8, 100, 364, 399):
        times = 1.7e9 + rng.uniform(0, 1) + interval * np.arange(count)
        found = increments_from_rates(np.ones((count, 3)), interval, times=times)
        assert found.shape == (count - 1, 3)
        # A constant rate does not notice the rounding of the times.
        np.testing.assert_allclose(found, interval, rtol=1e-9)
    short = increments_from_rates(np.ones((9, 3)), 1.0, times=0.998 * np.arange(9.0))
    assert len(short) == 7


def test_a_lost_sample_is_bridged_if_the_caller_allows_it():
    times = np.arange(101) / 100
    lost = np.delete(np.arange(101), 50)
    true = CONE.increments(0.01, 100)
    found = increments_from_rates(CONE.rate(times[lost]), 0.01, times=times[lost], longest_gap=2.5)
    assert found.shape == true.shape
    # The error is of the sixth power of the spacing, which is twice as long at the gap.
    whole = np.abs(increments_from_rates(CONE.rate(times), 0.01) - true).max()
    assert np.abs(found - true).max() < 2**6 * whole


def test_a_gap_may_be_just_so_long():
    """One lost sample of whole seconds leaves a gap of two."""
    times, rates = np.delete(np.arange(10.0), 5), np.ones((9, 3))
    found = increments_from_rates(rates, 1.0, times=times, longest_gap=2.0)
    np.testing.assert_allclose(found, np.ones((9, 3)), rtol=1e-12)


def test_noise_is_magnified_at_the_ends_and_averaged_in_the_middle():
    """Weights of all samples in all increments, one sample at a time."""
    one_by_one = np.repeat(np.eye(61)[..., np.newaxis], 3, axis=-1)
    for degree, at_end, between in ((3, 0.93, 0.66), (5, 2.2, 0.70), (7, 10.3, 0.72)):
        weights = increments_from_rates(one_by_one, 1.0, degree=degree)[..., 0]
        variance = (weights**2).sum(axis=0)
        np.testing.assert_allclose(variance[[0, -1]], at_end, rtol=0.01)
        np.testing.assert_allclose(variance[20:-20], between, atol=0.005)
        # Far from the ends each sample counts once, so a long sum has the noise of its samples.
        np.testing.assert_allclose(weights.sum(axis=1)[20:-20], 1, rtol=1e-3)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            {"rates": np.zeros((5, 3))},
            r"rates: expected shape \(\.\.\., m, 3\) with m at least 6 for degree 5, "
            r"got shape \(5, 3\)",
        ),
        ({"interval": 0.0}, r"interval: expected a positive number, got 0\.0"),
        ({"degree": 4}, "degree: expected 3, 5 or 7, got 4"),
        (
            {"times": [0, 1, 2, 3, 3, 4, 5, 6, 7]},
            r"times: expected 9 increasing times \(m,\), got 3 after 3 in row 5",
        ),
        ({"times": 100 * np.arange(9)}, "times: expected s, with steps of some 0.1 s, .* millisec"),
        (
            {"times": [0, 1, 2, 3, 4, 6, 7, 8, 9]},
            r"times: expected no gap longer than 1\.5 times the usual 1 s \(longest_gap\), "
            "got 2 s after the time 4",
        ),
        (
            {"times": [0, 1, 2, 3, 4, 7, 8, 9, 10], "longest_gap": 2.5},
            r"times: expected no gap longer than 2\.5 times the usual 1 s \(longest_gap\), got 3 s",
        ),
        ({"longest_gap": 1.0}, r"longest_gap: expected more than 1, got 1\.0"),
        (
            {"times": np.arange(9.0), "interval": 9.0},
            "interval: expected at most the time of all samples, 8 s, got 9",
        ),
    ],
)
def test_rates_that_make_no_increments_are_refused(arguments, words):
    good = {"rates": np.zeros((9, 3)), "interval": 0.1}
    assert increments_from_rates(**good).shape == (8, 3)
    with pytest.raises(ValueError, match=rf"^{words}"):
        increments_from_rates(**(good | arguments))


def test_one_interval_may_be_all_of_the_time():
    found = increments_from_rates(np.ones((9, 3)), 8.0, times=np.arange(9.0))
    np.testing.assert_allclose(found, 8 * np.ones((1, 3)), rtol=1e-13)


def test_a_time_that_is_none_is_refused():
    times = np.datetime64("2026-05-01T12:00:00") + np.arange(9)
    times[4] = np.datetime64("NaT")
    words = r"^times: expected a time for each sample, got none in row 5\.$"
    with pytest.raises(ValueError, match=words):
        increments_from_rates(np.ones((9, 3)), 1.0, times=times)


def test_times_in_sentences_are_counted_from_the_first():
    times = np.datetime64("2026-05-01T12:00:00") + np.arange(9)
    with pytest.raises(ValueError, match=r"got -1 after 0 in row 2\.$"):
        increments_from_rates(np.ones((9, 3)), 1.0, times=times[::-1])
    with pytest.raises(ValueError, match=r"^times: expected shape \(\.\.\., 9\), got shape \(1,\)"):
        increments_from_rates(np.ones((9, 3)), 1.0, times=times[:1])


def test_masked_dates_are_refused_like_other_masked_times():
    times = np.datetime64("2026-05-01T12:00:00") + np.arange(9)
    with pytest.raises(ValueError, match=r"^times: expected all values to be there, got masked"):
        increments_from_rates(
            np.ones((9, 3)), 1.0, times=np.ma.array(times, mask=np.arange(9) == 4)
        )


def test_times_of_a_zone_are_moments_as_well():
    pandas = pytest.importorskip("pandas")
    times = pandas.Series(pandas.date_range("2026-05-01", periods=9, freq="s", tz="Asia/Tokyo"))
    rates = np.random.default_rng(3).normal(size=(9, 3))
    np.testing.assert_allclose(
        increments_from_rates(rates, 1.0, times=times),
        increments_from_rates(rates, 1.0, times=np.arange(9.0)),
        rtol=0,
        atol=1e-14,
    )


def test_dates_and_times_are_seconds_since_the_first():
    rates = CONE.rate(np.arange(200) / 100)
    times = np.datetime64("2026-05-01T12:00:00.000", "ms") + 10 * np.arange(200)
    np.testing.assert_allclose(
        increments_from_rates(rates, 0.01, times=times),
        increments_from_rates(rates, 0.01, times=np.arange(200) / 100),
        rtol=0,
        atol=1e-15,
    )
