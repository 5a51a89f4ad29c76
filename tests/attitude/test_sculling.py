"""Sculling: the dual of coning, exact for linear rates and forces, and a drift of known size."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import expm

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithm
from driftlab.attitude.sculling import sculling_correction, step_velocities
from driftlab.book.ch08_attitude_from_an_imu.experiments import COMPARED, SHAKER, sculling_error

WITHOUT_MEMORY = [name for name, algorithm in COMPARED.items() if not algorithm.memory]


@pytest.mark.parametrize("name", WITHOUT_MEMORY)
def test_sculling_is_the_dual_part_of_coning(name):
    """The coning correction is quadratic; put g + v for g, and take what is linear in each."""
    algorithm = COMPARED[name]
    g, v = np.random.default_rng(3).normal(size=(2, 2 * algorithm.samples, 3))

    def coning(rows):
        return sum(
            weight * np.cross(rows[i :: algorithm.samples], rows[j :: algorithm.samples])
            for (i, j), weight in algorithm.coning.items()
        )

    expected = coning(g + v) - coning(g) - coning(v)
    found = sculling_correction(g, v, algorithm)
    np.testing.assert_allclose(found, np.broadcast_to(expected, found.shape), atol=1e-14)


@pytest.mark.parametrize("name", WITHOUT_MEMORY)
def test_a_step_turns_its_velocity_evenly_and_adds_the_sculling(name):
    """As if rate and force were constant, and the sculling came evenly, too."""
    algorithm = COMPARED[name]
    g = 0.01 * np.random.default_rng(5).normal(size=(algorithm.samples, 3))
    g -= g.mean(axis=0)  # all that is left of the rotation is the coning
    v = np.random.default_rng(6).normal(size=(algorithm.samples, 3))
    p = sum(
        (weight * np.cross(g[i], g[j]) for (i, j), weight in algorithm.coning.items()), np.zeros(3)
    )
    sculling = sculling_correction(g, v, algorithm)[0]
    turning = np.zeros((4, 4))
    turning[:3, :3] = np.cross(p, np.eye(3)).T
    turning[:3, 3] = v.sum(axis=0)
    expected = expm(turning)[:3, 3] + sculling + np.cross(p, sculling) / 2
    np.testing.assert_allclose(step_velocities(g, v, algorithm)[0], expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", ["two-step-4", "four, polynomial"])
def test_sculling_is_exact_for_polynomials_of_the_samples(name):
    algorithm = COMPARED[name]
    m = algorithm.samples
    rate, force = np.random.default_rng(4).normal(size=(2, m, 3))
    powers = np.arange(1, m + 1)

    def integral(coefficients, time):
        return (coefficients.T * time**powers / powers).sum(axis=-1)

    def value(coefficients, time):
        return (coefficients.T * time ** (powers - 1)).sum(axis=-1)

    ends = np.linspace(0, 1, m + 1)
    g, v = (np.diff([integral(c, time) for time in ends], axis=0) for c in (rate, force))
    expected = [
        quad(
            lambda time, i=i: (
                (
                    np.cross(integral(rate, time), value(force, time))
                    + np.cross(integral(force, time), value(rate, time))
                )[i]
                / 2
            ),
            0,
            1,
        )[0]
        for i in range(3)
    ]
    np.testing.assert_allclose(sculling_correction(g, v, algorithm)[0], expected, atol=1e-12)


def test_mean_force_of_the_shaker_is_that_of_its_integral():
    mean = quad(lambda p: np.sin(p) * np.sin(SHAKER.swing * np.sin(p)), 0, 2 * np.pi)[0]
    assert SHAKER.mean_force == pytest.approx(SHAKER.force * mean / (2 * np.pi), rel=1e-12)


@pytest.mark.parametrize(
    ("name", "order"), [("two-step-4", 4), ("rotation-vector-3", 6), ("four, spread", 8)]
)
def test_sculling_drifts_with_the_order_of_coning(name, order):
    """To the first power of the swing, as coning to the second: the same weights vanish."""
    algorithm = COMPARED[name]
    narrow = SHAKER._replace(swing=1e-3)
    errors = [abs(sculling_error(narrow, rate, algorithm)) for rate in (30, 60)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.5)
    # Without the correction, and with that of a steady turn only, it is of second order.
    plain = Algorithm("plain", algorithm.samples, 0, {}, "rotation vector", 2)
    for turning in (False, True):
        errors = [abs(sculling_error(narrow, rate, plain, turning=turning)) for rate in (120, 240)]
        assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.1)


def test_one_sample_a_step_along_the_axis_of_the_turn_is_left_as_it_is():
    rows = np.full((4, 3), 0.01)
    np.testing.assert_allclose(step_velocities(rows, rows, "picard-1"), rows, rtol=1e-14)
    np.testing.assert_array_equal(sculling_correction(rows, rows, "picard-1"), np.zeros((4, 3)))


def test_what_cannot_be_is_refused():
    rows = np.zeros((4, 3))
    with pytest.raises(ValueError, match=r"^algorithm: expected one without memory, got memory-4"):
        step_velocities(rows, rows, "memory-4")
    with pytest.raises(ValueError, match=r"^angle: expected .* multiple of 3 for rotation-v"):
        sculling_correction(rows, rows, "rotation-vector-3")
    for name in ("picard-1", "rotation-vector-2"):
        with pytest.raises(ValueError, match=r"^angle: expected .*, n, 3\) .* got shape \(3,\)\.$"):
            sculling_correction(rows[0], rows[0], name)
    with pytest.raises(ValueError, match=r"^velocity: expected"):
        step_velocities(rows, rows[:2], CONING_ALGORITHMS["two-step-4"])
