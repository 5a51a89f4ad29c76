"""One's own function in place of a named algorithm: the same everywhere, or a sentence."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab.attitude import (
    ALGORITHMS,
    CONING_ALGORITHMS,
    Algorithm,
    FunctionalIteration,
    coning_drift,
    integrate,
    integrate_finite_word,
    noise_growth,
    sculling_correction,
    simulated_coning_drift,
    step_quaternions,
    step_rotation_vectors,
)
from driftlab.attitude.own_algorithms import checked_steps
from driftlab.book.ch07_coning.experiments import (
    algorithm_errors,
    algorithm_orders,
    coning,
    drift_by_frequency_and_rate,
)
from driftlab.book.ch07_coning.experiments.algorithms import named_algorithms
from driftlab.book.ch08_attitude_from_an_imu.experiments.noise_and_band import rounding_error
from driftlab.book.ch16_one_triad.experiments import calibration_stages
from driftlab.drift import recorded_turn_estimate
from driftlab.motion import Coning, Sway, TurntableRotation
from driftlab.quaternion import multiply
from support import EPS

ROWS = Sway(0.5, 0.7).increments(0.01, 24)
RUNS = np.stack([ROWS, 0.3 * ROWS[::-1]])
TURN = TurntableRotation(0.2, latitude=1.0).increments([1, 1, 0], samples=360).angle


def pair(g):
    """The two-sample algorithm, as a reader would write it."""
    return g[0::2] + g[1::2] + 2 / 3 * np.cross(g[0::2], g[1::2])


def attitudes(g):
    return integrate(g, "rotation-vector-2")


def rotations(g):
    return Rotation.from_quat(attitudes(g))


def one_by_one(g):
    """A list of lists, from a loop of one's own."""
    now, found = Rotation.identity(), []
    for first, second in g.reshape(-1, 2, 3):
        now = now * Rotation.from_rotvec(first + second + 2 / 3 * np.cross(first, second))
        found.append(now.as_quat().tolist())
    return found


OWN = [pair, attitudes, rotations, one_by_one]
WAYS = {
    "integrate": lambda one: integrate(ROWS, one, start=[0.0, 0.6, 0.0, 0.8]),
    "integrate, several runs": lambda one: integrate(RUNS, one),
    "integrate, several runs and starts": lambda one: integrate(
        RUNS, one, start=[[0.0, 0.6, 0.0, 0.8], [1.0, 0.0, 0.0, 0.0]]
    ),
    "integrate, history": lambda one: integrate(ROWS[2:], one, history=ROWS[:2]),
    "step_quaternions": lambda one: step_quaternions(ROWS, one),
    "coning_drift": lambda one: coning_drift(one, [[0.01], [0.4]], [1.0, -5.0, 9.0], 0.01),
    "simulated_coning_drift": lambda one: simulated_coning_drift(
        one, 0.4, [1.0, -5.0], 0.01, count=840
    ),
    "recorded_turn_estimate": lambda one: recorded_turn_estimate(TURN, [1, 1, 0], algorithm=one),
    "algorithm_errors": lambda one: algorithm_errors(
        Coning(0.3, 1.0), 24, {"one": one}, rates=(12, 24)
    ).largest_error,
    "algorithm_orders": lambda one: algorithm_orders({"one": one}).largest_error,
    "drift_by_frequency_and_rate": lambda one: drift_by_frequency_and_rate(
        {"one": one}
    ).measured["one, by rate"],
    "rounding_error": lambda one: rounding_error(one, 20.0, carry=True, seconds=6.0, runs=2),
    "calibration_stages": lambda one: (
        calibration_stages(half_angle=0.01, algorithm=one).aligned_error
    ),
}  # fmt: skip


