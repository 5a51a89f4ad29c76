"""The loops that Numba compiles: who computes what, and that only rounding tells them apart."""

import os
import subprocess
import sys
import warnings
from pickle import UnpicklingError

import numpy as np
import pytest

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithm
from driftlab.attitude.integration import integrate
from driftlab.calibration import covariance_analysis, linearize_along
from driftlab.calibration.simulation import TurntableTrial
from driftlab.core import loops
from driftlab.earth import earth_rate, gravity
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.motion import NINETEEN_POSITIONS
from driftlab.motion.scheme import Scheme
from driftlab.quaternion import cumulative_product, from_rotation_vector
from driftlab.strapdown import navigate, stationary_state

EPS = np.finfo(float).eps
# Two samples of which the first looks back, and a window whose pairs are not in order.
OWN = (
    Algorithm("third", 2, 0, {(0, 1): 2 / 3}, "third iterate", 3),
    Algorithm("four", 4, 0, {(2, 3): 0.6, (0, 3): 0.2, (0, 1): 0.5}, "rotation vector", 4),
    Algorithm("no coning", 1, 0, {}, "rotation vector", 2),
)
ALGORITHM, TWO_STEP = (CONING_ALGORITHMS[name].steps for name in ("picard-1", "two-step-4"))
ROWS, STARTS = np.zeros((20, 3)), np.tile([0.0, 0.0, 0.0, 1.0], (20, 1))
START = stationary_state(0.5, [0.0, 0.0, 0.0, 1.0])


@pytest.fixture
def both(monkeypatch):
    """What a function returns, or the refusal that it raises, by NumPy and by Numba."""
    pytest.importorskip("numba")

    def compared(function):
        found = []
        for compiled in (False, True):
            monkeypatch.setattr(loops, "asked", compiled)
            try:
                found.append(function())
            except (ValueError, np.linalg.LinAlgError) as refusal:
                found.append((type(refusal), str(refusal)))
        return found

    return compared


def assert_attitudes_agree(plain, fast):
    # A product of n factors is rounded n times in either way, at random: a few times its root.
    tolerance = 16 * EPS * np.sqrt(plain.shape[-2])
    np.testing.assert_allclose(fast, plain, rtol=0, atol=tolerance)
    assert fast.flags.writeable


@pytest.mark.parametrize("algorithm", [*CONING_ALGORITHMS.values(), *OWN], ids=lambda one: one.name)
def test_attitudes_agree(algorithm, both):
    rng = np.random.default_rng(1)
    rows, past = rng.uniform(-1, 1, (2, 3, 60, 3)), rng.uniform(-1, 1, (5, 3))
    for size, start in ((0.0, [0, 0, 0, 1]), (1e-200, [0.6, 0, 0, 0.8]), (0.8, rng.normal(size=4))):
        for history in (None, size * past):
            assert_attitudes_agree(
                *both(lambda: integrate(size * rows, algorithm, start=start, history=history))  # noqa: B023
            )


def test_any_layout_of_increments_will_do(both):
    rows = np.random.default_rng(2).uniform(-0.1, 0.1, (3, 60, 2))
    strange = np.asfortranarray(rows).transpose(2, 1, 0)[:, ::-1]
    strange.flags.writeable = False
    for algorithm in ("two-step-4", "functional-iteration"):
        assert_attitudes_agree(*both(lambda algorithm=algorithm: integrate(strange, algorithm)))


def test_cumulative_products_agree(both):
    vectors = np.random.default_rng(3).normal(size=(2, 2, 1000, 3))
    assert_attitudes_agree(*both(lambda: cumulative_product(from_rotation_vector(vectors))))


