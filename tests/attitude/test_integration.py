"""The attitude algorithms: their formulas, their orders, how they start, and their coning drift."""

import warnings
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays

from driftlab.attitude.cayley import rotation_quaternion
from driftlab.attitude.coning_algorithms import (
    ALGORITHMS,
    CONING_ALGORITHMS,
    Algorithm,
    checked_algorithm,
)
from driftlab.attitude.integration import integrate, step_quaternions, step_rotation_vectors
from driftlab.checks import UnusualWarning
from driftlab.motion.profiles import Coning, FixedAxis, Sway
from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    multiply,
    pure,
    rotation_angle,
    to_rotation_vector,
)
from support import EPS, IDENTITY, order_of, random_quaternions

MEMORY = ["one-step-3", "memory-4"]
ROTATION_VECTOR = ["rotation-vector-2", "rotation-vector-3"]
CAYLEY = [name for name in CONING_ALGORITHMS if name not in ROTATION_VECTOR]

every_algorithm = pytest.mark.parametrize("name", CONING_ALGORITHMS)
with_memory = pytest.mark.parametrize("name", MEMORY)
with_rotation_vector = pytest.mark.parametrize("name", ROTATION_VECTOR)
with_cayley = pytest.mark.parametrize("name", CAYLEY)

rows_of_increments = arrays(float, (12, 3), elements=st.floats(-0.4, 0.4))
SWAY = Sway(0.5, 0.5)


def increments(*shape, seed=0, size=0.1):
    return np.random.default_rng(seed).uniform(-size, size, (*shape, 3))


# The formulas


def tangent(f):
    """-tan(|f|/4) f/|f|, its first two terms."""
    return -f / 4 - (f @ f) * f / 192


def picard_1(g):
    return -g / 4


def one_step_3(before, g):
    return tangent(g + np.cross(before, g) / 12)


def one_step_3_first(g, after):
    return tangent(g + np.cross(g, after) / 12)


def two_step_3(g1, g2):
    g, cross = g1 + g2, np.cross(g1, g2)
    return -g / 4 - cross / 6 - (g @ g) * g / 192 - np.cross(g, cross) / 48


def third_iterate(g1, g2):
    g = g1 + g2
    return -g / 4 - np.cross(g1, g2) / 6 - (g @ g) * g / 192


def two_step_4(g1, g2):
    return tangent(g1 + g2 + 2 / 3 * np.cross(g1, g2))


def memory_4(before_that, before, g):
    return tangent(g + np.cross(before, g) / 6 - np.cross(before_that, g) / 24)


def memory_4_first(g, after, after_that):
    """The mirror image: time runs backwards, and every cross product changes its sign twice."""
    return tangent(g + np.cross(g, after) / 6 - np.cross(g, after_that) / 24)


def memory_4_second(before, g, after):
    return tangent(g + np.cross(before, g) / 24 + np.cross(g, after) / 24)


def rotation_vector_2(g1, g2):
    return g1 + g2 + 2 / 3 * np.cross(g1, g2)


def rotation_vector_3(g1, g2, g3):
    """Miller (1983)."""
    return g1 + g2 + g3 + 9 / 20 * np.cross(g1, g3) + 27 / 40 * np.cross(g2, g3 - g1)


THIRD_ITERATE = Algorithm("third iterate", 2, 0, {(0, 1): 2 / 3}, "third iterate", 4)
# Sums of up to ten terms, each below one and good to a few eps.
FORMULA = 16 * EPS


@pytest.mark.parametrize(
    ("name", "formula", "samples"),
    [
        ("picard-1", picard_1, 1),
        ("two-step-3", two_step_3, 2),
        (THIRD_ITERATE, third_iterate, 2),
        ("two-step-4", two_step_4, 2),
        ("rotation-vector-2", rotation_vector_2, 2),
        ("rotation-vector-3", rotation_vector_3, 3),
    ],
)
@given(rows=rows_of_increments)
def test_step_of_its_own_increments(name, formula, samples, rows):
    expected = [formula(*step) for step in rows.reshape(-1, samples, 3)]
    np.testing.assert_allclose(step_rotation_vectors(rows, name), expected, rtol=0, atol=FORMULA)


