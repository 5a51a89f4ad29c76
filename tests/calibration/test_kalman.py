"""Predict and correct against other ways to the same answer: Joseph, information, least squares."""

import re

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.linalg import block_diag, solve

from driftlab.calibration.covariance import _condensed_steps
from driftlab.calibration.error_dynamics import process_noise
from driftlab.calibration.error_model import FULL
from driftlab.calibration.kalman import correct, nees, predict
from driftlab.imu import ImuNoise
from support import EPS

systems = given(seed=st.integers(0, 2**32 - 1), size=st.integers(1, 30), measured=st.integers(1, 4))


def random_step(seed, size, measured, *lead, spread=1.0):
    """P, Phi, Q, z, H, R; standard deviations over 2 `spread` decades, Q as large as 0.01 P."""
    rng = np.random.default_rng(seed)
    units = 10 ** rng.uniform(-spread, spread, size)
    root, walk = rng.standard_normal((2, *lead, size, size))
    root = (root + 2 * np.eye(size)) * units[:, np.newaxis]
    walk = 0.1 * walk * units[:, np.newaxis]
    turn = np.eye(size) + 0.3 * rng.standard_normal((*lead, size, size))
    turn = units[:, np.newaxis] * turn / units
    seen = rng.standard_normal((*lead, measured, size)) / units
    error = rng.standard_normal((*lead, measured, measured)) + 2 * np.eye(measured)
    innovation = rng.standard_normal((*lead, measured))
    return root @ root.mT, turn, walk @ walk.mT, innovation, seen, error @ error.mT


def one_step(covariance, turn, noise, innovation, seen, spread):
    """Both halves of a step."""
    return correct(predict(covariance, turn, noise), innovation, seen, spread)


@systems
def test_step_is_that_of_josephs_form(seed, size, measured):
    covariance, turn, noise, innovation, seen, spread = random_step(seed, size, measured)
    predicted = predict(covariance, turn, noise)
    by_hand = turn @ covariance @ turn.T + noise
    units = np.sqrt(np.diag(by_hand))
    both = np.outer(units, units)
    # Sums of up to size^2 terms, which Cauchy bounds by size times the deviations.
    largest = np.abs(turn) @ np.abs(covariance) @ np.abs(turn.T) + np.abs(noise)
    np.testing.assert_array_less(np.abs(predicted - by_hand), 4 * size * EPS * largest)
    step = correct(predicted, innovation, seen, spread)
    expected = seen @ predicted @ seen.T + spread
    gain = solve(expected, seen @ predicted, assume_a="pos").T
    left = np.eye(size) - gain @ seen
    joseph = left @ predicted @ left.T + gain @ spread @ gain.T
    # The short form takes away up to all of a predicted variance, in some tens of operations.
    bound = 1e4 * EPS * np.linalg.cond(expected)
    np.testing.assert_allclose(step.covariance / both, joseph / both, rtol=0, atol=bound)
    size_of = np.abs(innovation).sum() / np.sqrt(np.linalg.eigvalsh(expected)[0])
    error = (step.correction - gain @ innovation) / units
    np.testing.assert_allclose(error, 0, atol=bound * (1 + size_of))
    nis = innovation @ solve(expected, innovation, assume_a="pos")
    np.testing.assert_allclose(step.nis, nis, rtol=bound)


@systems
def test_correction_adds_the_information_of_the_measurement(seed, size, measured):
    """P^-1 grows by H^T R^-1 H, and the correction is P H^T R^-1 z."""
    covariance, _, _, innovation, seen, spread = random_step(seed, size, measured, spread=0.0)
    step = correct(covariance, innovation, seen, spread)
    before = np.linalg.inv(covariance)
    told = seen.T @ np.linalg.inv(spread)
    information = before + told @ seen
    expected = np.linalg.inv(information)
    # Inverses are exact to rounding times condition; twice inverted, in units of P before.
    bound = (
        1e3 * EPS * np.linalg.cond(covariance) * np.linalg.cond(spread) * np.abs(covariance).max()
    )
    np.testing.assert_allclose(step.covariance, expected, rtol=0, atol=bound)
    size_of = np.abs(told @ innovation).sum()
    np.testing.assert_allclose(
        step.correction, expected @ told @ innovation, rtol=0, atol=bound * (1 + size_of)
    )


@systems
def test_covariance_is_symmetric_positive_and_not_larger_than_predicted(seed, size, measured):
    covariance, turn, noise, *measurement = random_step(seed, size, measured)
    predicted = predict(covariance, turn, noise)
    after = correct(predicted, *measurement).covariance
    np.testing.assert_array_equal(after, after.T)
    units = np.sqrt(np.diag(predicted))
    gone = (predicted - after) / np.outer(units, units)
    assert np.linalg.eigvalsh(after / np.outer(units, units))[0] > 0
    # As many eigenvalues as were measured are above zero; all sum up to at most `size`.
    values = np.linalg.eigvalsh((gone + gone.T) / 2)
    np.testing.assert_allclose(values[: max(size - measured, 0)], 0, atol=256 * size * EPS)
    assert values[-1] > 0


