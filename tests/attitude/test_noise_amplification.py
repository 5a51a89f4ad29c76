"""Noise through a coning correction: against the Jacobian of the algorithm, and against draws."""

import numpy as np
import pytest
from scipy.stats import chi2

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.integration import integrate, step_rotation_vectors
from driftlab.attitude.noise_amplification import (
    correction_gains,
    noise_growth,
    step_noise_covariance,
)
from driftlab.book.ch08_attitude_from_an_imu.experiments import COMPARED
from driftlab.quaternion import conjugate, multiply, to_rotation_vector

ANGLE = 0.3  # rad a sample
EXACT_STAGE = [name for name, a in COMPARED.items() if a.last_stage == "rotation vector"]


@pytest.mark.parametrize("name", COMPARED)
def test_gains_add_up_to_nothing(name):
    """A common error of all increments leaves the correction of a steady turn at zero."""
    assert correction_gains(COMPARED[name]).sum() == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize("name", EXACT_STAGE)
def test_covariance_is_that_of_the_jacobian(name):
    algorithm = COMPARED[name]
    turn = np.array([0.2, -0.3, 0.5])
    rows = np.tile(turn, (algorithm.samples, 1))
    shifts = np.eye(rows.size).reshape(-1, *rows.shape)
    # The corrected sum is quadratic: its difference over two is linear, whatever the shift.
    jacobian = (
        step_rotation_vectors(rows + shifts, algorithm)
        - step_rotation_vectors(rows - shifts, algorithm)
    ) / 2
    columns = jacobian[:, 0]
    expected = np.einsum("ki,kj->ij", columns, columns)
    np.testing.assert_allclose(step_noise_covariance(algorithm, turn), expected, atol=1e-13)


@pytest.mark.parametrize("name", [*EXACT_STAGE, "one-step-3", "memory-4", "two-step-4"])
def test_growth_is_that_of_shifting_each_increment_by_itself(name):
    algorithm, small, count = COMPARED[name], 1e-6, 24
    past = algorithm.memory
    rows = np.tile([0.0, 0.0, ANGLE], (past + count, 1))
    shifts = np.zeros((past + count, past + count, 3))
    shifts[np.arange(past + count), np.arange(past + count), 0] = small

    def end(increments):
        history = increments[..., :past, :] if past else None
        return integrate(increments[..., past:, :], algorithm, history=history)[..., -1, :]

    ends = [end(rows + sign * shifts) for sign in (1, -1)]
    moved = to_rotation_vector(multiply(ends[0], conjugate(ends[1]))) / (2 * small)
    # Across the axis as a complex number; what is used by all steps that ever use it.
    arriving = (moved[:, 0] + 1j * moved[:, 1])[past : past + count - past]
    found = noise_growth(algorithm, ANGLE)
    # The tangent misses the exact rotation by the fourth power of a step's turn, over 384.
    last_stage = (2 * ANGLE) ** 4 / 384
    tolerance = 1e-8 if algorithm.last_stage == "rotation vector" else last_stage
    assert np.mean(np.abs(arriving) ** 2) == pytest.approx(found.white, abs=tolerance)
    steps = np.abs(np.diff(arriving[:13])) ** 2  # twelve are whole steps of one to four samples
    assert steps.mean() == pytest.approx(found.carried, abs=tolerance)


@pytest.mark.parametrize("name", ["rotation-vector-3", "four, one factor"])
def test_drawn_noise_has_the_variance_of_the_formula(name):
    algorithm, sigma, trials, steps = COMPARED[name], 1e-6, 2000, 8
    rng = np.random.default_rng(17)
    rows = np.tile([0.0, 0.0, ANGLE], (steps * algorithm.samples, 1))
    noise = sigma * rng.standard_normal((trials, *rows.shape))
    found, true = integrate(rows + noise, algorithm)[:, -1], integrate(rows, algorithm)[-1]
    error = multiply(found, conjugate(true))
    across = to_rotation_vector(error)[:, :2]
    expected = noise_growth(algorithm, ANGLE).white * len(rows) * sigma**2
    # Two components a trial, independent and of equal variance.
    low, high = chi2.ppf([1e-4, 1 - 1e-4], 2 * trials) / (2 * trials)
    assert low < np.mean(across**2) / expected < high


def test_small_turns_hardly_amplify_and_the_form_with_one_factor_does():
    angle = 0.1
    growth = {name: noise_growth(a, angle) for name, a in COMPARED.items()}
    for name in CONING_ALGORITHMS:
        assert abs(growth[name].white - 1) < 0.12 * angle**2
    assert growth["four, one factor"].white - 1 > 30 * (growth["four, spread"].white - 1)
    assert growth["four, one factor"].carried > 7 * growth["four, spread"].carried