@pytest.mark.parametrize(
    ("name", "formula", "starts"),
    [
        ("one-step-3", one_step_3, [one_step_3_first]),
        ("memory-4", memory_4, [memory_4_first, memory_4_second]),
    ],
)
@given(rows=rows_of_increments)
def test_step_with_increments_of_earlier_steps(name, formula, starts, rows):
    memory = len(starts)
    later = [formula(*rows[i - memory : i + 1]) for i in range(memory, len(rows))]
    first = [start(*rows[: memory + 1]) for start in starts]
    np.testing.assert_allclose(
        step_rotation_vectors(rows, name), [*first, *later], rtol=0, atol=FORMULA
    )
    # With a history there is no start, and what is older than the memory does not matter.
    for older in (memory, memory + 2):
        actual = step_rotation_vectors(rows[older:], name, history=rows[:older])
        np.testing.assert_allclose(actual, later[older - memory :], rtol=0, atol=FORMULA)


@every_algorithm
@given(rows=rows_of_increments)
def test_rotation_of_a_step_is_that_of_its_vector(name, rows):
    method = from_rotation_vector if name in ROTATION_VECTOR else rotation_quaternion
    expected = method(step_rotation_vectors(rows, name))
    # Rows that lie otherwise in memory may have another sine.
    np.testing.assert_allclose(step_quaternions(rows, name), expected, rtol=0, atol=4 * EPS)


@every_algorithm
@given(rows=rows_of_increments)
def test_attitude_is_the_product_of_the_steps(name, rows):
    start = random_quaternions(1)[0]
    expected, product = [], start
    for step in step_quaternions(rows, name):
        product = multiply(product, step)
        expected.append(product)
    # Up to twelve products, each good to 8 eps.
    np.testing.assert_allclose(integrate(rows, name, start=start), expected, rtol=0, atol=100 * EPS)


def test_names_are_keys_and_cannot_be_replaced():
    assert all(ALGORITHMS[name].name == name for name in ALGORITHMS)
    assert [*ALGORITHMS] == [*CONING_ALGORITHMS, "functional-iteration"]
    assert all(ALGORITHMS[name] is CONING_ALGORITHMS[name] for name in CONING_ALGORITHMS)
    assert checked_algorithm("memory-4") is CONING_ALGORITHMS["memory-4"]
    assert len({*CONING_ALGORITHMS.values()}) == len(CONING_ALGORITHMS)  # weights hinder no set
    assert checked_algorithm("memory-4").window == 3
    with pytest.raises(TypeError, match="does not support item assignment"):
        ALGORITHMS["memory-4"] = None


@given(rows=rows_of_increments)
def test_algorithm_of_ones_own(rows):
    """Half the correction of one-step-3, and a start without any."""
    own = Algorithm("own", 1, 1, {(0, 1): 1 / 24}, "tangent", 2, ({},))
    assert checked_algorithm(own) is own
    expected = [tangent(rows[0])]
    expected += [tangent(g + np.cross(before, g) / 24) for before, g in pairwise(rows)]
    np.testing.assert_allclose(step_rotation_vectors(rows, own), expected, rtol=0, atol=FORMULA)
    # Twelve products, each good to 8 eps.
    attitude = cumulative_product(rotation_quaternion(np.array(expected)))
    np.testing.assert_allclose(integrate(rows, own), attitude, rtol=0, atol=100 * EPS)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"samples": 0}, "samples: expected a whole number of at least 1, got 0"),
        ({"memory": 1}, "memory: expected 0 with several samples a step, got 1"),
        ({"starts": ({},)}, "starts: expected one for each of 0 increments of memory, got 1"),
        ({"coning": {(1, 0): 0.5}}, r"coning: expected places 0 <= i < j < 2, got \(1, 0\)"),
        ({"coning": {(0, 2): 0.5}}, r"coning: expected places 0 <= i < j < 2, got \(0, 2\)"),
    ],
)
def test_algorithms_that_do_not_fit_together_are_refused(arguments, words):
    good = {
        "name": "own",
        "samples": 2,
        "memory": 0,
        "coning": {},
        "last_stage": "tangent",
        "order": 2,
    }
    assert Algorithm(**good).window == 2
    with pytest.raises(ValueError, match=rf"^{words}\.$"):
        Algorithm(**(good | arguments))


# One step against the exact rotation


