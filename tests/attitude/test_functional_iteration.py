"""Functional iteration: exact on polynomials, its order, how it settles, its drift, a peer."""

from math import factorial

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import solve_ivp

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, checked_algorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.functional_iteration import WIDEST, FunctionalIteration
from driftlab.attitude.integration import integrate, step_quaternions, step_rotation_vectors
from driftlab.core.functional_iteration import tables
from driftlab.motion.profiles import Coning, Sway
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    pure,
    rotate,
    rotation_angle,
    to_rotation_vector,
)
from support import EPS, IDENTITY, quaternions, random_quaternions

NAME = "functional-iteration"
WINDOW = checked_algorithm(NAME).window
SWAY = Sway(0.5, 0.5)
every_window = pytest.mark.parametrize("window", [1, 2, 3, 5, 8, 12])


def of(window, iterations=None):
    return FunctionalIteration(f"window of {window}", window, iterations)


def errors(motion, algorithm, interval, count):
    found = integrate(motion.increments(interval, count), algorithm, start=motion.attitude(0))
    exact = motion.attitude(interval * np.arange(1, count + 1))
    return rotation_angle(multiply(conjugate(exact), found))


# The polynomial


@every_window
def test_fitted_rate_has_the_increments_and_is_exact_for_polynomials(window):
    table, power = tables(window), window - 1
    nodes, _ = np.polynomial.legendre.leggauss(len(table.rate))
    edges = np.linspace(-1, 1, window + 1)
    # Monomials up to x^(N-1), one after the other; the integrals grow by rounding as the fit does.
    bound = 64 * EPS * np.abs(table.rate).sum(axis=1).max()
    for p in range(power + 1):
        increments = np.diff(edges ** (p + 1)) / (p + 1)
        rate = table.rate @ increments
        np.testing.assert_allclose(rate, nodes**p, rtol=0, atol=bound)
        np.testing.assert_allclose(table.over @ rate, increments, rtol=0, atol=bound)
        until = (nodes ** (p + 1) - (-1.0) ** (p + 1)) / (p + 1)
        np.testing.assert_allclose(table.until @ rate, until, rtol=0, atol=bound)


@every_window
@pytest.mark.parametrize("seed", range(3))
def test_polynomial_rates_leave_rounding_after_every_sample(window, seed):
    """Against Taylor's series of the quaternion equation, of a rate that bends as it can.

    At the end of the window Gauss's rule is exact to rounding, inside to twelve digits.
    """
    rate = np.random.default_rng(seed).uniform(-1, 1, (window, 3))
    terms = [IDENTITY]
    for n in range(120):
        products = [multiply(terms[n - i], pure(rate[i])) for i in range(min(n + 1, window))]
        terms.append(sum(products) / (2 * (n + 1)))
    edges, powers = np.arange(window + 1) / window, np.arange(1, window + 1)
    increments = np.diff(edges[:, np.newaxis] ** powers @ (rate / powers[:, np.newaxis]), axis=0)
    exact = np.polynomial.polynomial.polyval(edges[1:], np.array(terms)).T
    found = integrate(increments, of(window))
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-11)
    bound = EPS * np.abs(tables(window).rate).sum(axis=1).max() + 8 * EPS
    np.testing.assert_allclose(found[-1], exact[-1], rtol=0, atol=bound)