@pytest.mark.parametrize(
    ("way", "own"),
    [(way, OWN[k % 4]) for k, way in enumerate(WAYS)] + [("step_quaternions", own) for own in OWN],
)
def test_own_function_does_what_the_named_algorithm_does(way, own, monkeypatch):
    for name in ("FINE_FREQUENCIES", "FINE_SAMPLE_RATES"):  # ten places of a curve tell as much
        monkeypatch.setattr(coning, name, getattr(coning, name)[::20])
    found, named = (WAYS[way](one) for one in (own, "rotation-vector-2"))
    # Some eps a step, and of the drifts some eps over an interval of 0.01 s.
    np.testing.assert_allclose(found, named, rtol=1e-9, atol=1e-11)


@pytest.mark.parametrize("word", [np.float32, np.float64])
def test_in_a_short_word_the_steps_of_an_own_function_are_rounded(word):
    found, named = (integrate_finite_word(ROWS, one, word=word) for one in (pair, "two-step-4"))
    assert found.dtype == word
    # Rounding of each step; the two last stages differ by less in double precision.
    bound = len(named) * np.finfo(word).eps if word == np.float32 else 1e-7
    np.testing.assert_allclose(found, named, rtol=0, atol=bound)
    cayley = -np.tan(np.linalg.norm(pair(ROWS), axis=1) / 4) / np.linalg.norm(pair(ROWS), axis=1)
    np.testing.assert_allclose(
        step_rotation_vectors(ROWS, pair), cayley[:, np.newaxis] * pair(ROWS), rtol=0, atol=1e-15
    )


@pytest.mark.parametrize("name", ALGORITHMS)
@pytest.mark.parametrize("half_angle", [0.01, 0.5])
def test_measured_drift_is_that_of_the_formula(name, half_angle):
    def own(g):
        return integrate(g, name)

    expected = coning_drift(name, half_angle, [1.0, -4.0], 0.02)
    # A step's own error does not grow: a part of the whole error of a step without correction.
    wobble = abs(coning_drift("picard-1", half_angle, [1.0, -4.0], 0.02)) / 60
    rounding = 1e-13 / 0.02
    for drift in (
        simulated_coning_drift(name, half_angle, [1.0, -4.0], 0.02),
        simulated_coning_drift(own, half_angle, [1.0, -4.0], 0.02),
    ):
        assert (abs(drift - expected) <= 0.1 * wobble + rounding).all()
    by_formula = coning_drift(own, half_angle, [1.0, -4.0], 0.02)
    np.testing.assert_allclose(by_formula, expected, rtol=1e-8, atol=rounding)


def test_measured_drift_is_followed_beyond_half_a_turn():
    """With two samples a round `picard-1` misses all of the coning, many turns in so long."""
    expected = coning_drift("picard-1", 1.0, 1.0, 0.4)
    found = simulated_coning_drift("picard-1", 1.0, 1.0, 0.4, count=600)
    assert abs(expected) * 240 > 10 * np.pi
    assert found == pytest.approx(expected, rel=1e-3)


def test_steps_that_never_repeat_are_measured_only():
    def smoothed(g):
        return g + 1e-4 * np.linspace(0, 1, len(g))[:, np.newaxis] * [0, 0, 1]

    with pytest.raises(
        ValueError, match=r"^algorithm: expected steps that repeat .* simulated_con"
    ):
        coning_drift(smoothed, 0.1, 1.0, 0.01)
    plain, found = (simulated_coning_drift(one, 0.1, 1.0, 0.01) for one in ("picard-1", smoothed))
    assert found - plain == pytest.approx(0.5e-4 / 0.01, rel=1e-2)


def sums(samples):
    return lambda g: g.reshape(-1, samples, 3).sum(axis=1)


@pytest.mark.parametrize("samples", [1, 2, 4, 8])
def test_period_of_own_steps_is_one_at_any_rhythm(samples):
    """Rounding makes some pairs of steps more alike than others; that is no longer period."""
    named = Algorithm("sums", samples, 0, {}, "rotation vector", order=2)
    rng = np.random.default_rng(samples)
    rhythms = [1.3, 2.6, 5.2, *np.exp(rng.uniform(np.log(1.05), np.log(300), 10)).round(2)]
    for around, degrees in zip(rhythms, rng.choice([5, 10, 20, 30, 45], 13), strict=True):
        cone = np.radians(degrees), 1.0, 1 / around
        try:
            expected = coning_drift(named, *cone)
        except ValueError:
            with pytest.raises(ValueError, match=r"^half_angle, frequency, .* half a turn"):
                coning_drift(sums(samples), *cone)
        else:
            found = coning_drift(sums(samples), *cone)
            assert found == pytest.approx(expected, rel=1e-9, abs=1e-12 * around)


