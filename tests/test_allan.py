"""The Allan deviation against published digits, a peer and closed forms."""

import allantools
import numpy as np
import pytest
from scipy.stats import binom, chi2

from driftlab.allan import allan_deviation
from driftlab.core.allan import covariance, degrees_of_freedom, term_variances, variances
from driftlab.noise_terms import TERMS, NoiseTerms

PURE = {name: NoiseTerms(**{name: 1.0}) for name in TERMS}
MILLION = 1e-6
"""Probability with which each bound below would be passed by chance; the seeds are fixed."""


def handbook_rates() -> np.ndarray:
    """The 1000 frequencies of NIST SP 1065, section 12.4, by their generator."""
    numbers = [1234567890]
    for _ in range(999):
        numbers.append(16807 * numbers[-1] % 2147483647)
    return np.array(numbers) / 2147483647


# The estimate


@pytest.mark.parametrize(
    ("rates", "times", "published"),
    [
        (
            [892, 809, 823, 798, 671, 644, 883, 903, 677],
            [1, 2],
            ["91.22945", "85.95287"],
        ),
        (handbook_rates(), [1, 10, 100], ["2.922319e-01", "9.159953e-02", "3.241343e-02"]),
    ],
    ids=["NBS14", "1000 points"],
)
def test_the_handbook_s_numbers_come_out_to_every_digit(rates, times, published):
    found = allan_deviation(rates, 1.0, times).deviation
    forms = [".5f" if "e" not in digits else ".6e" for digits in published]
    assert [f"{x:{form}}" for x, form in zip(found, forms, strict=True)] == published


@pytest.mark.parametrize("name", TERMS)
def test_allantools_finds_the_same(name):
    rates = PURE[name].samples(3001, 0.25, np.random.default_rng(1))
    found = allan_deviation(rates, 0.25)
    taus, theirs, *_ = allantools.oadev(
        rates, rate=4.0, data_type="freq", taus=found.averaging_times
    )
    np.testing.assert_allclose(found.averaging_times, taus, rtol=1e-12)
    np.testing.assert_allclose(found.deviation, theirs, rtol=1e-11)


@pytest.mark.parametrize("lead", [(), (3,)])
def test_blocks_of_a_long_record_add_up_to_the_definition(lead):
    rates = np.random.default_rng(9).normal(size=(*lead, 2**16 + 7))
    counts = np.array([1, 3, 2**14, 2**15 + 3])
    turned = np.concatenate([np.zeros((*lead, 1)), np.cumsum(rates, axis=-1)], axis=-1)
    for count, found in zip(counts, np.moveaxis(variances(rates, counts), -1, 0), strict=True):
        means = (turned[..., count:] - turned[..., :-count]) / count
        changes = means[..., count:] - means[..., :-count]
        np.testing.assert_allclose(found, (changes**2).mean(axis=-1) / 2, rtol=1e-11)


def test_a_long_record_far_from_zero_keeps_its_digits():
    """Half a million samples whose mean is a million times their noise."""
    rates = np.random.default_rng(3).normal(size=500_000)
    near = allan_deviation(rates, 0.01, [0.01, 1.0, 1000.0]).deviation
    far = allan_deviation(rates + 1e6, 0.01, [0.01, 1.0, 1000.0]).deviation
    # 1e6 is stored to 1e-10; errors of one size in each sample fall as white noise does.
    np.testing.assert_allclose(far, near, rtol=1e-9)


def test_default_times_are_few_and_go_to_a_quarter_of_the_record():
    found = allan_deviation(np.random.default_rng(0).normal(size=100_000), 0.01)
    assert found.averaging_times[0] == 0.01
    assert found.averaging_times[-1] == 250.0
    assert len(found.averaging_times) <= 30
    ratios = np.diff(np.log(found.averaging_times[8:]))
    np.testing.assert_allclose(ratios, ratios.mean(), rtol=0.1)


# Closed forms, and the confidence


@pytest.mark.parametrize("name", TERMS)
def test_pure_terms_have_their_lines(name):
    """Means over runs; the bound is that of their degrees of freedom."""
    runs, times = 20, np.array([1.0, 2.0, 5.0, 20.0, 100.0])
    rates = PURE[name].samples(2000, 1.0, np.random.default_rng(4), runs)
    found = allan_deviation(rates, 1.0, times)
    ratios = np.mean(found.deviation**2, axis=0) / PURE[name].deviation(times) ** 2
    freedom = covariance_freedom(name, times.astype(int), 2000)
    assert (np.abs(ratios - 1) <= 4.9 * np.sqrt(2 / (runs * freedom)) + 1e-9).all()
    np.testing.assert_allclose(PURE[name].lines(times)[name], PURE[name].deviation(times))


def covariance_freedom(name: str, counts: np.ndarray, length: int) -> np.ndarray:
    squares = np.array([float(term == name) for term in TERMS])
    variances = term_variances(1.0 * counts) @ squares
    with np.errstate(divide="ignore"):  # a ramp has no noise
        return 2 * variances**2 / np.diagonal(covariance(squares, counts, length, 1.0))


