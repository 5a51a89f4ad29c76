"""The compiled loops against NumPy's: one set of formulas, so only rounding may differ."""

import os
import subprocess
import sys
from contextlib import contextmanager

import numpy as np
import pytest

from driftlab import use_compiled
from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithm
from driftlab.attitude.integration import integrate
from driftlab.calibration.simulation import TableTrial
from driftlab.core import loops
from driftlab.earth import earth_rate, gravity
from driftlab.increments import Increments
from driftlab.motion.scheme import Scheme
from driftlab.quaternion import cumulative_product, from_rotation_vector
from driftlab.strapdown import at_rest, navigate

pytest.importorskip("numba")
EPS = np.finfo(float).eps
# Two samples of which the first looks back, and a window whose pairs are not in order.
OWN = (
    Algorithm("third", 2, 0, {(0, 1): 2 / 3}, "third iterate", 3),
    Algorithm("four", 4, 0, {(2, 3): 0.6, (0, 3): 0.2, (0, 1): 0.5}, "rotation vector", 4),
    Algorithm("no coning", 1, 0, {}, "rotation vector", 2),
)


@pytest.fixture(autouse=True)
def _numpy_afterwards():
    yield
    use_compiled(False)


@contextmanager
def loops_compiled():
    use_compiled()
    try:
        yield
    finally:
        use_compiled(False)


def both(function):
    """What a function returns with NumPy, and compiled."""
    plain = function()
    with loops_compiled():
        return plain, function()


def assert_attitudes_agree(plain, fast):
    # A product of n factors is rounded n times in either way, at random: a few times its root.
    tolerance = 16 * EPS * np.sqrt(plain.shape[-2])
    np.testing.assert_allclose(fast, plain, rtol=0, atol=tolerance)
    assert fast.flags.writeable


@pytest.mark.parametrize("size", [0.0, 1e-200, 0.01, 0.8])
@pytest.mark.parametrize("algorithm", [*CONING_ALGORITHMS.values(), *OWN], ids=lambda one: one.name)
def test_attitudes_agree(algorithm, size):
    rng = np.random.default_rng(1)
    increments, past = size * rng.uniform(-1, 1, (2, 3, 240, 3)), size * rng.uniform(-1, 1, (5, 3))
    for start in ([0, 0, 0, 1], [0.6, 0, 0, 0.8], rng.normal(size=(3, 4))):
        for history in (None, past):
            plain, fast = both(
                lambda start=start, history=history: integrate(
                    increments, algorithm, start=start, history=history
                )
            )
            assert plain.shape == fast.shape
            assert_attitudes_agree(plain, fast)


def test_many_filters_may_share_a_noise_or_a_transition():
    rng = np.random.default_rng(5)
    half = rng.normal(size=(4, 5, 5))
    covariances, transitions = half @ half.mT, rng.normal(size=(4, 2, 5))
    noises = np.array([[1.0, 0.1], [0.1, 2.0]]) * rng.uniform(1, 2, (4, 1, 1))
    for given in (
        (covariances, transitions, noises[0]),
        (covariances, transitions[0], noises),
        (covariances[0], transitions, noises),
        (covariances[0], transitions[0], noises[0]),
    ):
        plain, fast = both(lambda given=given: loops.predict(*given))
        np.testing.assert_allclose(fast, plain, rtol=1e-13, atol=1e-13)


def test_of_a_covariance_both_halves_count():
    rng = np.random.default_rng(12)
    half = rng.normal(size=(5, 5))
    covariance, observation = half @ half.T, rng.normal(size=(2, 5))
    lopsided = covariance + np.triu(rng.normal(size=(5, 5)), 1)
    for given in (covariance, lopsided):
        plain, fast = both(
            lambda given=given: loops.correct(given, np.ones(2), observation, np.eye(2))
        )
        for one, other in zip(plain, fast, strict=True):
            np.testing.assert_allclose(other, one, rtol=0, atol=1e-12)


def test_any_layout_of_increments_will_do():
    rows = np.random.default_rng(2).uniform(-0.1, 0.1, (3, 60, 2))
    strange = np.asfortranarray(rows).transpose(2, 1, 0)[:, ::-1]
    strange.flags.writeable = False
    plain, fast = both(lambda: integrate(strange))
    assert_attitudes_agree(plain, fast)


def test_whole_turns_are_refused_in_the_same_words():
    increments = np.full((2, 4, 3), 2.0)
    messages = []
    for on in (False, True):
        use_compiled(on)
        with pytest.raises(
            ValueError, match=r"^increments: expected less than a whole turn"
        ) as told:
            integrate(increments)
        messages.append(str(told.value))
    assert messages[0] == messages[1]


def test_cumulative_products_agree():
    vectors = np.random.default_rng(3).normal(size=(2, 2, 1000, 3))
    plain, fast = both(lambda: cumulative_product(from_rotation_vector(vectors)))
    assert_attitudes_agree(plain, fast)


