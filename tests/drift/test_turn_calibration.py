"""Larin, section 3: whole turns, the estimate, the weighing design, least squares."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays

from driftlab.drift.error_kinematics import error_quaternion
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import (
    TurnExperiment,
    earth_rate_offset,
    exact_turn_estimate,
    turn_estimate,
)
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns, weighing_estimate
from driftlab.quaternion import from_rotation_vector
from driftlab.triad import non_orthogonality
from support import EPS, directions, matrices, order_of

# The formula holds for any error, of which the large ones are seldom meant.
pytestmark = pytest.mark.filterwarnings("ignore:error_quaternion:driftlab.checks.UnusualWarning")

SHAPE = np.array([[0, -0.8, 0.5], [0.9, 0, 0.7], [-0.6, 0.4, 0]])
BENT = 0.01 * SHAPE
SIGMAS = non_orthogonality(BENT)[[0, 0, 1], [1, 2, 2]]

every_turn = pytest.mark.parametrize("turns", [1, 3])
four_numbers = arrays(float, 4, elements=st.floats(-1, 1))


def turn_design(axes, scale):
    """n^T Sigma n = design @ unknowns, one entry of Sigma at a time."""
    units = [np.eye(3)[[i]].T * np.eye(3)[[j]] for i, j in ((0, 1), (0, 2), (1, 2))]
    matrices = [unit + unit.T for unit in units]
    if scale == "common":
        matrices.append(np.eye(3))
    elif scale == "each":
        matrices += [np.diag(row) for row in np.eye(3)]
    return np.stack([2 * drift_coefficient(axes, matrix / 2) for matrix in matrices], axis=-1)


def random_axes(count, seed=0):
    return np.random.default_rng(seed).normal(size=(count, 3))


# The estimate (3.3)


@every_turn
@given(n=directions(), fraction=st.floats(-0.999, 0.999))
def test_3_3_recovers_a_drift_along_the_axis(turns, n, fraction):
    coefficient = fraction / (2 * turns)  # as far as the arc tangent is unique
    drift = 2 * np.pi * turns * coefficient * n / np.linalg.norm(n)
    assert turn_estimate(from_rotation_vector(drift), n, turns) == pytest.approx(
        coefficient, abs=8 * EPS
    )


@given(n=directions(), factor=st.sampled_from([-1.0, 1e-200, -3.0, 1e49]))
def test_3_3_does_not_see_sign_or_size_of_the_error(n, factor):
    error = from_rotation_vector([0.3, -0.5, 0.8])
    expected = turn_estimate(error, n)
    assert turn_estimate(factor * error, n) == pytest.approx(expected, abs=4 * EPS)
    assert turn_estimate(error, 7 * n) == pytest.approx(expected, abs=4 * EPS)


def test_3_3_in_the_papers_own_letters():
    """(k pi)^-1 arctan(l_k^T n), l_k the vector part over the scalar part."""
    error, n, k = np.array([0.1, -0.2, 0.3, 0.9]), np.array([2, 1, 2]) / 3, 2
    expected = np.arctan(error[:3] / error[3] @ n) / (k * np.pi)
    assert turn_estimate(error, n, k) == pytest.approx(expected, abs=4 * EPS)


# What the method finds without noise


@every_turn
@given(n=directions(), error_matrix=matrices(0.05))
def test_exact_estimate_is_the_kinematics_of_section_1(turns, n, error_matrix):
    n = n / np.linalg.norm(n)
    error = error_quaternion(2 * np.pi * n, n @ (np.eye(3) + error_matrix).T * 2 * np.pi, turns)
    assert exact_turn_estimate(n, error_matrix, turns) == pytest.approx(
        turn_estimate(error, n, turns), abs=16 * EPS
    )


@every_turn
def test_exact_estimate_in_the_papers_own_letters(turns):
    n = np.array([2, 1, 2]) / 3
    apparent = n + BENT @ n
    size = np.linalg.norm(apparent)
    tangent = np.tan(turns * np.pi * (size - 1))
    expected = np.arctan(apparent @ n / size * tangent) / (turns * np.pi)
    assert exact_turn_estimate(n, BENT, turns) == pytest.approx(expected, abs=4 * EPS)


@every_turn
@pytest.mark.parametrize("steps", [3, 100])
def test_exact_integration_gives_the_exact_estimate(turns, steps):
    experiment = TurnExperiment(turns, steps)
    axes = random_axes(20)
    np.testing.assert_allclose(
        experiment.estimate(axes, BENT),
        exact_turn_estimate(axes, BENT, turns),
        rtol=0,
        atol=4 * turns * steps * EPS,  # a few roundings a step
    )


@every_turn
def test_bias_of_the_method_is_of_second_order(turns):
    axes = random_axes(5)

    def bias(mu):
        return np.abs(
            exact_turn_estimate(axes, mu * SHAPE, turns) - drift_coefficient(axes, mu * SHAPE)
        ).max()

    assert order_of(bias) == pytest.approx(2, abs=0.05)


@every_turn
def test_bias_of_the_method_is_within_its_bound(turns):
    rng = np.random.default_rng(4)
    bent, n = rng.normal(size=(20000, 3, 3)), random_axes(20000)
    n /= np.linalg.norm(n, axis=1)[:, np.newaxis]
    m = 10 ** rng.uniform(-6, np.log10(0.49 / turns), len(n))
    bent *= (m / np.linalg.norm(bent, 2, axis=(1, 2)))[:, np.newaxis, np.newaxis]
    bias = np.abs(exact_turn_estimate(n, bent, turns) - drift_coefficient(n, bent))
    error = np.einsum("nij,nj->ni", bent, n)
    a = 1 + np.einsum("ni,ni->n", n, error)
    across = (np.cross(n, error) ** 2).sum(axis=1)
    d = np.sqrt(a**2 + across) - 1
    slack = 16 * EPS  # the estimate is the angle of a quaternion, known to a few roundings
    assert (bias <= across / (2 * a) * (1 + np.abs(d) / a) + slack).all()
    assert (bias <= m**2 / (2 * (1 - m) ** 2) + slack).all()
    # No smaller constant would do: an error that is all across the axis.
    small = 1e-4
    lean = [[0, 0, small], [0, 0, 0], [0, 0, 0]]
    assert exact_turn_estimate([0, 0, 1], lean, turns) > 0.999 * small**2 / 2


@given(matrices(0.1))
def test_3_4_pair_axes_show_one_sigma_each(error_matrix):
    sigma = non_orthogonality(error_matrix - np.diag(np.diag(error_matrix)))
    np.testing.assert_allclose(
        drift_coefficient(PAIR_AXES, sigma), sigma[[0, 0, 1], [1, 2, 2]], rtol=0, atol=4 * EPS
    )
    # (3.5) with an axis of length one: two thirds of the sum, where the copy has the sum.
    total = sigma[0, 1] + sigma[0, 2] + sigma[1, 2]
    assert drift_coefficient(YATES_AXES[3], sigma) == pytest.approx(2 / 3 * total, abs=4 * EPS)
    # With (1, 1, 1)/sqrt(2) in its place it is the sum.
    n4 = np.ones(3) / np.sqrt(2)
    assert n4 @ sigma @ n4 == pytest.approx(total, abs=4 * EPS)


def test_axes_are_unit_vectors():
    np.testing.assert_allclose(np.linalg.norm(YATES_AXES, axis=1), 1, rtol=2 * EPS)
    np.testing.assert_array_equal(YATES_AXES[:3], PAIR_AXES)


# The experiment


def test_noise_of_the_estimate_is_the_angle_noise_over_the_turns():
    """Noise adds up to angle_noise sqrt(k) along n, and (3.3) divides by 2 pi k."""
    noise, turns, count = 1e-4, 4, 4000
    experiment = TurnExperiment(turns, 10, angle_noise=noise)
    rng = np.random.default_rng(1)
    estimates = experiment.estimate(np.tile([1.0, 2, 2], (count, 1)), np.zeros((3, 3)), rng)
    expected = noise / (2 * np.pi * np.sqrt(turns))
    # Five standard deviations of a sample's standard deviation and of its mean.
    assert estimates.std() == pytest.approx(expected, rel=5 / np.sqrt(2 * count))
    assert estimates.mean() == pytest.approx(0, abs=5 * expected / np.sqrt(count))


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"turns": 0}, "^turns: expected a whole number of at least 1, got 0"),
        ({"steps_per_turn": 2}, "^steps_per_turn: expected a whole number of at least 3, got 2"),
        ({"step_formula": "euler"}, "^step_formula: expected one of .*, got 'euler'"),
        ({"angle_noise": -1e-9}, "^angle_noise: expected (a number of at least 0|one number)"),
        ({"angle_noise": [1e-9, 0]}, "^angle_noise: expected (a number of at least 0|one number)"),
    ],
)
def test_impossible_experiments_are_refused(settings, sentence):
    with pytest.raises(ValueError, match=sentence):
        TurnExperiment(**settings)


def test_one_error_of_half_a_turn_across_the_axis_is_refused_among_others():
    with pytest.raises(ValueError, match=r"^error_quaternion: .*, got half a turn across\.$"):
        turn_estimate([[0, 0, 0, 1], [0, 1, 0, 0]], [1, 0, 0])


# The weighing design


@given(arrays(float, 3, elements=st.floats(-1, 1)), st.floats(-1, 1))
def test_weighing_finds_the_three_and_cancels_a_common_offset(sigmas, offset):
    weighed = weighing_estimate(np.append(sigmas, sigmas.sum()) + offset)
    np.testing.assert_allclose(weighed, sigmas, rtol=0, atol=16 * EPS)


@given(four_numbers)
def test_weighing_in_the_papers_own_letters(s):
    expected = [
        (s[0] - s[1] - s[2] + s[3]) / 2,
        (-s[0] + s[1] - s[2] + s[3]) / 2,
        (-s[0] - s[1] + s[2] + s[3]) / 2,
    ]
    np.testing.assert_allclose(weighing_estimate(s), expected, rtol=0, atol=4 * EPS)


@given(four_numbers)
def test_weighing_is_least_squares_with_an_unknown_offset(estimates):
    design = np.vstack([np.eye(3), np.ones(3)])
    with_offset = np.column_stack([design, np.ones(4)])
    expected = np.linalg.lstsq(with_offset, estimates)[0][:3]
    np.testing.assert_allclose(weighing_estimate(estimates), expected, rtol=0, atol=64 * EPS)


def test_variance_factors_one_by_weighing_three_quarters_by_least_squares():
    weights = weighing_estimate(np.eye(4)).T
    np.testing.assert_array_equal(np.diag(weights @ weights.T), 1)
    inverse = np.linalg.pinv(np.vstack([np.eye(3), np.ones(3)]))
    np.testing.assert_allclose(np.diag(inverse @ inverse.T), 0.75, rtol=16 * EPS)


def test_weighing_halves_the_variance_of_three_less_an_empty_pan():
    """What Yates made it for: four weighings on a scale with an unknown offset."""
    weights = weighing_estimate(np.eye(4)).T
    less_the_empty_pan = np.hstack([np.eye(3), -np.ones((3, 1))])
    for rows in (weights, less_the_empty_pan):
        np.testing.assert_array_equal(rows.sum(axis=1), 0)  # no offset is left
    np.testing.assert_array_equal((less_the_empty_pan**2).sum(axis=1), 2 * (weights**2).sum(axis=1))
    # A turn about a body axis is an empty pan: it shows no sigma.
    np.testing.assert_allclose(drift_coefficient(np.eye(3), BENT), 0, rtol=0, atol=4 * EPS)


def test_variance_of_the_weighing_on_larins_axes():
    """With 3/2 of the fourth estimate 21/16; least squares with an offset leaves none, for 2."""
    weights = weighing_estimate(np.eye(4) * [1, 1, 1, 1.5]).T
    np.testing.assert_allclose((weights**2).sum(axis=1), 21 / 16, rtol=4 * EPS)
    variances = np.diag(fit_turns(np.zeros(4), YATES_AXES, "common").covariance)[:3]
    np.testing.assert_allclose(variances, 2, rtol=64 * EPS)  # the inverse of a 4 x 4 matrix


@given(four_numbers)
def test_weighing_refines_if_half_of_the_sum_exceeds_the_fourth_error(errors):
    change = (weighing_estimate(errors) ** 2).sum() - (errors[:3] ** 2).sum()
    assert change == pytest.approx(errors[3] ** 2 - errors.sum() ** 2 / 4, abs=16 * EPS)


def test_whole_experiment_finds_sigma_to_second_order():
    estimates = exact_turn_estimate(YATES_AXES, BENT)
    weighed = weighing_estimate(estimates * [1, 1, 1, 1.5])
    # Each estimate is |A n| - 1 but for third order: at most |M|^2/2 beside n^T Sigma n.
    bound = 0.5 * np.linalg.norm(BENT) ** 2 * (3 + 1.5) / 2
    np.testing.assert_allclose(weighed, SIGMAS, rtol=0, atol=bound)


# Least squares


@pytest.mark.parametrize("scale", ["none", "common", "each"])
@pytest.mark.parametrize("count", [6, 7, 20])
def test_fit_is_numpys_least_squares(scale, count):
    axes = random_axes(count)
    estimates = np.random.default_rng(2).normal(size=count)
    design = turn_design(axes, scale)
    expected = np.linalg.lstsq(design, estimates)[0]
    fit = fit_turns(estimates, axes, scale)
    # Errors grow with the square of the design's condition number when there is a residual.
    bound = 16 * EPS * np.linalg.cond(design) ** 2 * np.linalg.norm(estimates)
    np.testing.assert_allclose(np.append(fit.sigma, fit.scale_factor), expected, rtol=0, atol=bound)
    np.testing.assert_allclose(
        fit.covariance @ design.T @ design, np.eye(design.shape[1]), rtol=0, atol=bound
    )


def test_common_offset_on_yates_axes_is_not_the_weighing():
    """A common offset of the *estimates* is one and a half times as large in the fourth number."""
    estimates = exact_turn_estimate(YATES_AXES, BENT)
    offset = 1e-3
    shifted = fit_turns(estimates + offset, YATES_AXES, "common")
    plain = fit_turns(estimates, YATES_AXES, "common")
    np.testing.assert_allclose(shifted.sigma, plain.sigma, rtol=0, atol=32 * EPS)
    np.testing.assert_allclose(
        shifted.scale_factor - plain.scale_factor, offset, rtol=0, atol=32 * EPS
    )
    moved = weighing_estimate((estimates + offset) * [1, 1, 1, 1.5]) - weighing_estimate(
        estimates * [1, 1, 1, 1.5]
    )
    np.testing.assert_allclose(moved, offset / 4, rtol=0, atol=8 * EPS)


@pytest.mark.parametrize(
    ("axes", "scale", "unknowns", "found"),
    [
        (PAIR_AXES[:2], "none", 3, 2),
        (np.eye(3), "none", 3, 0),
        (PAIR_AXES, "common", 4, 3),
        (YATES_AXES, "each", 6, 4),
        (np.vstack([PAIR_AXES, PAIR_AXES]), "each", 6, 3),
    ],
)
def test_axes_that_do_not_determine_the_unknowns_are_refused(axes, scale, unknowns, found):
    sentence = (
        f"^axes: expected turns that determine {unknowns} unknowns, "
        f"got {len(axes)} turns that determine {found}"
    )
    with pytest.raises(ValueError, match=sentence):
        fit_turns(np.zeros(len(axes)), axes, scale)


@pytest.mark.parametrize(
    ("estimates", "axes", "scale", "sentence"),
    [
        (
            np.zeros(3),
            PAIR_AXES,
            "one",
            "^scale_factor: expected one of none, common, each, got 'one'",
        ),
        (np.zeros(3), PAIR_AXES[0], "none", r"^axes: expected shape \(m, 3\), got shape \(3,\)"),
        (np.zeros(3), np.zeros((3, 3)), "none", "^axes: expected nonzero vectors"),
    ],
)
def test_fit_refuses(estimates, axes, scale, sentence):
    with pytest.raises(ValueError, match=sentence):
        fit_turns(estimates, axes, scale)


# A real table


EIGHT, RATES = np.tile(YATES_AXES, (2, 1)), np.repeat([0.2, -0.15], 4)
BIAS, UPWARD = np.array([2e-6, -1e-6, 5e-7]), 4.7e-5


def real_estimates(axes, rates, error_matrix=BENT):
    """First order: n^T Sigma n, and what the Earth's rate and the biases add in a radian's time."""
    return drift_coefficient(axes, error_matrix) + (UPWARD + axes @ BIAS) / rates


def test_earth_offset_by_hand():
    """One turn in a sidereal day is the Earth's own; it reverses with the sense."""
    day = 2 * np.pi / 86164.1  # rad/s
    assert earth_rate_offset(np.arcsin(0.9), day) == pytest.approx(0.9, rel=1e-6)
    assert earth_rate_offset(np.pi / 6, -10 * day) == pytest.approx(-0.05, rel=1e-6)
    assert earth_rate_offset(0.7, day, [1, 0, 0]) == 0  # to the East
    assert earth_rate_offset(0.0, day, [0, 3, 0]) == pytest.approx(1, rel=1e-6)  # to the North


