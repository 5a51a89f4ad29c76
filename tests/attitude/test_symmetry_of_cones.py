"""A half turn about the tilt axis turns a cone's time round: no error of odd order is a drift."""

import numpy as np
import pytest

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.ch06_picard_algorithms.experiments import COMPARED, random_algorithm
from driftlab.core.attitude import step_quaternions
from driftlab.core.coning import cone_increments, step_drift
from driftlab.motion.profiles import Coning
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    to_rotation_vector,
)
from support import EPS

HALF_TURN = np.array([1.0, -1, -1])  # about the tilt axis, which is the first at phase zero
WIDE = np.radians([20.0, 60, 90, 140])


def slope(error, step):
    """Power of the step with which an error grows, from a step in rad and half of it."""
    return float(np.log2(error(step) / error(step / 2)))


def window(half_angle, x, samples, memory):
    """Increments (..., window, 3) around the step that begins at phase zero."""
    places = np.arange(samples + memory) - memory + 0.5
    x = np.asarray(x)[..., np.newaxis]
    return cone_increments(np.asarray(half_angle)[..., np.newaxis], x, x * places)


def covariant(rng, rows):
    """A rotation vector of sums, cross and dot products drawn at random; none is symmetric."""
    terms = list(np.moveaxis(rows, -2, 0))
    for _ in range(4):
        i, j, k = rng.integers(len(terms), size=3)
        square = np.sum(terms[i] * terms[j], axis=-1, keepdims=True)
        terms += [np.cross(terms[i], terms[j]), square * terms[k]]
    weights = rng.normal(size=len(terms))
    weights[: rows.shape[-2]] += 1 / rows.shape[-2]
    return sum(weight * term for weight, term in zip(weights, terms, strict=True))


@pytest.mark.parametrize("half_angle", WIDE)
def test_cone_run_backwards_is_the_cone_turned_upside_down(half_angle):
    there, back = (window(half_angle, x, 3, 2) for x in (0.4, -0.4))
    np.testing.assert_allclose(back, HALF_TURN * there, rtol=0, atol=8 * EPS)
    motion = Coning(half_angle, 1.0)
    steps = [
        to_rotation_vector(multiply(conjugate(motion.attitude(0)), motion.attitude(time)))
        for time in (0.1, -0.1)
    ]
    np.testing.assert_allclose(steps[1], HALF_TURN * steps[0], rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("seed", range(8))
def test_drift_of_any_covariant_algorithm_is_odd_in_the_angle_of_a_step(seed):
    """So it is even in the step for each second, and no odd order is among its powers."""
    rng = np.random.default_rng(seed)
    samples, memory = int(rng.integers(1, 4)), int(rng.integers(4))
    drifts = []
    for x in (0.3, -0.3):
        rows = window(WIDE, np.full(4, x), samples, memory)
        vector = 0.3 * covariant(np.random.default_rng(seed), rows)
        drifts.append(step_drift(from_rotation_vector(vector), WIDE, np.full(4, samples * x)))
    np.testing.assert_allclose(drifts[0], -drifts[1], rtol=0, atol=64 * EPS)
    assert np.all(np.abs(drifts[0]) > 1e-6)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("half_angle", WIDE)
def test_random_algorithm_of_third_order_drifts_with_the_fourth(seed, half_angle):
    algorithm = random_algorithm(np.random.default_rng(seed))
    m, motion = algorithm.samples, Coning(half_angle, 1 / (2 * np.pi))

    def drift(x):
        return abs(coning_drift(algorithm, half_angle, x / (2 * np.pi), 1.0)) / x

    def error(x):
        """What a step turns wrong, along the tilt axis and across it."""
        rows = window(half_angle, x, m, algorithm.memory)
        found = step_quaternions(algorithm.steps, rows, algorithm.memory)[0]
        true = multiply(conjugate(motion.attitude(0)), motion.attitude(m * x))
        wrong = to_rotation_vector(multiply(conjugate(true), found))
        return abs(wrong[0]), np.linalg.norm(wrong[1:])

    x = 0.1 / algorithm.window
    # The next even power is smaller by the square of the window, and by weights of a few units.
    assert slope(drift, x) == pytest.approx(4, abs=0.1)
    assert slope(lambda x: error(x)[0], x) == pytest.approx(4, abs=0.1)
    assert slope(lambda x: error(x)[1], x) == pytest.approx(5, abs=0.1)


@pytest.mark.parametrize("step_angle", [0.05, 0.3, 1.5])
@pytest.mark.parametrize("error", [1e-3, 0.1])
def test_error_along_the_tilt_axis_comes_back_by_its_square(step_angle, error):
    """An order n, of power n + 1 in a step, comes back with 2 n + 1 in a step: with order 2 n."""
    half_angle, motion = 1.0, Coning(1.0, 1.0)
    exact = multiply(conjugate(motion.attitude(0)), motion.attitude(step_angle / (2 * np.pi)))
    wrong = multiply(from_rotation_vector([error, 0, 0]), exact)
    found = step_drift(wrong, np.asarray(half_angle), np.asarray(step_angle))
    turned = 2 * np.arccos(np.cos(step_angle / 2) * np.cos(error / 2))
    assert found == pytest.approx(turned - step_angle, abs=1e-9 * error)
    # The next term is of the fourth power.
    first = error**2 / 4 / np.tan(step_angle / 2)
    assert abs(found - first) < error**4 / step_angle**3


@pytest.mark.parametrize("name", [*CONING_ALGORITHMS, "four, one factor"])
def test_no_algorithm_drifts_with_an_odd_order(name):
    algorithm = COMPARED[name]
    even = 2 * ((algorithm.order + 1) // 2)
    for half_angle in WIDE:

        def drift(x, half_angle=half_angle):
            return abs(coning_drift(algorithm, half_angle, x / (2 * np.pi), 1.0)) / x

        assert slope(drift, 0.02) == pytest.approx(even, abs=0.03)