def integrals(rate, interval, first, count):
    """Increments of a rate that is a polynomial in time, lowest power first."""
    powers = np.arange(1, len(rate) + 1)
    edges = interval * np.arange(first, first + count + 1)
    return np.diff(edges[:, np.newaxis] ** powers @ (rate / powers[:, np.newaxis]), axis=0)


def exact_rotation(rate, time):
    """Rotation from time 0 under such a rate: Taylor's series of the quaternion equation."""
    terms = [IDENTITY]
    for n in range(60):
        products = [multiply(terms[n - i], pure(rate[i])) for i in range(min(n + 1, len(rate)))]
        terms.append(sum(products) / (2 * (n + 1)))
    return np.polynomial.polynomial.polyval(time, np.array(terms))


def local_error(name, rate, interval):
    """Rotation vector from the exact rotation to that of a step from time 0."""
    chosen = CONING_ALGORITHMS[name]
    rows = integrals(rate, interval, -chosen.memory, chosen.window)
    history = rows[: chosen.memory] if chosen.memory else None
    step = step_quaternions(rows[chosen.memory :], name, history=history)[0]
    return to_rotation_vector(
        multiply(conjugate(exact_rotation(rate, chosen.samples * interval)), step)
    )


def local_order(name, rate):
    """Fitted over intervals from 1/8 to 1/128 s: errors from 1e-2 to 1e-14, rounding is 1e-18."""
    return order_of(lambda size: np.linalg.norm(local_error(name, rate, 8 * size)))


@every_algorithm
@pytest.mark.parametrize("seed", range(3))
def test_local_order_is_one_more_than_the_order(name, seed):
    """On a rate that is quadratic in time."""
    rate = np.random.default_rng(seed).uniform(-1, 1, (3, 3))
    assert local_order(name, rate) == pytest.approx(CONING_ALGORITHMS[name].order + 1, abs=0.1)


@every_algorithm
@pytest.mark.parametrize("seed", range(3))
def test_local_order_on_a_rate_that_is_linear_in_time(name, seed):
    """The coning correction of one-step-3 is exact there, which gives it an order more."""
    rate = np.random.default_rng(seed).uniform(-1, 1, (2, 3))
    expected = CONING_ALGORITHMS[name].order + (2 if name == "one-step-3" else 1)
    assert local_order(name, rate) == pytest.approx(expected, abs=0.1)


@every_algorithm
@pytest.mark.parametrize("seed", range(3))
def test_coning_correction_is_exact_for_a_rate_that_is_linear_in_time(name, seed):
    """Half the integral of gamma × omega over a step of T is a × b T^3/12 for omega = a + b t."""
    chosen, interval, count = CONING_ALGORITHMS[name], 0.1, 6
    rate = np.random.default_rng(seed).uniform(-1, 1, (2, 3))
    rows = integrals(rate, interval, 0, count)
    gamma = rows.reshape(-1, chosen.samples, 3).sum(axis=1)
    # The later steps begin with another a, which differs by a multiple of b; and so do the starts.
    coning = np.zeros_like(gamma)
    if chosen.coning:
        coning += np.cross(*rate) * (chosen.samples * interval) ** 3 / 12
    f = gamma + coning
    expected = {
        "first iterate": -gamma / 4,
        "second iterate": -f / 4
        - np.sum(gamma**2, axis=-1, keepdims=True) * gamma / 192
        - np.cross(gamma, coning) / 32,
        "tangent": -f / 4 - np.sum(f**2, axis=-1, keepdims=True) * f / 192,
        "rotation vector": f,
    }[chosen.last_stage]
    np.testing.assert_allclose(step_rotation_vectors(rows, name), expected, rtol=0, atol=16 * EPS)


A, B, C = np.random.default_rng(7).uniform(-1, 1, (3, 3))


@pytest.mark.parametrize(
    ("name", "power", "leading"),
    [
        # No coning correction, and tan(phi/4) taken for phi/4.
        ("picard-1", 3, -np.cross(A, B) / 12 - (A @ A) * A / 48),
        # The correction from two increments cannot see the second derivative.
        ("one-step-3", 4, -np.cross(A, C) / 12),
        # What the third iterate takes away: gamma × (g1 × g2)/12, and g1 × g2 is a × b H^3/8.
        ("two-step-3", 4, np.cross(A, np.cross(A, B)) / 96),
    ],
)
def test_leading_term_of_the_local_error(name, power, leading):
    rate, samples = np.array([A, B, C]), CONING_ALGORITHMS[name].samples

    def rest(size):
        interval = 8 * size
        error = local_error(name, rate, interval)
        return np.linalg.norm(error - leading * (samples * interval) ** power)

    assert order_of(rest) == pytest.approx(power + 1, abs=0.1)