def test_earth_offset_takes_no_degrees_for_a_latitude():
    with pytest.raises(ValueError, match=r"^latitude: expected at most 89\.9 degrees .* 37\.5 rad"):
        earth_rate_offset(37.5, 0.1)


def test_fit_takes_off_the_known_earth_and_finds_the_biases():
    fit = fit_turns(
        real_estimates(EIGHT, RATES),
        EIGHT,
        table_rates=RATES,
        earth_rate=np.full(8, UPWARD),
        gyro_bias=True,
    )
    np.testing.assert_allclose(fit.sigma, SIGMAS, rtol=0, atol=100 * EPS)
    np.testing.assert_allclose(fit.gyro_bias, BIAS, rtol=0, atol=100 * EPS)
    assert fit.scale_factor.shape == fit.earth_rate.shape == (0,)


@given(offset=st.floats(-1e-2, 1e-2))
def test_eight_turns_determine_eight_unknowns(offset):
    fit = fit_turns(
        real_estimates(EIGHT, RATES, BENT + offset * np.eye(3)),
        EIGHT,
        "common",
        table_rates=RATES,
        earth_rate="unknown",
        gyro_bias=True,
    )
    found = np.hstack([fit.sigma, fit.scale_factor, fit.gyro_bias, fit.earth_rate])
    expected = np.hstack([SIGMAS, offset, BIAS, UPWARD])
    np.testing.assert_allclose(found, expected, rtol=0, atol=400 * EPS)
    assert fit.covariance.shape == (8, 8)


