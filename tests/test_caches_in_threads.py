"""What is kept between calls is the same for threads that ask for it at once."""

import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from importlib import import_module
from pkgutil import walk_packages
from threading import Barrier
from typing import Any

import numpy as np
import pytest

import driftlab
from driftlab.allan import allan_deviation
from driftlab.attitude import integrate
from driftlab.axes import convert_vectors
from driftlab.calibration import ERROR_MODELS, DesignTask
from driftlab.gyrocompass import Gyrocompass, align_in_inertial_frame, marine_type_test
from driftlab.monte_carlo import run_batches
from driftlab.motion import static_trajectory
from driftlab.noise_terms import fit_noise_terms
from fuzz_rules import leaves

THREADS = 8
# Whether Numba can be loaded, which `test_compiled` asks.
APART = {"driftlab.core.loops"}
NEED_NUMBA = "driftlab.core.compiled", "driftlab.core.kernels"


@cache
def caches() -> dict[str, Any]:
    """Every function outside the book that keeps what it has returned."""
    found = {}
    for module in walk_packages(driftlab.__path__, "driftlab."):
        if module.name.startswith(("driftlab.book", *NEED_NUMBA)):
            continue
        for name, thing in vars(import_module(module.name)).items():
            if hasattr(thing, "cache_clear") and thing.__module__ == module.name:
                found[f"{module.name}.{name}"] = thing
    return {name: each for name, each in found.items() if each.__module__ not in APART}


INCREMENTS = np.random.default_rng(3).uniform(-0.1, 0.1, (24, 3))
STILL = static_trajectory([0.0, 0.0, 0.0, 1.0], 0.9, interval=0.5, count=400).increments
NOISE = allan_deviation(np.random.default_rng(1).normal(size=400), 0.1)
TASK = DesignTask(angles=(180,), duration=400.0)


def one_run(rng: np.random.Generator, runs: int) -> np.ndarray:
    return rng.standard_normal(runs)


CALLS: dict[str, Callable[[], Any]] = {
    "axes": lambda: convert_vectors(INCREMENTS, from_axes="NED", to_axes="ENU"),
    "windows": lambda: integrate(INCREMENTS, "functional-iteration"),
    "noise": lambda: fit_noise_terms(NOISE),
    "rest": lambda: align_in_inertial_frame(STILL, 0.9),
    "model": lambda: ERROR_MODELS["averaged"].with_states("lever arms", "time skew").names,
    "scheme": lambda: TASK.value(TASK.random_schemes(1, 1)[0]),
    "ways": lambda: marine_type_test(Gyrocompass(), 0.9, starts=2),
}


@pytest.fixture
def hasty_threads():
    """Threads that take turns as often as they can."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def at_once(call: Callable[[], Any]) -> list[Any]:
    """Answers of a call that several threads make with nothing kept yet."""
    for kept in caches().values():
        kept.cache_clear()
    start = Barrier(THREADS, timeout=60)

    def made(_: int) -> Any:
        start.wait()
        return call()

    with ThreadPoolExecutor(THREADS) as threads:
        return list(threads.map(made, range(THREADS)))


@pytest.mark.parametrize("name", CALLS)
def test_threads_find_the_same(name, hasty_threads):
    alone = list(leaves(CALLS[name]()))
    assert alone
    for answer in at_once(CALLS[name]):
        for (place, one), (_, other) in zip(alone, leaves(answer), strict=True):
            if np.asarray(one).dtype.kind == "f":
                # With NumPy 2.0 the last digits depend on where in memory an array lies.
                np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-15, err_msg=place)
            else:
                np.testing.assert_array_equal(one, other, err_msg=place)


def test_every_cache_is_filled_by_these_calls():
    for kept in caches().values():
        kept.cache_clear()
    for call in CALLS.values():
        call()
    run_batches(one_run, 4, seed=1)
    empty = {name for name, kept in caches().items() if not kept.cache_info().currsize}
    assert not empty
    assert len(caches()) > 6
