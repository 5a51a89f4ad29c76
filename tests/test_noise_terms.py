"""Fits of an Allan deviation: the terms that they find, bound and refuse."""

import numpy as np
import pytest
from scipy.stats import binom

from driftlab.allan import allan_deviation
from driftlab.core.allan import Points, upper_bound
from driftlab.noise_terms import TERMS, NoiseTerms, fit_noise_terms
from support import chi_bounds

MILLION = 1e-6
"""Probability with which each bound below would be passed by chance; the seeds are fixed."""
MIXED = NoiseTerms(3.0, 1.0, 0.0, 0.05, 0.0)


def test_a_fit_finds_the_terms_within_its_deviations_and_bounds_the_others():
    runs, rng = 20, np.random.default_rng(6)
    found = allan_deviation(MIXED.samples(5000, 1.0, rng, runs), 1.0)
    fits = [fit_noise_terms(found.row(run)) for run in range(runs)]
    for name in ("quantisation", "angle_random_walk", "rate_random_walk"):
        seen = [fit for fit in fits if name in fit.standard_deviations]
        assert len(seen) >= 0.9 * runs
        errors = [
            (getattr(fit.terms, name) - getattr(MIXED, name)) / fit.standard_deviations[name]
            for fit in seen
        ]
        assert np.mean(np.square(errors)) < chi_bounds(len(errors))[1]
        assert abs(np.mean(errors)) < 4.9 / np.sqrt(len(errors))
    for name in ("bias_instability", "rate_ramp"):
        # Seen by mistake once in some twenty runs.
        assert sum(name in fit.standard_deviations for fit in fits) <= binom.ppf(
            1 - MILLION, runs, 0.05
        )
        assert all(fit.upper_bounds[name] > 0 for fit in fits if name in fit.upper_bounds)
    assert np.mean([fit.rms_residual for fit in fits]) < 1.1


@pytest.mark.parametrize("name", TERMS)
def test_a_pure_term_is_found_alone(name):
    rng = np.random.default_rng(7)
    fit = fit_noise_terms(allan_deviation(NoiseTerms(**{name: 1.0}).samples(4000, 1.0, rng), 1.0))
    assert list(fit.standard_deviations) == [name]
    assert list(fit.upper_bounds) == [term for term in TERMS if term != name]
    assert getattr(fit.terms, name) == pytest.approx(
        1.0, abs=4.9 * fit.standard_deviations[name] + 1e-6
    )
    place = TERMS.index(name)
    assert np.flatnonzero(np.diagonal(fit.covariance)).tolist() in ([place], [])


def test_what_a_record_is_too_short_to_see_stays_below_its_bound():
    """A random walk far below the white noise: 95 % of the bounds are above it, or more."""
    runs, weak = 20, NoiseTerms(angle_random_walk=1.0, rate_random_walk=1e-3)
    found = allan_deviation(weak.samples(1000, 1.0, np.random.default_rng(8), runs), 1.0)
    fits = [fit_noise_terms(found.row(run)) for run in range(runs)]
    bounds = [fit.upper_bounds.get("rate_random_walk", np.inf) for fit in fits]
    assert sum(bound > 1e-3 for bound in bounds) >= binom.ppf(MILLION, runs, 0.95)
    # And they are of use: the line is not above the white noise at a tenth of the record.
    assert np.median(bounds) * np.sqrt(100 / 3) < 1 / np.sqrt(100) * 2


def test_noise_of_another_kind_shows_as_misfit():
    rates = np.random.default_rng(9).normal(size=20_000) + 5 * np.sin(np.arange(20_000) / 30)
    assert fit_noise_terms(allan_deviation(rates, 1.0)).rms_residual > 5


def test_terms_that_are_not_sought_are_zero():
    found = allan_deviation(MIXED.samples(2000, 1.0, np.random.default_rng(10)), 1.0)
    fit = fit_noise_terms(found, ["angle_random_walk"])
    assert fit.terms == NoiseTerms(angle_random_walk=fit.terms.angle_random_walk)
    assert fit.upper_bounds == {}


def test_an_unseen_term_is_smaller_than_its_bound_with_95_percent():
    found = allan_deviation(MIXED.samples(500, 1.0, np.random.default_rng(11)), 1.0)
    fit = fit_noise_terms(found)
    counts = np.round(found.averaging_times / found.interval).astype(int)
    points = Points(
        found.deviation**2, found.degrees_of_freedom, counts, found.count, found.interval
    )
    squares = np.square([getattr(fit.terms, name) for name in TERMS])
    assert fit.upper_bounds
    for name, bound in fit.upper_bounds.items():
        expected = upper_bound(points, squares, TERMS.index(name), 0.95)
        assert bound**2 == pytest.approx(expected, rel=1e-12)