@pytest.mark.parametrize("around", [10.0, 100.0, 9.7, 10.0000001])
@pytest.mark.parametrize("bias", [[1e-6, 0, 0], [-1e-6, 0, 0], [0, 1e-6, 0], [0, 0, 1e-6]])
def test_constant_drift_of_an_own_function_counts_by_its_part_about_the_axis(around, bias):
    def drifting(g):
        return pair(g) + bias

    half_angle = np.radians(0.5)
    by_formula = coning_drift(drifting, half_angle, 1.0, 1 / around)
    plain = coning_drift(pair, half_angle, 1.0, 1 / around)
    # A constant turn across the axis comes to nothing in a round; what it leaves in half a one
    # is a wobble of `measured`.
    expected = plain + bias[2] * np.cos(half_angle) * around / 2
    assert by_formula == pytest.approx(expected, rel=2e-4, abs=2e-13 * around)
    measured = simulated_coning_drift(drifting, half_angle, 1.0, 1 / around, count=8000)
    assert measured == pytest.approx(by_formula, rel=2e-4, abs=2e-12 * around)


def longdouble_twist(f, half_angle, x, count):
    """Rate of the error about the axis, rad a sample, and its changes in a step: in extended
    precision, each step's error taken the shorter way, from attitudes by Euler's formula."""
    kind = np.longdouble
    a, x = kind(half_angle), kind(x)

    def times(p, q):
        vector = p[3] * q[:3] + q[3] * p[:3] + np.cross(p[:3], q[:3])
        return np.append(vector, p[3] * q[3] - p[:3] @ q[:3])

    def turn(v):
        angle = np.sqrt(v @ v)
        return np.append(v * np.sin(angle / 2) / angle, np.cos(angle / 2))

    ends = x * np.arange(count + 1)
    rows = np.stack([
        np.sin(a) * np.diff(np.cos(ends)), np.sin(a) * np.diff(np.sin(ends)),
        np.full(count, -(1 - np.cos(a)) * x),
    ], axis=1)  # fmt: skip
    vectors = f(rows)
    samples = count // len(vectors)
    now = turn(a * np.array([1, 0, 0], kind))
    last, changes = np.array([0, 0, 0, 1], kind), []
    for n, vector in enumerate(vectors, 1):
        now = times(now, turn(vector))
        phase = x * samples * n
        true = turn(-a * np.array([np.cos(phase), np.sin(phase), 0], kind))
        error = times(now, true)
        error = error if error @ last >= 0 else -error
        first, second = complex(last[3], last[2]), complex(error[3], error[2])
        changes.append(2 * np.angle(second * np.conj(first)))
        last = error
    changes = np.array(changes)
    return changes.sum() / count, np.abs(changes).max()


def test_formula_and_measurement_agree_or_both_refuse():
    """Against the error followed in extended precision, on cones of any width and rhythm."""
    rng, refused, told = np.random.default_rng(4), 0, 0
    widths, rhythms = (10, 45, 80, 100, 120, 150), (1.3, 2.2, 2.5, 2.9, 3.0, 3.3, 4.0, 7.3)
    cases = [(f, d, r) for f in (sums(1), sums(2), pair) for d in widths for r in rhythms]
    for which in rng.choice(len(cases), 24, replace=False):
        function, degrees, around = cases[which]
        cone = np.radians(degrees), 1.0, 1 / around
        true, most = longdouble_twist(function, cone[0], 2 * np.pi / around, 840)
        if most >= np.pi:
            for drift in (coning_drift, simulated_coning_drift):
                with pytest.raises(ValueError, match=r"^half_angle, .* half a turn a step, got"):
                    drift(function, *cone)
            refused += 1
            continue
        # They differ by the wobble at the end, less than half a turn.
        measured = simulated_coning_drift(function, *cone) / around
        assert measured == pytest.approx(true, abs=np.pi / 840)
        assert coning_drift(function, *cone) / around == pytest.approx(true, abs=2 * np.pi / 840)
        told += 1
    assert min(refused, told) > 1