# Whole motions: global orders as fitted slopes over 96 to 1536 increments

COUNTS = 6 * 2 ** np.arange(4, 9)


def errors(motion, name, duration, count, **options):
    """Angle between the calculated and the exact attitude after each step."""
    interval, samples = duration / count, CONING_ALGORITHMS[name].samples
    attitude = integrate(
        motion.increments(interval, count), name, start=motion.attitude(0), **options
    )
    times = samples * interval * np.arange(1, count // samples + 1)
    return rotation_angle(multiply(conjugate(motion.attitude(times)), attitude))


def fitted_order(error):
    sizes = [np.log(error(count)) for count in COUNTS]
    return -np.polyfit(np.log(COUNTS), sizes, 1)[0]


@every_algorithm
@pytest.mark.parametrize("motion", [SWAY, Sway(1.0, 0.5)], ids=str)
def test_global_order_on_a_motion_without_symmetries(name, motion):
    """Without a history: the starts keep the order. Errors from 1e-3 to 1e-11."""
    order = fitted_order(lambda count: errors(motion, name, 4, count).max())
    assert order == pytest.approx(CONING_ALGORITHMS[name].order, abs=0.1)


def test_small_cone_makes_one_step_3_look_fourth_order():
    """Its error of third order is of a^3, the drift, of fourth, of a^2; on a wide cone it shows."""

    def largest(half_angle):
        motion = Coning(np.radians(half_angle), 1)
        return lambda count: errors(motion, "one-step-3", 1, count).max()

    assert fitted_order(largest(0.1)) == pytest.approx(4, abs=0.1)
    assert fitted_order(largest(60)) == pytest.approx(3, abs=0.1)


@with_rotation_vector
def test_rotation_vector_is_exact_about_a_fixed_axis(name):
    # Each of up to 1536 steps is good to a few eps, in random directions.
    for count in COUNTS:
        assert errors(FixedAxis(1, 0.5), name, 2.3, count).max() < 4 * count**0.5 * EPS


@with_cayley
def test_order_about_a_fixed_axis(name):
    """No coning: all that is left is the cut-off tangent, of order 2 or 4."""
    order = fitted_order(lambda count: errors(FixedAxis(1, 0.5), name, 2.3, count).max())
    assert order == pytest.approx(2 if name == "picard-1" else 4, abs=0.1)


@with_cayley
@given(g=st.floats(-6.28, 6.28))
def test_local_residual_about_a_fixed_axis(name, g):
    """4 atan(g/4 + g^3/192) - g, or the same without the cube."""
    chosen = CONING_ALGORITHMS[name]
    # In unequal parts: parallel increments have no cross product, whatever their sizes.
    parts = np.array([g]) if chosen.samples == 1 else np.array([0.3 * g, 0.7 * g])
    history = np.outer([0.5, -0.2], [0, 0, 1]) if chosen.memory else None
    step = step_quaternions(np.outer(parts, [0, 0, 1]), name, history=history)[0]
    tangent = g / 4 if name == "picard-1" else g / 4 + g**3 / 192
    angle = 2 * np.arctan2(step[2], step[3])
    assert angle == pytest.approx(4 * np.arctan(tangent), abs=32 * EPS)


# Starts and histories


@with_memory
def test_order_with_the_true_history(name):
    def final(count):
        interval = 4 / count
        # The same sway seen from 2 intervals later: time in this test starts there.
        rows = SWAY.increments(interval, count)
        start = SWAY.attitude(2 * interval)
        attitude = integrate(rows[2:], name, start=start, history=rows[:2])[-1]
        return rotation_angle(multiply(conjugate(SWAY.attitude(4)), attitude))

    assert fitted_order(final) == pytest.approx(CONING_ALGORITHMS[name].order, abs=0.1)


@with_memory
def test_zero_history_keeps_the_order_in_the_end(name):
    """The corrections of the first steps, 0 and 1/6, add up to those that are due, twice 1/12.

    For one-step-3 a correction is lost, which costs as much as all its other steps together.
    """
    history = np.zeros((2, 3))
    # After the first step alone the error is of third order for both.
    order = fitted_order(lambda count: errors(SWAY, name, 4, count, history=history)[1:].max())
    assert order == pytest.approx(CONING_ALGORITHMS[name].order, abs=0.1)
    first = fitted_order(lambda count: errors(SWAY, name, 4, count, history=history)[0])
    assert first == pytest.approx(3, abs=0.1)


@every_algorithm
@given(data=st.data())
def test_chunks_are_the_same_as_all_at_once(name, data):
    chosen, count = CONING_ALGORITHMS[name], 24
    rows, start = increments(count, seed=4), random_quaternions(1)[0]
    # Cuts after whole steps; what is before the first suffices to start.
    places = range(-(-chosen.window // chosen.samples) * chosen.samples, count, chosen.samples)
    cuts = sorted(data.draw(st.sets(st.sampled_from(places))))
    parts, attitude = [], start
    for first, last in zip([0, *cuts], [*cuts, count], strict=True):
        history = rows[:first] if first else None
        parts.append(integrate(rows[first:last], name, start=attitude, history=history))
        attitude = parts[-1][-1]
    expected = integrate(rows, name, start=start)
    # Up to 24 products, each good to 8 eps.
    np.testing.assert_allclose(np.concatenate(parts), expected, rtol=0, atol=200 * EPS)


# Leading axes, norms, word


@with_memory
@pytest.mark.parametrize(
    ("leading", "past"),
    [((), (3,)), ((), (2,)), ((3,), ()), ((2, 3), ()), ((3,), (3,)), ((2, 1), (1, 3))],
    ids=str,
)
def test_history_broadcasts(name, leading, past):
    rows, before = increments(*leading, 6), increments(*past, 2, seed=1)
    together = step_rotation_vectors(rows, name, history=before)
    shape = np.broadcast_shapes(leading, past)
    assert together.shape[:-2] == shape
    rows = np.broadcast_to(rows, (*shape, 6, 3))
    before = np.broadcast_to(before, (*shape, 2, 3))
    for index in np.ndindex(shape):
        alone = step_rotation_vectors(rows[index], name, history=before[index])
        np.testing.assert_allclose(together[index], alone, rtol=0, atol=4 * EPS)


@pytest.mark.parametrize("name", [name for name in CONING_ALGORITHMS if name not in MEMORY])
def test_history_of_an_algorithm_without_memory_is_not_looked_at(name):
    rows = increments(6)
    found = integrate(rows, name, history="none")
    np.testing.assert_allclose(found, integrate(rows, name), rtol=0, atol=4 * EPS)


@every_algorithm
def test_attitude_stays_of_unit_norm(name):
    attitude = integrate(increments(3000), name, start=random_quaternions(1)[0])
    # Each step's norm is good to a few eps, in random directions.
    norms = np.linalg.norm(attitude, axis=-1)
    np.testing.assert_allclose(norms, 1, rtol=0, atol=4 * 3000**0.5 * EPS)


# Refusals

FUNCTIONS = [integrate, step_quaternions, step_rotation_vectors]
every_function = pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.__name__)


@every_function
def test_unknown_algorithm_is_refused_with_the_known_ones(function):
    with pytest.raises(
        ValueError, match=r"^algorithm: expected one of picard-1, .*, got 'two-step-5'\.$"
    ):
        function(increments(6), "two-step-5")


@every_function
@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (np.zeros(3), r"shape \(\.\.\., n, 3\), got shape \(3,\)"),
        (np.zeros((6, 4)), r"shape \(\.\.\., n, 3\), got shape \(6, 4\)"),
        (np.zeros((0, 3)), "at least one value, got an empty array"),
        (
            np.zeros((5, 3)),
            "a multiple of 2 for two-step-4, got 5; keep the last 1 for the next call",
        ),
    ],
    ids=["one row", "four columns", "empty", "odd"],
)
def test_bad_increments_are_refused(function, bad, words):
    with pytest.raises(ValueError, match=rf"^increments: expected {words}\.$"):
        function(bad, "two-step-4")