def test_units_are_whatever_the_samples_have():
    rates = MIXED.samples(2000, 1.0, np.random.default_rng(11))
    once, small = (fit_noise_terms(allan_deviation(s * rates, 1.0)) for s in (1.0, 1e-9))
    for name in once.standard_deviations:
        assert getattr(small.terms, name) == pytest.approx(1e-9 * getattr(once.terms, name))
    for name, bound in once.upper_bounds.items():
        assert small.upper_bounds[name] == pytest.approx(1e-9 * bound, rel=1e-2)


def test_deviations_and_misfit_follow_from_the_covariance_and_the_variances():
    found = allan_deviation(MIXED.samples(2000, 1.0, np.random.default_rng(11)), 1.0)
    fit = fit_noise_terms(found)
    assert len(fit.standard_deviations) > 1
    for name, deviation in fit.standard_deviations.items():
        place, term = TERMS.index(name), getattr(fit.terms, name)
        # A term is the root of its square.
        assert 2 * term * deviation == pytest.approx(np.sqrt(fit.covariance[place, place]))
    ratios = (found.deviation / fit.terms.deviation(found.averaging_times)) ** 2
    rest = (ratios - 1) * np.sqrt(found.degrees_of_freedom / 2)
    assert fit.rms_residual == pytest.approx(np.sqrt(np.mean(rest**2)))


def test_terms_follow_the_unit_of_time():
    rates = MIXED.samples(2000, 1.0, np.random.default_rng(11))
    once, shorter = (fit_noise_terms(allan_deviation(rates, step)) for step in (1.0, 0.1))
    powers = dict(zip(TERMS, (1.0, 0.5, 0.0, -0.5, -1.0), strict=True))
    assert once.standard_deviations.keys() == shorter.standard_deviations.keys()
    for name, deviation in once.standard_deviations.items():
        scale = 0.1 ** powers[name]
        assert getattr(shorter.terms, name) == pytest.approx(scale * getattr(once.terms, name))
        assert shorter.standard_deviations[name] == pytest.approx(scale * deviation)
    for name, bound in once.upper_bounds.items():
        assert shorter.upper_bounds[name] == pytest.approx(0.1 ** powers[name] * bound, rel=1e-2)
    assert shorter.rms_residual == pytest.approx(once.rms_residual)


def test_one_averaging_time_six_times_is_one():
    rates = MIXED.samples(500, 0.1, np.random.default_rng(12))
    found = allan_deviation(rates, 0.1, [0.1] * 6)
    assert found.deviation.shape == (6,)
    with pytest.raises(ValueError, match=r"^allan: .* terms, 5 different ones, got 1\.$"):
        fit_noise_terms(found)
    once, twice = (allan_deviation(rates, 0.1, times) for times in ([0.1, 1.0], [0.1, 1.0, 0.1]))
    sought = ["quantisation", "angle_random_walk"]
    assert fit_noise_terms(once, sought).terms == fit_noise_terms(twice, sought).terms


def test_fits_refuse_what_they_cannot_do():
    good = allan_deviation(np.random.default_rng(0).normal(size=(2, 100)), 1.0)
    with pytest.raises(ValueError, match=r"^allan: expected that of one sensor.*allan\.row\(0\)"):
        fit_noise_terms(good)
    with pytest.raises(ValueError, match=r"^terms: expected some of quantisation.*got 'white'"):
        fit_noise_terms(good.row(0), ["white"])
    with pytest.raises(
        ValueError, match=r"^allan: expected at least as many .* 5 different ones, got 2\.$"
    ):
        fit_noise_terms(allan_deviation(np.arange(10.0) ** 2, 1.0, [1.0, 2.0]))
    with pytest.raises(
        ValueError, match=r"^allan: expected an AllanDeviation.* from allan_deviation.*, got"
    ):
        fit_noise_terms(good.deviation)


def test_a_fit_needs_a_sensor_that_is_not_silent():
    with pytest.raises(ValueError, match=r"^allan: expected at least .* above zero .*, got 0\.$"):
        fit_noise_terms(allan_deviation(np.full(50, 0.3), 0.1))