def test_residuals_are_what_the_fit_leaves_of_each_estimate():
    """The design by hand: no scale factors, no Earth, biases known to be zero."""
    noisy = real_estimates(EIGHT, RATES) + np.random.default_rng(7).normal(size=(5, 8))
    fit = fit_turns(noisy, EIGHT, table_rates=RATES, earth_rate=UPWARD)
    fitted = fit.sigma @ turn_design(EIGHT, "none").T
    np.testing.assert_allclose(fit.residuals, noisy - UPWARD / RATES - fitted, atol=100 * EPS)
    np.testing.assert_allclose(fit.residuals @ turn_design(EIGHT, "none"), 0, atol=100 * EPS)


def test_residuals_show_the_wrong_sign_of_an_axis_if_turns_are_left_over():
    axes = np.tile(np.vstack([PAIR_AXES, np.eye(3)]), (2, 1))
    rates, settings = np.repeat([0.2, -0.2], 6), {"earth_rate": "unknown", "gyro_bias": True}
    estimates = real_estimates(axes, rates)
    fit = fit_turns(estimates, axes, "each", table_rates=rates, **settings)
    assert np.abs(fit.residuals).max() < 1e-15
    sign = np.where(np.arange(12) % 6 == 5, -1.0, 1.0)  # the third body axis, both senses
    wrong = fit_turns(
        estimates, sign[:, np.newaxis] * axes, "each", table_rates=sign * rates, **settings
    )
    np.testing.assert_allclose(wrong.sigma, SIGMAS, rtol=0, atol=100 * EPS)  # no sign of the slip
    assert np.abs(wrong.residuals).max() > 0.1 * UPWARD / 0.2
    eight = np.where(np.arange(8) % 4 == 3, -1.0, 1.0)  # as many turns as unknowns
    silent = fit_turns(
        real_estimates(EIGHT, RATES), eight[:, np.newaxis] * EIGHT, "common",
        table_rates=eight * RATES, **settings,
    )  # fmt: skip
    assert np.abs(silent.residuals).max() < 1e-15