@pytest.mark.parametrize(("name", "least"), [("one-step-3", 2), ("memory-4", 3)])
def test_too_few_increments_to_start_are_refused(name, least):
    expected = integrate(increments(least), name)
    assert expected.shape == (least, 4)
    with pytest.raises(
        ValueError,
        match=rf"^increments: expected at least {least} for {name} to start without a history, "
        rf"got {least - 1}\.$",
    ):
        integrate(increments(least - 1), name)
    # With a history one is enough.
    assert integrate(increments(1), name, history=increments(2)).shape == (1, 4)


@every_function
@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (
            np.zeros((1, 3)),
            r"shape \(\.\.\., m, 3\) with m at least 2 for memory-4, got shape \(1, 3\)",
        ),
        (np.zeros(3), r"shape \(\.\.\., m, 3\) with m at least 2 for memory-4, got shape \(3,\)"),
        (np.zeros((2, 4)), r"shape \(\.\.\., 3\), got shape \(2, 4\)"),
    ],
)
def test_bad_histories_are_refused(function, bad, words):
    with pytest.raises(ValueError, match=rf"^history: expected {words}\.$"):
        function(increments(6), "memory-4", history=bad)


@with_cayley
def test_whole_turn_in_a_step_is_refused_where_k_is_infinite(name):
    samples = CONING_ALGORITHMS[name].samples
    part = np.array([2.0, -1.0, 2.0]) / 3 / samples
    below, above = np.tile(6.283 * part, (6, 1)), np.tile(6.284 * part, (6, 1))
    assert np.isfinite(integrate(below, name)).all()
    with pytest.raises(
        ValueError,
        match=r"^increments: expected less than a whole turn a step, where the true k is "
        r"infinite, got 6\.28 rad\.$",
    ):
        integrate(above, name)