@pytest.mark.parametrize("hold_altitude", [False, True])
@pytest.mark.parametrize("every", [2, 6])
def test_navigations_agree(every, hold_altitude, both):
    # Six minutes of three ships that turn and pitch, so that there are several chunks.
    latitude, interval, count = np.array([0.1, -0.8, 1.5]), 0.25, 1440
    times = interval * np.arange(count)[:, np.newaxis]
    swing = 1e-3 * np.sin(times * [1.0, 2.0, 3.0])
    angle = interval * (earth_rate(latitude)[:, np.newaxis] + swing)
    velocity = np.zeros((count, 3))
    velocity[:, 2] = interval * gravity(0.8)
    start = stationary_state(latitude, [0.0, 0.1, 0.5, 1.0], [0.0, 3.1, -3.1], [0.0, 100.0, 5000.0])
    start = start._replace(velocity=np.array([5.0, -3.0, 0.5]))
    record = Increments(interval, angle, velocity)
    plain, fast = both(lambda: navigate(start, record, every=every, hold_altitude=hold_altitude))
    # Rounding of positions as large as the Earth grows with the vertical's instability, and is
    # 1e-9 m; the fixed point stops where all three have settled, or one by one: at 1e-7 m.
    metres, radius = 1e-6, 6.4e6
    for name, one, other in zip(plain._fields, plain, fast, strict=True):
        assert one.shape == other.shape
        size = {"altitude": metres, "velocity": metres}.get(name, metres / radius / np.cos(1.5))
        np.testing.assert_allclose(other, one, rtol=0, atol=size, err_msg=name)


def test_calibrations_agree(both):
    trial = TurntableTrial(Scheme("+90X +180Z -90Y", dwell=60.0), sample_interval=0.1)
    plain, fast = (found.calibration for found in both(lambda: trial.run(5, 3)))
    assert (np.abs(fast.state - plain.state) <= 1e-6 * plain.standard_deviations).all()
    np.testing.assert_allclose(fast.standard_deviations, plain.standard_deviations, rtol=1e-9)


def test_covariances_agree(both):
    way = linearize_along(NINETEEN_POSITIONS, 0.7, "averaged")
    plain, fast = both(lambda: covariance_analysis(way, ImuNoise(), PriorStandardDeviations()))
    standard_deviations = np.sqrt(plain.diagonal())
    np.testing.assert_allclose(
        fast / standard_deviations,
        plain / standard_deviations,
        rtol=0,
        atol=1e-9 * standard_deviations.max(),
    )
    assert (fast == fast.T).all()


@pytest.mark.parametrize("moving", [2, 6, 9])
def test_a_filter_may_have_any_noise_and_see_any_states(moving, both):
    rng = np.random.default_rng(5)
    half, more = rng.normal(size=(9, 9)), rng.normal(size=(2, 7, moving, moving))
    transitions, observation = rng.normal(size=(7, moving, 9)), rng.normal(size=(4, 9))
    # Without exchange of rows the first pivot would be nearly zero.
    spreads = np.tile(np.diag([1e-9, 1.0, 2.0, 3.0])[::-1, ::-1], (7, 1, 1))
    given = half @ half.T, transitions, more[0] @ more[0].mT, observation, spreads
    before = given[0].copy()
    plain, fast = both(lambda: loops.covariances(*given))
    for one, other in zip(plain, fast, strict=True):
        np.testing.assert_allclose(other, one, rtol=1e-8, atol=1e-8 * np.abs(one).max())
    assert (given[0] == before).all()


@pytest.mark.filterwarnings("ignore::driftlab.checks.UnusualWarning")  # it falls freely
@pytest.mark.parametrize(
    ("call", "expected"),
    [
        (lambda: integrate(np.full((2, 4, 3), 2.0)), "increments: expected less than a whole turn"),
        (
            lambda: navigate(START, Increments(10.0, np.zeros((200, 3)), np.zeros((200, 3)))),
            "position: expected at least 6.2e+06 m",
        ),
        (
            lambda: loops.covariances(
                *(np.zeros(each) for each in ((3, 3), (1, 2, 3), (1, 2, 2))),
                np.eye(1, 3),
                np.zeros((1, 1, 1)),
            ),
            "Singular matrix",
        ),
    ],
)
def test_both_refuse_in_the_same_words(call, expected, both):
    plain, fast = both(call)
    assert plain == fast
    assert plain[1].startswith(expected)


class Named:
    """Loops that compute nothing, and say who was asked."""

    def __getattr__(self, name):
        return lambda *given, **named: f"compiled {name}"


