"""The figures of chapter 08: bandwidth, noise and more samples a step."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp
from scipy.special import factorial, factorial2
from scipy.stats import chi2

from driftlab.attitude.coning_algorithms import Algorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.ch07_coning.experiments import BRACKET
from driftlab.book.ch08_attitude_from_an_imu.experiments import (
    ANGLE_RANDOM_WALK,
    COMPARED,
    FLOOR_RATES,
    FLOOR_SECONDS,
    QUANTUM,
    SAMPLES_A_ROUND,
    carried_floor,
    missed_part,
    weights_by_distance,
    weights_of_polynomial,
)
from driftlab.book.machinery.figure.publish import PublishedFigure
from published import published
from support import EPS


def drift_in_a_sample(algorithm: Algorithm, half_angle: mp.mpf, x: mp.mpf) -> mp.mpf:
    """Of a step on a cone that goes round by x between two samples, in many digits."""
    phases = [i * x for i in range(algorithm.samples + 1)]
    sine, back = mp.sin(half_angle), mp.cos(half_angle) - 1
    increments = [
        (sine * (mp.cos(q) - mp.cos(p)), sine * (mp.sin(q) - mp.sin(p)), back * x)
        for p, q in pairwise(phases)
    ]
    f = [mp.fsum(component) for component in zip(*increments, strict=True)]
    for (i, j), weight in algorithm.coning.items():
        exact = Fraction(weight).limit_denominator(10_000)
        (a, b, c), (u, v, w) = increments[i], increments[j]
        cross = (b * w - c * v, c * u - a * w, a * v - b * u)
        parts = exact.numerator, exact.denominator
        f = [one + other * parts[0] / parts[1] for one, other in zip(f, cross, strict=True)]
    size, turn = mp.sqrt(mp.fsum(one**2 for one in f)), algorithm.samples * x
    along = mp.sin(size / 2) * f[2] / size
    scalar = mp.cos(size / 2) * mp.cos(turn / 2) - along * mp.sin(turn / 2)
    return (2 * mp.acos(scalar) - turn) / algorithm.samples


@pytest.mark.parametrize("degrees", [1, 5, 20, 60])
def test_first_terms_of_the_drift_of_three_and_of_four_samples(degrees: int) -> None:
    """From the series of a step in x, with u = 1 - cos a; the next term is the ninth power."""
    with mp.workdps(50):
        u = 1 - mp.cos(mp.radians(degrees))
        seventh = {
            "rotation-vector-3": (u / 80, (48 + 5996 * u - 2070 * u**2) / 13440, 0.6),
            "four, spread": (u / 70, (9341 * u - 3144 * u**2) / 3780, 3.3),
        }
        for name, (first, second, ninth) in seventh.items():
            for x in mp.mpf("0.02"), mp.mpf("0.05"):
                drift = drift_in_a_sample(COMPARED[name], mp.radians(degrees), x)
                rest = drift / (u * (2 - u)) - first * x**5 + second * x**7
                # The ninth power has at most 0.6 u or 3.3 u, and 1/1260 on a narrow cone.
                assert abs(rest) < (ninth * u + 0.001) * x**9, name
                around = float(x / (2 * mp.pi))
                by_one_step = around * coning_drift(COMPARED[name], np.radians(degrees), 1, around)
                assert by_one_step == pytest.approx(float(drift), rel=1e-9, abs=EPS)


@pytest.mark.parametrize("around", [8, 10, 15, 20, 30])
def test_four_samples_beat_three_on_narrow_cones_only(around: int) -> None:
    half_angles = np.radians([0.1, 1, 2, 3, *np.arange(10.0, 180.0)])
    three, four = (
        np.abs(coning_drift(COMPARED[name], half_angles, 1.0, 1 / around))
        for name in ("rotation-vector-3", "four, spread")
    )
    np.testing.assert_array_equal(four < three, half_angles < np.radians(4))


@published("08-noise-and-band")
def test_band_and_floors_are_those_of_the_text(figure: PublishedFigure) -> None:
    table = figure.data
    often = SAMPLES_A_ROUND > 30
    x = 2 * np.pi / SAMPLES_A_ROUND[often]
    # The first term of the series, Ignagni's; the next is smaller by the square of a step.
    for name, first in (
        ("picard-1", x**2 / 6),
        ("two-step-4", x**4 / 30),
        ("rotation-vector-3", x**6 / 140),
    ):
        np.testing.assert_allclose(table.missed[name][often], first, rtol=0.06)
    for i, rate in enumerate(FLOOR_RATES):
        for name, found in table.drift_at_rates.items():
            drift = coning_drift(COMPARED[name], BRACKET.half_angle, BRACKET.frequency, 1 / rate)
            assert found[i] == pytest.approx(abs(drift), rel=1e-9)
    # Of 12 runs with two components each a root mean square is good to a factor of two and a half
    # (a chi-squared of 12 degrees, one in ten thousand on either side).
    low, high = np.sqrt(chi2.ppf([1e-4, 1 - 1e-4], 12) / 12)
    carried = table.rounding_carried
    ratio = FLOOR_SECONDS * carried / carried_floor(FLOOR_RATES, QUANTUM)
    assert np.all((low < ratio) & (ratio < high)), ratio
    noise = ANGLE_RANDOM_WALK / np.sqrt(FLOOR_SECONDS)
    assert np.all(carried < 5 * noise)
    assert np.all(carried > noise / 5)
    fast = FLOOR_RATES >= 50
    assert np.all(table.rounding_lost[fast] > table.drift_at_rates["two-step-4"][fast])


def test_missed_part_is_the_drift_on_a_narrow_cone() -> None:
    samples, half_angle = np.array([1.3, 2.5, 7.0, 20]), 1e-3
    for algorithm in COMPARED.values():
        drift = coning_drift(algorithm, half_angle, 1.0, 1 / samples)
        expected = drift / (np.pi * half_angle**2)
        # Left out is the square of the half angle, in steps of up to three turns.
        np.testing.assert_allclose(missed_part(algorithm, samples), expected, atol=1e-3)


@pytest.mark.parametrize("samples", [2, 3, 4, 5, 6])
def test_weights_for_a_cone_leave_ignagnis_first_term(samples: int) -> None:
    """m!/(2^(m+1) (2m+1)!!) of the angle between two samples, to the power 2m + 1."""
    totals = weights_by_distance(samples)
    published = {3: [27 / 20, 9 / 20], 4: [214 / 105, 92 / 105, 54 / 105]}
    if samples in published:
        np.testing.assert_allclose(totals, published[samples], rtol=1e-13)
    weights = {(samples - 1 - d, samples - 1): w for d, w in enumerate(totals, start=1)}
    algorithm = Algorithm("m", samples, 0, weights, "rotation vector", 2)
    x = 0.9 / samples
    first = factorial(samples) / (2.0**samples * factorial2(2 * samples + 1)) * x ** (2 * samples)
    assert -missed_part(algorithm, np.array(2 * np.pi / x)) == pytest.approx(first, rel=0.1)


@pytest.mark.parametrize("samples", [2, 3, 4])
def test_weights_of_a_polynomial_are_exact_for_it(samples: int) -> None:
    """Half the integral of the angle times the rate, by a Gauss rule that is exact for it."""
    coefficients = np.random.default_rng(samples).normal(size=(3, samples))
    rate = [np.polynomial.Polynomial(row) for row in coefficients]
    nodes, gauss = np.polynomial.legendre.leggauss(samples + 1)
    times = (nodes + 1) / 2
    turned = np.array([one.integ()(times) for one in rate]).T
    rates = np.array([one(times) for one in rate]).T
    expected = (gauss[:, np.newaxis] / 2 * np.cross(turned, rates)).sum(axis=0) / 2
    ends = np.linspace(0, 1, samples + 1)
    rows = np.diff([one.integ()(ends) for one in rate]).T
    weights = weights_of_polynomial(samples)
    found = sum(weight * np.cross(rows[i], rows[j]) for (i, j), weight in weights.items())
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-13)


def test_leading_term_is_too_large_where_samples_are_few() -> None:
    """A cone of 20 Hz sampled at 100 Hz: half of it and less is what more samples bring."""
    x = 2 * np.pi * 20 / 100
    ratios = []
    for m in (2, 3, 4, 5, 6):
        weights = {(m - 1 - d, m - 1): w for d, w in enumerate(weights_by_distance(m), start=1)}
        algorithm = Algorithm("m", m, 0, weights, "rotation vector", 2)
        first = factorial(m) / (2.0**m * factorial2(2 * m + 1)) * x ** (2 * m)
        ratios.append(-float(missed_part(algorithm, np.array(5.0))) / first)
    np.testing.assert_allclose(ratios, [0.83, 0.74, 0.65, 0.57, 0.50], atol=0.006)


@published("08-between-samples")
def test_guesses_between_samples_have_their_orders(figure: PublishedFigure) -> None:
    table = figure.data
    often = table.samples_a_round > 12
    for name, order in (
        ("rectangle", 1), ("trapezoid", 2), ("spline of degree 3", 4), ("spline of degree 5", 6)
    ):  # fmt: skip
        slope = np.polyfit(
            np.log(table.samples_a_round[often]), np.log(table.error[name][often]), 1
        )
        assert -slope[0] == pytest.approx(order, abs=0.25), name
    few = table.samples_a_round < 2.5
    assert all(error[few].min() > 0.05 for error in table.error.values())
    on_samples = np.searchsorted(table.moment, table.sampled_at[1:-1])
    spline = table.guess["spline of degree 5"][on_samples]
    np.testing.assert_allclose(spline, table.sampled[1:-1], rtol=0, atol=0.02)


@published("08-pseudo-coning")
def test_a_late_gyro_makes_the_drift_of_its_ellipse(figure: PublishedFigure) -> None:
    table, area = figure.data, np.pi * figure.data.swing * np.ptp(figure.data.across) / 2
    at = np.argmin(np.abs(table.delay - table.late))
    assert table.delay[at] == pytest.approx(table.late, rel=0.02)
    assert table.ellipse[at] == pytest.approx(area * table.frequency, rel=0.02)
    pairs, plain = table.drift["two-step-4"], table.drift["picard-1"]
    assert np.all(plain < pairs)
    assert np.all(pairs < table.ellipse)
    x = 2 * np.pi * table.frequency / table.sample_rate
    # A polygon on a circle: the plain product encloses sin(x)/x of the area.
    np.testing.assert_allclose(plain[:30] / table.ellipse[:30], np.sin(x) / x, rtol=0.01)


@published("08-more-samples")
def test_borders_of_the_fourth_sample(figure: PublishedFigure) -> None:
    table = figure.data
    borders = {}
    for each, gain in table.gain.items():
        assert gain[0] > 1 > gain[-1]
        borders[each] = np.degrees(table.half_angle[np.flatnonzero(gain > 1)[-1]])
    assert borders["5"] == pytest.approx(8.5, abs=0.3)
    assert borders["8"] == pytest.approx(4.75, abs=0.25)
    assert borders["20"] == pytest.approx(3.5, abs=0.2)


@published("08-sculling")
def test_swing_and_force_in_step_make_a_velocity(figure: PublishedFigure) -> None:
    table = figure.data
    whole = slice(None, None, 200)
    np.testing.assert_allclose(table.velocity[whole], table.mean[whole], rtol=1e-6, atol=1e-9)
    assert abs(np.mean(table.felt[:-1])) < 1e-12