@with_cayley
def test_one_whole_turn_among_many_steps_and_runs_is_refused(name):
    rows = np.full((2, 24, 3), 1e-3)
    samples = CONING_ALGORITHMS[name].samples
    rows[1, 12 : 12 + samples] = [0.0, 6.3 / samples, 0.0]
    with pytest.raises(ValueError, match=r"^increments: expected less than a whole turn a step"):
        integrate(rows, name)
    assert np.isfinite(integrate(rows[0], name)).all()


@with_cayley
def test_increment_of_a_whole_turn_is_refused_though_it_comes_back_within_the_step(name):
    """Between the samples it may have turned round at any time: nothing could be said."""
    rows = np.zeros((6, 3))
    rows[:, 1] = np.tile([6.3, -6.3], 3)
    with pytest.raises(ValueError, match=r"^increments: expected less than a whole turn a step"):
        integrate(rows, name)


@with_rotation_vector
def test_whole_turns_in_a_step_are_nothing_to_a_rotation_vector(name):
    samples = CONING_ALGORITHMS[name].samples
    rows = np.tile(np.array([0, 0, 7 / samples]), (6, 1))
    steps = np.arange(1, 6 // samples + 1)
    expected = from_rotation_vector(np.outer(7 * steps, [0, 0, 1]))
    np.testing.assert_allclose(integrate(rows, name), expected, rtol=0, atol=100 * EPS)


def test_increments_that_a_word_cannot_hold_are_refused():
    with pytest.raises(
        ValueError, match=r"^increments: expected numbers that float16 can hold, got larger ones\.$"
    ):
        step_rotation_vectors(np.full((2, 3), 1e5), "rotation-vector-2", word="float16")


def test_one_whole_turn_between_samples_is_nothing_unusual():
    """The warning is of more than that, as degrees are."""
    whole = [[0.0, 0.0, 2 * np.pi], [0.3, 0.0, 0.0]]
    with warnings.catch_warnings():
        warnings.simplefilter("error", UnusualWarning)
        found = integrate(whole, "rotation-vector-2")[-1]
    np.testing.assert_allclose(np.linalg.norm(found), 1, rtol=0, atol=4 * EPS)
    with pytest.warns(UnusualWarning, match="6.29 rad between two samples is more than a whole"):
        integrate([[0.0, 0.0, 6.29], [0.3, 0.0, 0.0]], "rotation-vector-2")


def test_angles_that_cannot_be_angles_are_refused():
    with pytest.raises(ValueError, match=r"^increments: expected angles in rad, got 1e\+40\.$"):
        integrate([[1e40, 0, 0]] * 2, "rotation-vector-2")