@pytest.mark.parametrize(
    ("most", "call"),
    [
        ("LONG_ATTITUDE", lambda n: loops.attitudes(ALGORITHM, np.zeros((2, n // 2, 3)))),
        ("LONG_ATTITUDE", lambda n: loops.attitudes(ALGORITHM, ROWS[:2], 0, STARTS[: n // 2])),
        ("LONG_ATTITUDE", lambda n: loops.cumulative_product(np.tile(STARTS[0], (n, 1)))),
        ("LONG_NAVIGATION", lambda n: loops.navigate(START, ROWS[:n], ROWS[:n], 0.1, TWO_STEP)),
        (
            "LONG_NAVIGATION",
            lambda n: loops.navigate(START, ROWS[:2], ROWS[:2], 0.1, TWO_STEP, calls=n // 2),
        ),
        (
            "LONG_FILTER",
            lambda n: loops.covariances(
                np.eye(1), *[np.ones((n, 1, 1))] * 2, np.eye(1), np.ones((n, 1, 1))
            ),
        ),
    ],
)
def test_the_size_decides_unless_the_environment_does(most, call, monkeypatch):
    monkeypatch.setattr(loops, "_numba", Named)
    monkeypatch.setattr(loops, most, 12)
    for asked, of_each in ((None, [False, True]), (False, [False] * 2), (True, [True] * 2)):
        monkeypatch.setattr(loops, "asked", asked)
        assert [str(call(n)).startswith("compiled") for n in (10, 12)] == of_each


@pytest.mark.parametrize(
    ("said", "asked"),
    [(None, None), ("", None), ("0", False), ("1", True), ("yes", None)],
)
def test_what_the_environment_asks_for(said, asked, monkeypatch):
    monkeypatch.delenv(loops.VARIABLE, raising=False)
    if said is not None:
        monkeypatch.setenv(loops.VARIABLE, said)
    if said == "yes":
        with pytest.warns(UserWarning, match=r"^DRIFTLAB_COMPILED: expected 0 or 1, got 'yes'"):
            assert loops._asked() is asked
    else:
        assert loops._asked() is asked


@pytest.mark.parametrize("asked", [None, True])
def test_a_numba_that_cannot_be_loaded_is_done_without(asked, monkeypatch):
    monkeypatch.setitem(sys.modules, "driftlab.core.compiled", None)
    monkeypatch.delattr("driftlab.core.compiled", raising=False)
    monkeypatch.setattr(loops, "asked", asked)
    monkeypatch.setattr(loops, "LONG_ATTITUDE", 2)
    loops._numba.cache_clear()
    try:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            assert integrate(ROWS).shape == (10, 4)
        assert [str(each.message)[:38] for each in told] == (
            ["DRIFTLAB_COMPILED is 1, but NumPy comp"] if asked else []
        )
    finally:
        loops._numba.cache_clear()


@pytest.mark.parametrize("error", [OSError(28, "disk full"), EOFError(), UnpicklingError("cut")])
def test_a_damaged_cache_leaves_the_rest_to_numpy(error, monkeypatch):
    class Damaged:
        def attitudes(self, *given):
            raise error

    monkeypatch.setattr(loops, "_numba", Damaged)
    monkeypatch.setattr(loops, "asked", True)
    with pytest.warns(UserWarning, match="^Numba cannot keep or read what it has compiled"):
        found = integrate(ROWS)
    assert (loops.asked, loops.arithmetic()) == (False, "NumPy")
    np.testing.assert_array_equal(found, integrate(ROWS))


def test_a_block_without_a_compiler_says_so_to_its_processes(monkeypatch):
    monkeypatch.setattr(loops, "asked", True)
    with loops.by_numpy_alone():
        assert (loops.asked, loops.arithmetic()) == (False, "NumPy")
        assert os.environ[loops.VARIABLE] == "0"
    assert loops.asked is True


@pytest.mark.long
def test_a_cache_that_cannot_be_written_or_is_shared_does_no_harm(tmp_path):
    """Of several processes at once, or where there is no place for it."""
    pytest.importorskip("numba")
    (tmp_path / "file").touch()
    code = "import numpy as np, driftlab; print(driftlab.integrate(np.ones((8, 3)) / 9)[-1])"
    shared, broken = tmp_path / "cache", tmp_path / "file" / "nowhere"
    started = []
    for cache in (shared, shared, broken):
        around = {**os.environ, loops.VARIABLE: "1", "NUMBA_CACHE_DIR": str(cache)}
        command = [sys.executable, "-W", "error", "-c", code]
        started.append(subprocess.Popen(command, env=around, text=True, stdout=subprocess.PIPE))
    said = {each.communicate(timeout=120)[0] for each in started}
    assert len(said) == 1
    assert said.pop().startswith("[")
    assert list(shared.rglob("*.nbi"))
