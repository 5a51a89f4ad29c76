"""A compass on a parked car: the published numbers against their claims, and the recording."""

import numpy as np
import pytest
from scipy.constants import degree, hour
from scipy.stats import chi2, f, pearsonr

from driftlab.book.ch15_gyrocompass_trials.experiments import PAPER_DEVIATION, PAPER_SPREAD
from driftlab.book.ch15_gyrocompass_trials.experiments.trials import (
    range_over_standard_deviation,
)
from driftlab.book.ch17_real_recordings.experiments.parked_car import HEADER, spread
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.earth import EARTH_RATE
from driftlab.vectors import wrap_angle
from published import kept_table, published
from support import recording_or_skip


def chance_of_ratio(first: float, second: float, freedom: int) -> float:
    """Chance that one true deviation gives two independent samples with such deviations."""
    ratio = max(first / second, second / first) ** 2
    return float(2 * f.sf(ratio, freedom, freedom))


def chance_of_paired_ratio(first: np.ndarray, second: np.ndarray) -> float:
    """Chance that pairs with one true deviation show so different ones, by Pitman and Morgan.

    The covariance of sums and differences is the difference of the variances, whatever the two have
    in common.
    """
    one, two = wrap_angle(np.stack([first, second]) - first[0])
    return float(pearsonr(one + two, one - two).pvalue)


def car() -> DataTable:
    """The study as it is published, which needs no recording."""
    return kept_table("17-parked-car")


def test_every_stretch_of_five_minutes_gives_the_heading_of_the_header():
    assert car().stretches.shape == (3, 6)
    assert np.degrees(np.abs(car().stretches[2] - HEADER)).max() < 0.1


def test_restarts_in_inertial_space_repeat_and_means_do_not():
    means, two, carried = (spread(row) for row in car().restarts)
    assert len(car().restarts[0]) == 26
    # Ends of the intervals of 95 per cent, so that other trials would very likely say it as well.
    assert np.degrees(carried.high) < 0.1 < 0.2 < np.degrees(two.low)
    assert np.degrees(two.high) < 0.5 < 10 < np.degrees(means.low)
    assert np.degrees(spread(car().longer[2]).high) < 0.03
    # The gap of "five times as much" in the notes of `align_in_inertial_frame`.
    assert two.deviation / carried.deviation == pytest.approx(5, abs=0.2)
    found = np.degrees([means.deviation, carried.deviation])
    np.testing.assert_allclose(found, [15, 0.06], rtol=0.06)
    # The two methods have the same stretches, so the test is of pairs.
    assert chance_of_paired_ratio(*car().restarts[1:]) < 1e-6


def test_means_are_wrong_by_degrees_while_the_car_is_shaken_and_fair_while_it_is_quiet():
    wrong = np.degrees(np.abs(car().restarts[0] - HEADER))
    loudest = car().unrest[: 26 * 7].reshape(26, 7).max(axis=1)
    quiet = loudest < np.median(loudest)
    assert wrong[~quiet].max() > 50
    assert np.median(wrong[~quiet]) > 4 * np.median(wrong[quiet])
    assert np.degrees(car().stretches[0, 0] - HEADER) > 7
    # The alarm: the latitude that the means find.
    assert np.degrees(np.abs(car().found_latitude - car().latitude)).max() > 7


def test_the_spread_is_of_the_papers_size_and_of_a_normal_range():
    found = spread(car().restarts[2])
    deviation = np.degrees(found.deviation)
    assert chance_of_ratio(deviation, PAPER_DEVIATION, 25) > 0.3
    assert round(np.degrees(found.reach), 1) == PAPER_SPREAD
    ranges = range_over_standard_deviation(np.random.default_rng(1).standard_normal((20_000, 26)))
    ratio = range_over_standard_deviation(car().restarts[2])
    assert 0.05 < np.mean(ranges < ratio) < 0.95
    # As a drift of the East gyro the paper's is the smaller, for its place lies farther North.
    unit = EARTH_RATE * np.cos(car().latitude) / (degree / hour)
    assert 0.012 < found.deviation * unit < 0.016


def test_stated_deviations_hold_the_headings():
    """Against the mean of all. In 99 of 100 normal series 22 of 26 or more lie within two."""
    gap = car().restarts[2] - np.average(car().restarts[2], weights=car().restart_deviations ** -2)
    scaled = gap / car().restart_deviations
    assert np.sum(np.abs(scaled) < 2) >= 22
    # They are somewhat too large here, not too small.
    assert np.sum(scaled**2) < chi2.ppf(0.975, 25)


def test_gravity_moves_as_the_earth_turns():
    level = EARTH_RATE * np.cos(car().latitude)
    assert np.abs(car().level_rate / level - 1).max() < 0.01


def test_the_headings_sign_is_that_of_the_gyros():
    """On a car that looks East the right axis looks South, and the Earth turns against it."""
    whole = recording_or_skip("laser-gyro").in_axes("FUR")
    quiet = whole.between(1050.0, 1490.0).increments()
    forward, up, right = quiet.mean_rate.mean(axis=0) / EARTH_RATE
    latitude = whole.latitude
    # The unit is not levelled to better than a degree or two.
    assert np.isclose(right, -np.cos(latitude), atol=0.02)
    assert np.isclose(forward, 0.0, atol=0.02)
    assert np.isclose(up, np.sin(latitude), atol=0.02)


@published("17-parked-car")
def test_the_whole_study_is_the_published_one(figure):
    recording_or_skip("laser-gyro")
    for name in ("restarts", "longer", "stretches", "found_latitude", "level_rate"):
        found, kept = (getattr(data, name) for data in (figure.data, car()))
        np.testing.assert_allclose(found, kept, 1e-8, 1e-10)


def test_a_spread_across_half_a_turn_is_not_torn():
    torn = spread(np.array([np.pi - 0.01, -np.pi + 0.01, np.pi]))
    assert torn.reach == pytest.approx(0.02)
    assert torn.deviation == pytest.approx(0.01)
    assert torn.low < 0.01 < torn.high