def test_for_one_rate_and_sense_the_unknown_earth_is_the_common_offset():
    rates = np.full(4, 0.3)
    estimates = real_estimates(YATES_AXES, rates)
    unknown = fit_turns(estimates, YATES_AXES, table_rates=rates, earth_rate="unknown")
    common = fit_turns(estimates, YATES_AXES, "common")
    np.testing.assert_allclose(unknown.sigma, common.sigma, rtol=0, atol=32 * EPS)
    np.testing.assert_allclose(unknown.earth_rate, 0.3 * common.scale_factor, rtol=0, atol=32 * EPS)
    with pytest.raises(ValueError, match=r"^axes: expected turns that determine 5 unknowns"):
        fit_turns(
            np.tile(estimates, 2),
            np.tile(YATES_AXES, (2, 1)),
            "common",
            table_rates=np.tile(rates, 2),
            earth_rate="unknown",
        )


def test_covariance_with_rates_is_that_of_the_design():
    design = np.column_stack([turn_design(EIGHT, "common"), EIGHT / RATES[:, None], 1 / RATES])
    fit = fit_turns(
        np.zeros(8), EIGHT, "common", table_rates=RATES, earth_rate="unknown", gyro_bias=True
    )
    normal = fit.covariance @ design.T @ design
    np.testing.assert_allclose(normal, np.eye(8), rtol=0, atol=EPS * np.linalg.cond(design) ** 2)


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"gyro_bias": True}, "^table_rates: expected a rate for each turn, got none"),
        ({"earth_rate": "unknown"}, "^table_rates: expected a rate for each turn, got none"),
        ({"earth_rate": 5e-5}, "^table_rates: expected a rate for each turn, got none"),
        ({"earth_rate": "known"}, "^earth_rate: expected rates or 'unknown', got 'known'"),
        ({"earth_rate": np.ones(3)}, r"^earth_rate: expected shape \(8,\), got shape \(3,\)"),
        ({"table_rates": np.zeros(8)}, "^table_rates: expected 8 rates that are not zero"),
        ({"table_rates": RATES * (RATES[3] != RATES)}, "^table_rates: expected 8 rates that are"),
    ],
)
def test_fit_of_a_real_table_refuses(settings, sentence):
    with pytest.raises(ValueError, match=sentence):
        fit_turns(np.zeros(8), EIGHT, **settings)


def test_one_turn_in_a_hundred_steps_is_understood():
    error = [0.1, -0.2, 0.3, 0.9]
    assert turn_estimate(error, [1, 0, 0]) == turn_estimate(error, [1, 0, 0], 1)
    assert exact_turn_estimate([1, 1, 0], BENT) == exact_turn_estimate([1, 1, 0], BENT, 1)
    assert TurnExperiment() == TurnExperiment(1, 100, "exact", 0.0)