def test_lines_are_those_of_the_standard():
    times = np.array([0.5, 30.0])
    found = NoiseTerms(2.0, 3.0, 5.0, 7.0, 11.0)
    expected = [
        np.sqrt(3) * 2 / times,
        3 / np.sqrt(times),
        np.sqrt(2 * np.log(2) / np.pi) * 5 * np.ones(2),
        7 * np.sqrt(times / 3),
        11 * times / np.sqrt(2),
    ]
    for line, right in zip(found.lines(times).values(), expected, strict=True):
        np.testing.assert_allclose(line, right, rtol=1e-14)
    np.testing.assert_allclose(found.deviation(times), np.linalg.norm(expected, axis=0))


def handbook_freedom(name: str, m: np.ndarray, points: int) -> np.ndarray:
    """NIST SP 1065, Table 5, for N = `points` phases."""
    n = points
    if name == "quantisation":
        return (n + 1) * (n - 2 * m) / (2 * (n - m))
    if name == "angle_random_walk":
        return (1.5 * (n - 1) / m - 2 * (n - 2) / n) * 4 * m**2 / (4 * m**2 + 5)
    if name == "bias_instability":
        return 5 * n**2 / (4 * m * (n + 3 * m))
    return (n - 2) / m * ((n - 1) ** 2 - 3 * m * (n - 1) + 4 * m**2) / (n - 3) ** 2


@pytest.mark.parametrize("name", TERMS[:4])
def test_degrees_of_freedom_are_the_handbook_s_or_somewhat_fewer(name):
    m = np.array([2, 5, 20, 100, 500, 2000])
    ratio = covariance_freedom(name, m, 20_000) / handbook_freedom(name, m, 20_001)
    # The handbook's are approximations of their own, good to some percent.
    assert (ratio < 1.06).all()
    assert (ratio > 0.75).all()
    assert (ratio[2:5] > 0.85).all()


def test_flicker_noise_is_flat_from_the_first_averaging_time_on():
    rates = PURE["bias_instability"].samples(2**19, 1.0, np.random.default_rng(3))
    found = variances(rates, np.array([1, 2, 4]))
    # The shares by which n samples miss the variance of m, about.
    bounds = 4.9 * np.sqrt(np.array([2, 3, 5]) / 2**19)
    assert (np.abs(found / (2 * np.log(2) / np.pi) - 1) < bounds).all()


POWERS = dict(zip(TERMS, (-1.0, -0.5, 0.0, 0.5, 1.0), strict=True))
"""Rates of a term go with this power of the unit of time."""


@pytest.mark.parametrize("name", TERMS)
def test_samples_follow_the_unit_of_time(name):
    whole, part = (PURE[name].samples(9, step, np.random.default_rng(2), 3) for step in (1.0, 0.25))
    np.testing.assert_allclose(part, 0.25 ** POWERS[name] * whole, rtol=1e-13)


def test_samples_are_means_over_an_interval():
    ramp = NoiseTerms(rate_ramp=2.0).samples(3, 0.5, np.random.default_rng(1))
    np.testing.assert_array_equal(ramp, [0.5, 1.5, 2.5])
    # The mean of a walk has a third of the variance of its end.
    runs = 400_000
    walks = PURE["rate_random_walk"].samples(2, 0.5, np.random.default_rng(1), runs)
    variance = np.mean(walks**2, axis=0)
    np.testing.assert_allclose(variance, [0.5 / 3, 0.5 * 4 / 3], rtol=4.9 * np.sqrt(2 / runs))


def test_covariance_of_the_variances_does_not_depend_on_the_unit_of_time():
    counts, powers = np.array([1, 4, 16]), np.array(list(POWERS.values()))
    squares = np.array([2.0, 3.0, 5.0, 0.7, 1e-3])
    whole = covariance(squares, counts, 100, 1.0)
    part = covariance(0.25 ** (-2 * powers) * squares, counts, 100, 0.25)
    np.testing.assert_allclose(part, whole, rtol=1e-12)


@pytest.mark.parametrize("ramp", [0.0, 0.3])
def test_covariance_of_the_variances_is_that_of_many_records(ramp):
    runs, counts = 20_000, np.array([1, 2, 5])
    noise = NoiseTerms(angle_random_walk=1.0, rate_ramp=ramp)
    found = variances(noise.samples(100, 1.0, np.random.default_rng(8), runs), counts)
    expected = covariance(np.array([0.0, 1.0, 0.0, 0.0, ramp**2]), counts, 100, 1.0)
    # Frequencies are summed up, for which some percent are allowed.
    np.testing.assert_allclose(np.cov(found.T), expected, rtol=0.06)