@given(seed=st.integers(0, 2**32 - 1), moving=st.integers(1, 12))
def test_states_without_rows_stay_as_they_are(seed, moving):
    covariance, turn, noise, *_ = random_step(seed, 12, 1)
    turn[moving:], noise[moving:], noise[:, moving:] = np.eye(12)[moving:], 0, 0
    whole = predict(covariance, turn, noise)
    rows = predict(covariance, turn[:moving], noise[:moving, :moving])
    np.testing.assert_allclose(rows, whole, rtol=0, atol=1e-11 * np.abs(whole).max())


@given(variance=st.floats(1e-3, 1e3), own=st.floats(1e-3, 1e3), walk=st.floats(0, 1e3))
def test_alone_a_state_is_weighed_by_its_variances(variance, own, walk):
    """With p = a^2 own + walk: p r/(p + r) is left, p/(p + r) of the innovation is believed."""
    seen, velocity = np.eye(3, 7, 3), np.array([1.0, -2.0, 3.0])
    predicted = predict(own * np.eye(7), 1.5 * np.eye(7), walk * np.eye(7))
    step = correct(predicted, velocity, seen, variance * np.eye(3))
    p = 1.5**2 * own + walk
    expected = np.full(7, p)
    expected[3:6] = p * variance / (p + variance)
    np.testing.assert_allclose(step.covariance, np.diag(expected), rtol=1e-9, atol=0)
    np.testing.assert_allclose(step.correction[3:6], velocity * p / (p + variance), rtol=1e-12)
    np.testing.assert_array_equal(step.correction[[0, 1, 2, 6]], 0)
    np.testing.assert_allclose(step.nis, 14 / (p + variance), rtol=1e-12)


@given(seed=st.integers(0, 2**32 - 1), size=st.integers(1, 12), measured=st.integers(1, 4))
def test_many_steps_are_one_least_squares_problem(seed, size, measured):
    """All states and all measurements at once: same state, same covariance, same misfit."""
    steps, rng = 9, np.random.default_rng(seed)
    covariance, *_ = random_step(rng, size, measured, spread=0.0)
    systems = [random_step(rng, size, measured, spread=0.0)[1:] for _ in range(steps)]
    state, now, misfit = np.zeros(size), covariance, 0.0
    for turn, noise, data, seen, spread in systems:
        state = turn @ state
        step = one_step(now, turn, noise, data - seen @ state, seen, spread)
        state, now, misfit = state + step.correction, step.covariance, misfit + step.nis
    # One row of unknowns: the state at first and every disturbance.
    reach = np.eye(size, size * (steps + 1))
    rows = []
    for k, (turn, _, _, seen, _) in enumerate(systems):
        reach = turn @ reach
        reach[:, size * (k + 1) : size * (k + 2)] += np.eye(size)
        rows.append(seen @ reach)
    matrix, data = np.concatenate(rows), np.concatenate([system[2] for system in systems])
    prior = block_diag(covariance, *(system[1] for system in systems))
    spreads = block_diag(*(system[4] for system in systems))
    weight = np.linalg.inv(matrix @ prior @ matrix.T + spreads)
    gain = prior @ matrix.T @ weight
    expected = reach @ (prior - gain @ matrix @ prior) @ reach.T
    # Nine transitions of norm 3 or so, and the short form in each.
    size_of = np.abs(reach @ prior @ reach.T).max()
    np.testing.assert_allclose(now, expected, rtol=0, atol=1e-9 * size_of)
    scale = np.abs(reach @ gain).max() * np.abs(data).max()
    np.testing.assert_allclose(state, reach @ gain @ data, rtol=0, atol=1e-9 * scale)
    np.testing.assert_allclose(misfit, data @ weight @ data, rtol=1e-7)


def test_nees_of_errors_drawn_from_the_covariance_is_chi_square():
    covariance, *_ = random_step(5, 6, 1)
    rng, runs = np.random.default_rng(6), 4000
    errors = rng.multivariate_normal(np.zeros(6), covariance, runs, method="cholesky")
    squares = nees(errors, covariance)
    assert squares.shape == (runs,)
    # Mean 6 and variance 12, whose own spread is (mu_4 - 12^2) = 12^2 (2 + 12/6): four deviations.
    assert abs(squares.mean() - 6) < 4 * np.sqrt(12 / runs)
    assert abs(squares.var() - 12) < 4 * np.sqrt(12**2 * 4 / runs)