@pytest.mark.parametrize("hold_altitude", [False, True])
@pytest.mark.parametrize("every", [2, 6])
def test_navigations_agree(every, hold_altitude):
    # Six minutes of three ships that turn and pitch, so that there are several chunks.
    latitude, interval, count = np.array([0.1, -0.8, 1.5]), 0.25, 1440
    times = interval * np.arange(count)[:, np.newaxis]
    swing = 1e-3 * np.sin(times * [1.0, 2.0, 3.0])
    angle = interval * (earth_rate(latitude)[:, np.newaxis] + swing)
    velocity = np.zeros((count, 3))
    velocity[:, 2] = interval * gravity(0.8)
    start = at_rest(latitude, [0.0, 0.1, 0.5, 1.0], [0.0, 3.1, -3.1], [0.0, 100.0, 5000.0])
    start = start._replace(velocity=np.array([5.0, -3.0, 0.5]))
    plain, fast = both(
        lambda: navigate(
            start, Increments(interval, angle, velocity), every=every, hold_altitude=hold_altitude
        )
    )
    # Rounding of positions as large as the Earth grows with the vertical's instability, and is
    # 1e-9 m; the fixed point stops where all three have settled, or one by one: at 1e-7 m.
    metres, radius = 1e-6, 6.4e6
    for name, one, other in zip(plain._fields, plain, fast, strict=True):
        assert one.shape == other.shape
        size = {"altitude": metres, "velocity": metres}.get(name, metres / radius / np.cos(1.5))
        np.testing.assert_allclose(other, one, rtol=0, atol=size, err_msg=name)


@pytest.mark.filterwarnings("ignore::driftlab.checks.UnusualWarning")  # it falls freely
def test_a_fall_into_the_earth_is_refused_in_the_same_words():
    falling = Increments(10.0, np.zeros((200, 3)), np.zeros((200, 3)))
    messages = []
    for on in (False, True):
        use_compiled(on)
        with pytest.raises(ValueError, match=r"^position: expected at least 6\.2e\+06 m") as told:
            navigate(at_rest(0.5, [0, 0, 0, 1]), falling)
        messages.append(str(told.value))
    assert messages[0] == messages[1]


@pytest.mark.parametrize("lead", [(), (1,), (4,), (2, 3)])
def test_filter_steps_agree(lead):
    rng = np.random.default_rng(4)
    roots = rng.normal(size=(*lead, 27, 27))
    covariance, noise = roots @ roots.mT, np.eye(6)
    transition, observation = rng.normal(size=(6, 27)), rng.normal(size=(3, 27))
    seen = rng.normal(size=(*lead, 3))

    def step():
        predicted = loops.predict(covariance, transition, noise)
        return predicted, *loops.correct(predicted, seen, observation, np.eye(3))

    numpys, compileds = both(step)
    for plain, fast in zip(numpys, compileds, strict=True):
        assert plain.shape == fast.shape
        # Sums of 27 products, one after the other or in pieces, of matrices of condition 1e4.
        scale = np.abs(plain).max()
        np.testing.assert_allclose(fast, plain, rtol=0, atol=1e4 * 27 * EPS * scale)
    assert (compileds[2] == compileds[2].mT).all()


def test_many_innovations_may_meet_one_covariance():
    rng = np.random.default_rng(6)
    covariance, observation = np.diag([1.0, 2, 3, 4]), rng.normal(size=(2, 4))
    seen = rng.normal(size=(5, 2))
    found = both(lambda: loops.correct(covariance, seen, observation, np.eye(2)))
    for plain, fast in zip(*found, strict=True):
        assert plain.shape == fast.shape
        np.testing.assert_allclose(fast, plain, rtol=1e-13, atol=1e-15)


def test_one_innovation_may_meet_many_covariances():
    rng = np.random.default_rng(7)
    covariance = np.arange(1.0, 6)[:, np.newaxis, np.newaxis] * np.diag([1.0, 2, 3, 4])
    observation, seen = rng.normal(size=(2, 4)), rng.normal(size=2)
    found = both(lambda: loops.correct(covariance, seen, observation, np.eye(2)))
    for plain, fast in zip(*found, strict=True):
        assert plain.shape == fast.shape
        np.testing.assert_allclose(fast, plain, rtol=1e-13, atol=1e-15)


def test_an_innovation_without_covariance_is_refused_either_way():
    nothing, one_row = np.zeros((3, 3)), np.eye(1, 3)
    for on in (False, True):
        use_compiled(on)
        with pytest.raises(np.linalg.LinAlgError, match="Singular matrix"):
            loops.correct_covariance(nothing, one_row, np.zeros((1, 1)))


def test_the_largest_pivot_is_taken():
    # Without exchange of rows the first pivot would be zero.
    noise = np.array([[0.0, 2.0, 0.0], [2.0, 0.0, 1.0], [0.0, 1.0, 5.0]])
    plain, fast = both(lambda: loops.correct_covariance(np.zeros((4, 4)), np.eye(3, 4), noise)[2])
    np.testing.assert_allclose(fast, plain, rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose(fast @ noise, np.eye(3), atol=1e-15)


@pytest.mark.parametrize("runs", [None, 3])
def test_whole_calibrations_agree(runs):
    trial = TableTrial(Scheme("+90X +180Z -90Y", dwell=60.0), sample_interval=0.1)
    plain, fast = both(lambda: trial.run(5, runs))
    deviations = plain.calibration.deviations
    difference = np.abs(fast.calibration.state - plain.calibration.state)
    assert (difference <= 1e-6 * deviations).all()
    np.testing.assert_allclose(fast.calibration.deviations, deviations, rtol=1e-9)


def test_processes_that_are_started_later_compile_too():
    code = "from driftlab.core import loops; print(loops.on)"
    for on in (True, False):
        use_compiled(on)
        asked = [sys.executable, "-c", code]
        found = subprocess.run(asked, capture_output=True, text=True, check=True, env=os.environ)
        assert found.stdout.strip() == str(on)
    assert loops.on is False