@pytest.mark.parametrize("name", TERMS[:4])
def test_degrees_of_freedom_of_exact_variances_are_those_of_their_term(name):
    counts = np.array([1, 3, 10, 40])
    exact = term_variances(0.5 * counts)[:, TERMS.index(name)]
    squares = np.array([float(term == name) for term in TERMS])
    standard_deviations = np.sqrt(np.diagonal(covariance(squares, counts, 500, 0.5)))
    found = degrees_of_freedom(exact, counts, 500, 0.5)
    np.testing.assert_allclose(found, 2 * (exact / standard_deviations) ** 2, rtol=1e-2)


@pytest.mark.parametrize("name", ["quantisation", "angle_random_walk", "rate_random_walk"])
def test_intervals_hold_the_truth_as_often_as_they_say(name):
    runs, confidence, times = 100, 0.683, np.array([1.0, 4.0, 20.0, 100.0])
    rates = PURE[name].samples(1000, 1.0, np.random.default_rng(5), runs)
    found = allan_deviation(rates, 1.0, times, confidence=confidence)
    truth = PURE[name].deviation(times)
    held = ((found.lower < truth) & (truth < found.upper)).sum(axis=0)
    low, high = binom.ppf([MILLION / 2, 1 - MILLION / 2], runs, confidence)
    assert (low <= held).all()
    # Where the record is ten times the averaging time there are fewer degrees than the handbook's.
    assert (held <= [high, high, high, runs]).all()


@pytest.mark.parametrize("confidence", [0.5, 0.95])
def test_an_interval_leaves_the_same_chance_on_both_sides(confidence):
    found = allan_deviation(np.random.default_rng(6).normal(size=500), 1.0, confidence=confidence)
    ends = np.array([found.lower, found.upper])
    freedom = found.degrees_of_freedom
    chances = chi2.cdf(freedom * (found.deviation / ends) ** 2, freedom)
    np.testing.assert_allclose(chances[0], (1 + confidence) / 2, rtol=1e-9)
    np.testing.assert_allclose(chances[1], (1 - confidence) / 2, rtol=1e-9)


# Edges and refusals


@pytest.mark.parametrize("length", [20, 21])
def test_times_go_to_half_of_the_record(length):
    rates = np.random.default_rng(7).normal(size=length)
    found = allan_deviation(rates, 0.1, [0.1, 1.0])
    halves = [rates[i + 10 : i + 20].mean() - rates[i : i + 10].mean() for i in range(length - 19)]
    assert found.deviation[1] == pytest.approx(np.sqrt(np.mean(np.square(halves)) / 2))
    with pytest.raises(ValueError, match=r"averaging_times: .* to half of the record, 1 s"):
        allan_deviation(rates, 0.1, [0.1, 1.1])


def test_a_silent_sensor_has_no_deviation():
    found = allan_deviation(np.full(50, 0.3), 0.1)
    assert not found.deviation.any()
    assert not found.upper.any()
    counts = found.averaging_times / 0.1
    # Those of a random walk, as if the noise were too small to be seen.
    np.testing.assert_allclose(found.degrees_of_freedom, np.maximum((50 - 2 * counts) / counts, 1))
    assert allan_deviation(np.full(50, 0.3), 0.1, [2.5]).degrees_of_freedom == 1


def test_three_samples_are_enough():
    found = allan_deviation([1.0, 2.0, 4.0], 0.5)
    assert found.deviation == pytest.approx(np.sqrt(2.5 / 2))
    assert found.lower < found.deviation < found.upper


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (([1.0, 2.0], 0.1), r"samples: expected shape \(\.\.\., n\), n at least 3, got \(2,\)"),
        (([1.0, 2.0, 3.0], 0.0), r"interval: expected .* got 0"),
        (([1.0, 2.0, 3.0], 0.1, [0.2]), r"averaging_times: .* from 0\.1 s to half .* 0\.1 s"),
        (([1.0, 2.0, 3.0], 0.1, [-0.1]), r"averaging_times: expected numbers above 0, got -0\.1"),
        (([1.0, 2.0, 3.0], 0.1, [0.01]), r"averaging_times: expected shape \(k,\), from 0\.1 s"),
    ],
)
def test_bad_records_are_refused_by_name(arguments, words):
    with pytest.raises(ValueError, match=f"^{words}"):
        allan_deviation(*arguments)


@pytest.mark.parametrize("size", [1e-150, 1e-61])
def test_samples_of_a_size_that_cannot_be_are_refused(size):
    rates = np.random.default_rng(0).normal(size=(2, 100)) * [[1.0], [size]]
    with pytest.raises(ValueError, match=r"^samples: expected deviations of at least 1e-60"):
        allan_deviation(rates, 0.1)


@pytest.mark.parametrize("confidence", [0.0, 1.0, 95.0])
def test_a_confidence_is_a_probability(confidence):
    with pytest.raises(ValueError, match=r"^confidence: expected a number between 0 and 1, got"):
        allan_deviation([1.0, 2.0, 3.0], 0.1, confidence=confidence)