def test_states_known_everywhere_do_not_count_in_nees():
    """In one run of two a state is known: there its block has no inverse, so it counts in both."""
    covariance = np.zeros((2, 4, 4))
    covariance[:, 1, 1], covariance[:, 3, 3] = [1.0, 4.0], [9.0, 16.0]
    errors = np.array([5.0, 2.0, 5.0, 12.0])
    np.testing.assert_allclose(nees(errors, covariance), [4 + 16, 1 + 9], rtol=1e-14)


MEASURED = {"observation": np.eye(2, 4), "innovation": np.ones(2), "noise": np.eye(2)}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"covariance": np.eye(4)[:3]},
            "covariance: expected shape (..., size, size), got shape (3, 4)",
        ),
        ({"transition": np.ones((5, 4))}, "transition: expected at most 4 rows, got 5"),
        ({"transition": np.eye(3)}, "transition: expected shape (..., rows, 4), got shape (3, 3)"),
        ({"noise": np.eye(4)}, "noise: expected shape (..., 2, 2), got shape (4, 4)"),
    ],
)
def test_prediction_that_does_not_fit_is_refused(changes, words):
    good = {"covariance": np.eye(4), "transition": np.eye(2, 4), "noise": np.eye(2)}
    with pytest.raises(ValueError, match=f"^{re.escape(words)}"):
        predict(**good | changes)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"innovation": np.ones(3)}, "innovation: expected shape (..., 2), got shape (3,)"),
        (
            {"observation": np.eye(3)},
            "observation: expected shape (..., rows, 4), got shape (3, 3)",
        ),
        ({"observation": np.ones(4)}, "observation: expected shape (..., rows, 4), got shape (4,)"),
        ({"noise": 0.01}, "noise: expected shape (..., 2, 2), got shape ()"),
    ],
)
def test_measurement_that_does_not_fit_is_refused(changes, words):
    with pytest.raises(ValueError, match=f"^{re.escape(words)}"):
        correct(**{"covariance": np.eye(4)} | MEASURED | changes)


def test_a_spread_that_is_singular_but_for_rounding_is_refused():
    """The second row is three times the first, and nothing is noise."""
    with pytest.raises(ValueError, match=r"^noise: expected .* spread .* without an inverse"):
        correct(np.eye(2), [1.0, 1.0], [[0.1, 0.7], [0.3, 2.1]], np.zeros((2, 2)))


def test_of_many_filters_one_without_a_spread_is_refused():
    one = np.eye(2), np.ones(1), np.array([[1.0, 0.0]]), np.array([[1.0]])
    covariance = np.stack([one[0], np.zeros((2, 2))])
    noise = np.stack([one[3], -one[3]])
    with pytest.raises(ValueError, match=r"^noise: expected an innovation with a spread"):
        correct(covariance, one[1], one[2], noise)


@pytest.mark.parametrize("lead", [(), (2,), (2, 4)], ids=str)
def test_condensed_steps_predict_and_correct_as_those_one_after_the_other(lead):
    """The velocity is seen at the end of each; one step alone, or rows of them."""
    rng, size = np.random.default_rng(7), 8
    noise = ImuNoise(1e-4, 1e-4, 2e-4)
    root = 1e-4 * rng.standard_normal((*lead, size, size))
    covariance = root @ root.mT
    steps, expected = [], covariance
    for _ in range(2):
        growth = np.broadcast_to(np.eye(size), (*lead, size, size)).copy()
        growth[..., :6, :] += 0.3 * rng.standard_normal((*lead, 6, size))
        seconds = rng.uniform(0.5, 2.0, lead)
        steps.append(_condensed_steps(FULL, growth, seconds, noise, update=3.0))
        added = np.zeros((*lead, size, size))
        added[..., :6, :6] = process_noise(noise, growth[..., 3:6, :3], seconds)
        error = 3.0 * noise.reference_velocity**2 / seconds[..., np.newaxis, np.newaxis] * np.eye(3)
        predicted = growth @ expected @ growth.mT + added
        expected = correct(predicted, np.zeros(3), np.eye(3, size, 3), error).covariance
    first, second = steps
    np.testing.assert_allclose(second.after(first.after(covariance)), expected, rtol=1e-10)
    np.testing.assert_allclose(first.then(second).after(covariance), expected, rtol=1e-10)


def test_measurement_without_any_spread_is_refused():
    with pytest.raises(
        ValueError, match=r"^noise: expected .* spread .*, got .* without an inverse"
    ):
        correct(**{"covariance": np.zeros((4, 4))} | MEASURED | {"noise": np.zeros((2, 2))})