@pytest.mark.parametrize(
    ("name", "degrees", "around"),
    [("rotation-vector-3", 120, 4.0), ("rotation-vector-2", 120, 3.3), (pair, 80, 2.9)],
)
def test_an_error_that_swings_by_half_a_turn_in_a_step_is_no_drift(name, degrees, around):
    for drift in (coning_drift, simulated_coning_drift):
        with pytest.raises(ValueError, match=r"^half_angle, frequency, .* less than half a turn"):
            drift(name, np.radians([1.0, degrees]), 1.0, 1 / around)


def test_single_precision_is_measured_and_its_formula_refused_with_the_reason():
    def short(g):
        return pair(g.astype(np.float32))

    def short_attitudes(g):
        return attitudes(g).astype(np.float32)

    cone = np.radians(0.5), 1.0, 1 / 37.123
    expected = coning_drift(pair, *cone)
    for function in (short, short_attitudes):
        with pytest.raises(ValueError, match=r"to the digits of double precision.* differ by .*e-"):
            coning_drift(function, *cone)
        # Rounding of numbers up to one, at random or of the last attitude alone.
        found = simulated_coning_drift(function, *cone)
        assert found == pytest.approx(expected, abs=np.finfo(np.float32).eps * 37.123 / 10)


@pytest.mark.parametrize("degrees", [5, 10, 30, 45, 80, 120])
@pytest.mark.parametrize(("around", "each"), [(20, 20), (40, 40), (20, 10), (60, 60), (12, 8)])
def test_seldom_answers_of_a_good_integrator_are_no_slip(degrees, around, each):
    cone = np.radians(degrees), 1.0, 1 / around

    def seldom(g):
        return integrate(g, "rotation-vector-2")[each // 2 - 1 :: each // 2]

    def vectors(g):
        return Rotation.from_quat(step_quaternions(g, seldom)).as_rotvec()

    often = simulated_coning_drift("rotation-vector-2", *cone, count=960)
    for function in (seldom, vectors):
        assert simulated_coning_drift(function, *cone, count=960) == pytest.approx(often, abs=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_poor_integrators_are_no_slip_in_steps_of_any_length(seed):
    """Euler's method, and no correction at all, on rough random motion."""
    rng = np.random.default_rng(seed)
    rows = 10 ** rng.uniform(-6, 0.5) * (rng.normal(size=3) + rng.normal(size=(240, 3)))

    def euler(g):
        now, found = np.array([0.0, 0.0, 0.0, 1.0]), []
        for row in g:
            now = now + multiply(now, np.append(row / 2, 0.0))
            now /= np.linalg.norm(now)
            found.append(now)
        return np.array(found)

    for each in (1, 4, 20, 60, 240):
        for function in (lambda g, n=each: euler(g)[n - 1 :: n], sums(each)):
            assert len(integrate(rows, function)) == 240 // each


WRONG = {
    "degrees": (lambda g: np.degrees(pair(g)), "rotation vectors in rad .* got degrees"),
    "opposite": (lambda g: -pair(g), "got the opposite sign"),
    "Cayley": (lambda g: step_rotation_vectors(g, "two-step-4"), "got Cayley vectors"),
    "Cayley, other sign": (
        lambda g: -step_rotation_vectors(g, "two-step-4"),
        r"got vectors tan\(phi/4\)",
    ),
    "cumulated": (lambda g: np.cumsum(pair(g), axis=0), "got rotation vectors since the start"),
    "scalar first": (lambda g: attitudes(g)[:, [3, 0, 1, 2]], "got scalar first"),
    "inverse": (lambda g: rotations(g).inv(), "got reference to body"),
    "steps": (lambda g: step_quaternions(g, "two-step-4"), "got the rotation of each step"),
    "into degrees": (lambda g: integrate(np.degrees(g), "rotation-vector-2"), "into degrees"),
    "from degrees": (lambda g: integrate(np.radians(g), "rotation-vector-2"), "taken for degrees"),
    "with the start": (
        lambda g: np.vstack([[0, 0, 0, 1], integrate(g, "picard-1")]),
        r"got shape \(25, 4\) \(leave out the attitude before the first\)",
    ),
    "too few": (lambda g: pair(g)[1:], r"after every k-th of n = 24 increments, got shape \(11, 3"),
    "one vector": (lambda g: g.sum(axis=0), r"got shape \(3,\)"),
    "matrices": (lambda g: rotations(g).as_matrix(), r"got shape \(12, 3, 3\)"),
    "NaN": (lambda g: pair(g) * np.nan, "what <lambda> returned: expected finite numbers, got 36"),
    "nothing": (lambda g: None, "what <lambda> returned: expected real numbers"),
    "too long": (lambda g: 1.1 * attitudes(g), "quaternions of length 1 from <lambda>, got one of"),
    "one too long": (
        lambda g: attitudes(g) * np.where(np.arange(12) == 3, 1.1, 1.0)[:, np.newaxis],
        r"quaternions of length 1 from <lambda>, got one of 1\.1\.",
    ),
}


@pytest.mark.parametrize("slip", WRONG)
def test_answer_of_a_wrong_function_is_refused_with_its_slip(slip):
    function, words = WRONG[slip]
    with pytest.raises(ValueError, match=f"^algorithm: .*{words}"):
        integrate(0.1 * ROWS, function)


def test_a_bad_algorithm_is_no_slip_and_its_argument_is_its_own():
    rows = ROWS.copy()

    def half(g):
        g *= 0.5
        return g

    expected = step_quaternions(ROWS / 2, half_of)
    np.testing.assert_allclose(checked_steps(half, rows), expected, rtol=0, atol=4 * EPS)
    np.testing.assert_array_equal(rows, ROWS)


def half_of(g):
    return g


def test_what_is_no_algorithm_is_refused():
    for wrong in (None, 3, "euler", FunctionalIteration):
        with pytest.raises(ValueError, match=r"^algorithm: expected one of .* a function of"):
            integrate(ROWS, wrong)
    words = "weights can be read, got a function; write it as an Algorithm"
    with pytest.raises(ValueError, match=words):
        noise_growth(pair, 0.1)
    with pytest.raises(ValueError, match=words):
        sculling_correction(ROWS, ROWS, pair)
    with pytest.raises(ValueError, match=r"^history: expected whole steps of 2 .* got 1\."):
        integrate(ROWS[1:], pair, history=ROWS[:1])
    with pytest.raises(ValueError, match=r"^history: expected shape"):
        integrate(ROWS, pair, history=ROWS[0])


def test_several_algorithms_have_names():
    assert list(named_algorithms(CONING_ALGORITHMS)) == list(CONING_ALGORITHMS)
    with pytest.raises(ValueError, match=r"^algorithms: expected a name with a function"):
        named_algorithms([pair])
    for wrong in ("two-step-4", None):
        with pytest.raises(ValueError, match=r"^algorithms: expected several names"):
            named_algorithms(wrong)


@pytest.mark.parametrize(
    ("mine", "count", "words"),
    [
        (lambda g: g[0::2] + g[1::2], 9, "of n = 9: .* needs n to be a multiple of k"),
        (lambda g, dt: g, 8, "TypeError of n = 8: .*dt"),
        (lambda g: 1.0, 8, r"got shape \(1,\)"),
    ],
)
def test_what_a_function_cannot_do_is_said_in_a_sentence(mine, count, words):
    with pytest.raises(ValueError, match=f"^algorithm: expected .*lambda.*{words}"):
        integrate(np.full((count, 3), 0.01), mine)
