"""A half turn about the tilt axis turns a cone's time round: the drift has even orders only.

The step must turn with the increments and be a power series in them. A length to an odd power is
none, and drifts with an odd order.
"""

from functools import partial

import numpy as np
import pytest

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.integration import integrate
from driftlab.book.ch07_coning.experiments import SHIP, random_algorithm
from driftlab.book.ch08_attitude_from_an_imu.experiments import COMPARED
from driftlab.core.attitude import step_quaternions
from driftlab.core.coning import cone_increments, step_drift
from driftlab.motion.profiles import Coning
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotation_angle,
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


def covariant(rng, rows, *, lengths):
    """A rotation vector of sums, cross and dot products, and lengths, drawn at random."""
    terms = list(np.moveaxis(rows, -2, 0))
    for _ in range(4):
        i, j, k = rng.integers(len(terms), size=3)
        square = np.sum(terms[i] * terms[j], axis=-1, keepdims=True)
        factor = np.sqrt(np.abs(square)) if lengths else square
        terms += [np.cross(terms[i], terms[j]), factor * terms[k]]
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


@pytest.mark.parametrize("lengths", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_drift_of_any_covariant_algorithm_is_odd_in_the_angle_of_a_step(seed, lengths):
    """If it is a power series too, it has odd powers only: even ones for each second."""
    rng = np.random.default_rng(seed)
    samples, memory = int(rng.integers(1, 4)), int(rng.integers(4))
    drifts = []
    for x in (0.3, -0.3):
        rows = window(WIDE, np.full(4, x), samples, memory)
        vector = 0.3 * covariant(np.random.default_rng(seed), rows, lengths=lengths)
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


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("half_angle", WIDE)
def test_random_algorithm_with_the_cube_of_a_length_drifts_with_the_third(seed, half_angle):
    algorithm = random_algorithm(np.random.default_rng(seed))

    def drift(x):
        rows = window(half_angle, x, algorithm.samples, algorithm.memory)
        vector = to_rotation_vector(step_quaternions(algorithm.steps, rows, algorithm.memory)[0])
        vector *= 1 + 10 * np.linalg.norm(vector) ** 3
        turned = from_rotation_vector(vector)
        return (
            abs(step_drift(turned, np.asarray(half_angle), np.asarray(algorithm.samples * x))) / x
        )

    assert slope(drift, 0.015 / algorithm.window) == pytest.approx(3, abs=0.1)


def stretched(increments):
    f = increments[0::2] + increments[1::2]
    f = f + 2 / 3 * np.cross(increments[0::2], increments[1::2])
    return f * (1 + np.linalg.norm(f, axis=-1, keepdims=True) ** 3 / 2)


def weighed(increments):
    f = increments[0::2] + increments[1::2]
    weight = 2 / 3 + 0.3 * np.linalg.norm(f, axis=-1, keepdims=True)
    return f + weight * np.cross(increments[0::2], increments[1::2])


@pytest.mark.parametrize("own", [stretched, weighed])
def test_odd_power_of_a_length_is_of_third_order_and_drifts_with_the_third_power(own):
    def drift(x):
        return np.abs(coning_drift(own, WIDE[:3], 1.0, x / (2 * np.pi)))

    np.testing.assert_allclose(np.log2(drift(0.03) / drift(0.015)), 3, rtol=0, atol=0.02)

    def error(step):
        ends = step * np.arange(1, round(2 / step) + 1)
        found = integrate(SHIP.increments(step / 2, 2 * len(ends)), own, start=SHIP.attitude(0))
        return rotation_angle(multiply(conjugate(SHIP.attitude(ends)), found)).max()

    assert slope(error, 2 / 512) == pytest.approx(3, abs=0.05)


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


def test_an_error_of_odd_order_drifts_through_its_square() -> None:
    """Two turns make one by too much, e^2/2X, where e is of the fourth power of the step."""

    def with_error(size: float, g: np.ndarray) -> np.ndarray:
        first, second = g[0::2], g[1::2]
        square = (first**2).sum(axis=-1, keepdims=True)
        return first + second + 2 / 3 * np.cross(first, second) + size * square * (second - first)

    half_angle, around = np.radians(60.0), np.array([24, 48, 96])
    drift, without = (
        np.array([coning_drift(partial(with_error, size), half_angle, 1.0, 1 / n) for n in around])
        for size in (3.0, 0.0)
    )
    assert abs(drift[0]) > 5 * abs(without[0])
    np.testing.assert_allclose(np.log2((drift - without)[:-1] / (drift - without)[1:]), 6, atol=0.1)
    x = 2 * np.pi / around
    # The first increment is 2 sin(a/2) x long; the two differ by x^2 sin(a), along the tilt axis.
    error = 3 * (2 * np.sin(half_angle / 2) * x) ** 2 * np.sin(half_angle) * x**2
    np.testing.assert_allclose(drift - without, error**2 / (2 * (2 * x)) * around / 2, rtol=0.2)