def test_window_of_one_is_one_turn_after_the_other():
    rows = np.random.default_rng(0).uniform(-0.5, 0.5, (5, 3))
    found = step_quaternions(rows, of(1))
    np.testing.assert_allclose(found, from_rotation_vector(rows), rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("turn", [1e-8, 1.0, 6.0, 12.0])
def test_two_whole_turns_in_a_window_are_no_harm(turn):
    axis = np.array([0.6, 0, 0.8])
    rows = np.tile(turn / WINDOW * axis, (WINDOW, 1))
    expected = from_rotation_vector(np.outer(turn / WINDOW * np.arange(1, WINDOW + 1), axis))
    # Twelve steps, which turn by two turns, by tables of numbers that are sums of twelve.
    np.testing.assert_allclose(integrate(rows, NAME), expected, rtol=0, atol=WINDOW**2 * EPS)


def test_small_steps_keep_their_digits():
    """A step of 1e-9 rad to twelve digits, though the quaternion's scalar part is 1."""
    rows = 1e-9 * np.outer(np.linspace(1, 2, WINDOW), [1.0, -2.0, 0.5])
    np.testing.assert_allclose(-4 * step_rotation_vectors(rows, NAME), rows, rtol=1e-12)


# How it settles, and its order


@pytest.mark.parametrize("iterations", [1, 2, 3, 5, 8])
@pytest.mark.parametrize("turn", [0.2, 1.0, 2.0])
def test_iterate_is_the_exponential_cut_off(iterations, turn):
    """At a constant rate Picard's iterate j is the series of the quaternion up to the power j."""
    series = sum((0.5j * turn) ** i / factorial(i) for i in range(iterations + 1))
    found = integrate([[0, 0, turn]], of(1, iterations))[0]
    assert found == pytest.approx([0, 0, *(np.array([series.imag, series.real]) / abs(series))])
    error = abs(series - np.exp(0.5j * turn))
    assert error < (turn / 2) ** (iterations + 1) / factorial(iterations + 1)


@pytest.mark.parametrize(("window", "order"), [(1, 2), (2, 4), (3, 4), (4, 6), (5, 6), (6, 8)])
def test_order_is_that_of_the_window(window, order):
    """After every sample, not at the ends of windows only: errors from 1e-4 to 1e-12."""
    assert of(window).order == order
    counts = 60 * 2 ** np.arange(4 if order < 8 else 3)
    sizes = [errors(SWAY, of(window), 4 / count, count).max() for count in counts]
    slope = -np.polyfit(np.log(counts), np.log(sizes), 1)[0]
    assert slope == pytest.approx(order, abs=0.25)


def test_window_of_two_has_the_cone_of_the_pair_and_three_that_of_a_quadratic_rate():
    """On a narrow cone, where the drift is that of the correction to the second power."""
    weights = {(0, 1): 27 / 40, (1, 2): 27 / 40, (0, 2): 9 / 20}
    assert dict(CONING_ALGORITHMS["rotation-vector-3"].coning) == weights
    for window, other in ((2, "two-step-4"), (2, "rotation-vector-2")):
        found = coning_drift(of(window), 1e-3, 1.0, 1 / 24)
        assert found == pytest.approx(float(coning_drift(other, 1e-3, 1.0, 1 / 24)), rel=1e-4)
    # Miller's weights are for a cone, not for a polynomial.
    three, miller = (coning_drift(a, 1e-3, 1.0, 1 / 24) for a in (of(3), "rotation-vector-3"))
    assert abs(three) > 5 * abs(miller)


def test_agrees_with_a_precise_integration_of_any_smooth_rate():
    def rate(time):
        return np.array([
            np.sin(3 * time) + 0.5, np.exp(-time) * np.cos(5 * time), 0.3 * time - 1
        ])  # fmt: skip

    nodes, weights = np.polynomial.legendre.leggauss(12)
    count, interval = 240, 1 / 120
    middle = interval * (np.arange(count) + 0.5)[:, np.newaxis]
    rows = (rate(middle + interval / 2 * nodes) * weights).sum(axis=-1).T * interval / 2
    exact = solve_ivp(
        lambda time, q: multiply(q, pure(rate(time) / 2)), (0, 2), IDENTITY,
        method="DOP853", rtol=1e-13, atol=1e-14,
    ).y[:, -1]  # fmt: skip
    assert rotation_angle(multiply(conjugate(exact), integrate(rows, NAME)[-1])) < 1e-12


# Drift


def test_drift_on_the_wide_cone():
    """10° at 5 Hz, sampled at 100 Hz, in degrees per hour."""

    def drift(algorithm):
        return 3600 * np.degrees(abs(coning_drift(algorithm, np.radians(10), 5.0, 0.01)))

    assert drift(NAME) == pytest.approx(4e-5, rel=0.1)
    assert drift(of(8)) < 1e-2
    assert min(drift(name) for name in CONING_ALGORITHMS) == pytest.approx(1.5, rel=0.02)


@pytest.mark.parametrize("degrees", [1.0, 20.0, 60.0])
@pytest.mark.parametrize(("window", "count"), [(3, 12), (4, 12), (8, 16), (12, 12)])
def test_one_window_tells_the_drift_of_many(window, count, degrees):
    motion = Coning(np.radians(degrees), 1.0)
    rows = motion.increments(1 / count, 12 * count)
    end = integrate(rows, of(window), start=motion.attitude(0))[-1]
    error = to_rotation_vector(multiply(end, conjugate(motion.attitude(0))))
    found = np.copysign(np.linalg.norm(error), error[2]) / 12
    expected = coning_drift(of(window), motion.half_angle, 1.0, 1 / count)
    assert found == pytest.approx(float(expected), rel=1e-8, abs=12 * count * 16 * EPS)


def test_too_few_samples_in_a_round_leave_nothing_to_gain():
    """At two and a half samples a round a wide window does worse than the pair, or refuses."""
    pair, wide = (abs(coning_drift(a, 0.02, 20.0, 1 / 50)) for a in ("two-step-4", of(10)))
    assert wide > pair
    with pytest.raises(ValueError, match=r"^increments: expected angles that a polynomial fits"):
        coning_drift(of(WIDEST), 0.02, 20.0, 1 / 50)


@pytest.mark.parametrize("degrees", [1.0, 10.0, 60.0])
@pytest.mark.parametrize(("window", "fewest"), [(6, 4), (12, 5)])
def test_window_leaves_less_than_the_best_of_the_seven_from_some_samples_a_round(
    window, fewest, degrees
):
    cone, interval = np.radians(degrees), 1 / np.linspace(fewest, 30, 100)
    seven = [abs(coning_drift(name, cone, 1.0, interval)) for name in CONING_ALGORITHMS]
    assert (abs(coning_drift(of(window), cone, 1.0, interval)) < np.min(seven, axis=0) / 1.2).all()


@pytest.mark.parametrize("degrees", [1.0, 10.0, 30.0])
def test_window_of_six_loses_below_four_samples_a_round(degrees):
    cone, interval = np.radians(degrees), 1 / np.linspace(2.5, 3.9, 30)
    seven = [abs(coning_drift(name, cone, 1.0, interval)) for name in CONING_ALGORITHMS]
    assert (abs(coning_drift(of(6), cone, 1.0, interval)) > np.min(seven, axis=0)).all()


# Symmetries


@settings(max_examples=20)
@given(turn=quaternions(), seed=st.integers(0, 100))
def test_turned_inputs_give_turned_rotations(turn, seed):
    rows = 0.2 * np.cumsum(np.random.default_rng(seed).uniform(-0.1, 0.1, (12, 3)), axis=0)
    found = step_rotation_vectors(rotate(turn, rows), NAME)
    bound = 16 * EPS * np.abs(tables(WINDOW).rate).sum(axis=1).max()
    np.testing.assert_allclose(
        found, rotate(turn, step_rotation_vectors(rows, NAME)), rtol=0, atol=bound
    )


def test_the_way_back_is_the_inverse():
    rows = SWAY.increments(0.01, 36)
    there, back = integrate(rows, NAME)[-1], integrate(-rows[::-1], NAME)[-1]
    np.testing.assert_allclose(multiply(there, back), IDENTITY, rtol=0, atol=36 * 16 * EPS)


# Rows, windows and leading axes


def test_pieces_of_whole_windows_are_the_same_as_all_at_once():
    rows, start = SWAY.increments(0.01, 60), random_quaternions(1)[0]
    parts, attitude = [], start
    for first, last in ((0, 12), (12, 48), (48, 60)):
        parts.append(integrate(rows[first:last], NAME, start=attitude))
        attitude = parts[-1][-1]
    expected = integrate(rows, NAME, start=start)
    np.testing.assert_allclose(np.concatenate(parts), expected, rtol=0, atol=60 * 16 * EPS)


@pytest.mark.parametrize("count", [12, 13, 23, 24, 25])
def test_last_window_is_moved_back_until_it_is_full(count):
    rows = SWAY.increments(0.02, count)
    found = step_quaternions(rows, NAME)
    whole = count - count % WINDOW
    assert found.shape == (count, 4)
    np.testing.assert_allclose(
        found[:whole], step_quaternions(rows[:whole], NAME), rtol=0, atol=16 * EPS
    )
    last = step_quaternions(rows[-WINDOW:], NAME)
    np.testing.assert_allclose(found[whole:], last[WINDOW - count % WINDOW :][: count - whole],
                               rtol=0, atol=16 * EPS)  # fmt: skip
    # An odd number of rows costs no order.
    assert errors(SWAY, NAME, 0.02, count).max() < 1e-12


def test_many_windows_go_in_blocks():
    rows = SWAY.increments(0.01, 12 * 1300)
    found = step_rotation_vectors(rows, NAME)
    for i in (0, 511, 512, 1299):
        alone = step_rotation_vectors(rows[12 * i : 12 * i + 12], NAME)
        np.testing.assert_allclose(found[12 * i : 12 * i + 12], alone, rtol=0, atol=8 * EPS)


# Refusals


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"window": 0}, "window: expected a whole number of at least 1, got 0"),
        ({"window": 21}, "window: expected at most 20 increments, got 21"),
        ({"iterations": 0}, "iterations: expected a whole number of at least 1, got 0"),
    ],
)
def test_windows_and_iterations_that_cannot_be_are_refused(arguments, words):
    with pytest.raises(ValueError, match=rf"^{words}\.$"):
        FunctionalIteration("own", **arguments)


@pytest.mark.parametrize("function", [integrate, step_quaternions, step_rotation_vectors])
def test_fewer_than_a_window_are_refused(function):
    words = r"^increments: expected at least 12 for functional-iteration, got 11\.$"
    with pytest.raises(ValueError, match=words):
        function(np.zeros((11, 3)), NAME)


def test_what_no_polynomial_fits_is_refused():
    """Increments that jump to and fro: the polynomial swings to many turns between them."""
    rows = 0.5 * (-1.0) ** np.arange(12)[:, np.newaxis] * np.array([0, 0, 1])
    words = (
        r"^increments: expected angles that a polynomial fits, turning by some 20 rad a window or "
        r"less, got a fit that turns as fast as \d\S* rad a window\.$"
    )
    with pytest.raises(ValueError, match=words):
        integrate(rows, NAME)
    assert np.isfinite(integrate(rows, "two-step-4")).all()
