"""Many runs: the same on any executor, in any order."""

import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from threading import Timer

import numpy as np
import pytest
from hypothesis import given, strategies as st

from driftlab.calibration.simulation import TableTrial
from driftlab.core import loops
from driftlab.monte_carlo import processes, running_on, sweep, sweeps
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme


def draws(rng, runs):
    """A row of numbers for each run; at the top of the module, so that processes find it."""
    return rng.standard_normal((runs, 3))


def at_leisure(rng, runs):
    """Takes longer for larger numbers, so that batches end in an order of their own."""
    numbers = rng.random(runs)
    time.sleep(0.02 * numbers[0])
    return numbers


class Shelf(Executor):
    """Keeps tasks until there are `count`, then does those of `order`: all, the last first."""

    def __init__(self, count, order=None):
        self.count, self.order = count, order or range(count - 1, -1, -1)
        self.futures, self.tasks = [], []

    def submit(self, function, /, *arguments):
        self.futures.append(Future())
        self.tasks.append((function, arguments))
        if len(self.tasks) == self.count:
            for k in self.order:
                function, arguments = self.tasks[k]
                try:
                    self.futures[k].set_result(function(*arguments))
                except BaseException as error:
                    self.futures[k].set_exception(error)
            # Who waits for the others waits in vain, but not for ever.
            patience = Timer(20, self.give_up)
            patience.daemon = True
            patience.start()
        return self.futures[-1]

    def give_up(self):
        for future in self.futures:
            if not future.done():
                future.set_exception(TimeoutError())


# Runs, batches, seeds


@given(runs=st.integers(1, 60), batch=st.integers(1, 70), seed=st.integers(0, 2**64))
def test_batches_add_up(runs, batch, seed):
    sizes = []
    results = sweep(lambda rng, size: sizes.append(size) or size, runs, seed=seed, batch=batch)
    assert results == sizes
    assert sum(sizes) == runs
    assert set(sizes[:-1]) <= {batch}
    assert 1 <= sizes[-1] <= batch


def test_batches_are_of_ten_if_not_said():
    assert sweep(lambda rng, size: size, 25, seed=0) == [10, 10, 5]


def test_each_batch_has_a_generator_of_its_own_from_the_seed():
    children = np.random.SeedSequence(42).spawn(3)
    expected = [
        np.random.default_rng(child).standard_normal((size, 3))
        for child, size in zip(children, (4, 4, 2), strict=True)
    ]
    for one, other in zip(sweep(draws, 10, seed=42, batch=4), expected, strict=True):
        np.testing.assert_array_equal(one, other)
    # No two batches, and no two seeds, draw the same.
    several = np.concatenate([*expected, *sweep(draws, 10, seed=43, batch=4)])
    assert len(np.unique(several)) == several.size


def test_first_batches_do_not_depend_on_the_number_of_runs():
    few, many = sweep(draws, 8, seed=3, batch=4), sweep(draws, 30, seed=3, batch=4)
    for one, other in zip(few, many, strict=False):
        np.testing.assert_array_equal(one, other)


# Executors


def test_executor_changes_nothing():
    expected = sweep(at_leisure, 23, seed=5, batch=2)
    assert len(expected) == 12
    with ThreadPoolExecutor(4) as threads:
        found = sweep(at_leisure, 23, seed=5, batch=2, executor=threads)
    backwards = sweep(at_leisure, 23, seed=5, batch=2, executor=Shelf(12))
    for results in (found, backwards):
        assert len(results) == 12
        for one, other in zip(results, expected, strict=True):
            np.testing.assert_array_equal(one, other)


def test_trials_in_processes_are_those_of_this_one():
    """The method of a trial is found by other processes, and its result finds back."""
    scheme = Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=3.0)
    trial = TableTrial(scheme, sample_interval=0.5, update_interval=3.0)
    expected = sweep(trial.run, 3, seed=1, batch=2)
    with processes(1) as pool:
        found = sweep(trial.run, 3, seed=1, batch=2, executor=pool)
    assert [len(trial.errors) for trial in found] == [2, 1]
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one.errors, other.errors)
        np.testing.assert_array_equal(one.nees, other.nees)
        np.testing.assert_array_equal(one.calibration.covariance, other.calibration.covariance)
        np.testing.assert_array_equal(one.imu_errors.gyro_error, other.imu_errors.gyro_error)


def test_a_sweep_that_names_no_executor_runs_where_the_block_says():
    expected = sweep(draws, 10, seed=5, batch=2)
    shelf, own = Shelf(5), Shelf(5)
    with running_on(shelf):
        found = sweep(draws, 10, seed=5, batch=2)
        with running_on():
            here = sweep(draws, 10, seed=5, batch=2)
        sweep(draws, 10, seed=5, batch=2, executor=own)
    after = sweep(draws, 10, seed=5, batch=2)
    assert (len(shelf.futures), len(own.futures)) == (5, 5)
    for results in (found, here, after):
        np.testing.assert_array_equal(np.concatenate(results), np.concatenate(expected))


def test_what_is_no_executor_is_refused():
    with (
        pytest.raises(ValueError, match=r"^executor: expected an Executor, got 4\.$"),
        running_on(4),
    ):
        raise AssertionError


# Progress


@pytest.mark.parametrize("executor", [None, "threads", "shelf"])
def test_progress_is_reported_after_each_batch(executor):
    sizes = []
    executors = {None: None, "threads": ThreadPoolExecutor(2), "shelf": Shelf(3)}
    chosen = executors[executor]
    sweep(draws, 25, seed=0, batch=10, executor=chosen, progress=sizes.append)
    executors["threads"].shutdown()
    # In the order in which they end; two of ten runs and one of five.
    assert Counter(sizes) == {10: 2, 5: 1}
    if executor is None:
        assert sizes == [10, 10, 5]


# Failures


class GoneWrong(Exception):
    pass


def fails(rng, runs):
    raise GoneWrong(f"with {runs} runs")


@pytest.mark.parametrize("executor", [None, "threads", "shelf"])
def test_failure_of_a_batch_comes_out(executor):
    with ThreadPoolExecutor(1) as threads:
        chosen = {None: None, "threads": threads, "shelf": Shelf(5)}[executor]
        with pytest.raises(GoneWrong, match=r"^with \d runs$"):
            sweep(fails, 9, seed=0, batch=2, executor=chosen)


def test_failure_leaves_no_batch_waiting():
    shelf = Shelf(5, order=[1])
    with pytest.raises(GoneWrong):
        sweep(fails, 10, seed=0, batch=2, executor=shelf)
    assert [future.cancelled() for future in shelf.futures] == [True, False, True, True, True]


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, GoneWrong])
def test_interruption_between_two_batches_leaves_none_waiting(interruption):
    """As from the stop button of a notebook, while the bar is drawn."""

    def progress(size):
        raise interruption

    shelf = Shelf(4, order=[2])
    with pytest.raises(interruption):
        sweep(draws, 8, seed=0, batch=2, executor=shelf, progress=progress)
    assert [future.cancelled() for future in shelf.futures] == [True, True, False, True]


def test_failure_here_stops_at_once():
    calls = []

    def task(rng, runs):
        calls.append(runs)
        if len(calls) == 2:
            raise GoneWrong
        return runs

    ended = []
    with pytest.raises(GoneWrong):
        sweep(task, 10, seed=0, batch=2, progress=ended.append)
    assert calls == [2, 2]
    assert ended == [2]


@pytest.mark.parametrize(
    ("name", "bad", "least"),
    [
        ("runs", 0, 1),
        ("runs", -3, 1),
        ("runs", 2.0, 1),
        ("batch", 0, 1),
        ("batch", 2.5, 1),
        ("seed", -1, 0),
        ("seed", 1.0, 0),
        ("seed", None, 0),
        ("seed", True, 0),
    ],
)
def test_numbers_that_make_no_sense_are_refused_by_name(name, bad, least):
    def never(rng, runs):
        raise AssertionError

    arguments = {"runs": 5, "seed": 0, "batch": 2} | {name: bad}
    with pytest.raises(
        ValueError, match=rf"^{name}: expected a whole number of at least {least}, got {bad!r}\.$"
    ):
        sweep(never, **arguments)


@pytest.mark.parametrize("here", [False, True])
def test_a_run_is_compiled_where_it_goes_if_it_would_be_where_it_comes_from(here, monkeypatch):
    switched = []
    monkeypatch.setattr(sweeps, "use_compiled", switched.append)
    monkeypatch.setattr(loops, "on", here)
    for there in (False, True):
        assert sweeps._call(there, draws, np.random.default_rng(1), 2).shape == (2, 3)
    assert switched == [not here]


def test_what_other_processes_cannot_be_given_is_refused_in_a_sentence():
    def within(rng, runs):
        return runs

    with processes(1) as pool:
        for task in (within, lambda rng, runs: runs):
            with pytest.raises(ValueError, match=r"^task: expected, for other processes, a func"):
                sweep(task, 4, seed=1, executor=pool)


def test_without_processes_of_its_own_python_is_asked_for_none(monkeypatch):
    """As in a browser, where the module of the pool cannot be imported."""
    monkeypatch.setattr(sys, "platform", "emscripten")
    monkeypatch.setitem(sys.modules, "concurrent.futures.process", None)
    with ThreadPoolExecutor(2) as threads:
        assert sweep(lambda rng, runs: runs, 25, seed=1, executor=threads) == [10, 10, 5]
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT],
        env={"PYTHONPATH": ":".join(filter(None, sys.path))},
        capture_output=True,
        text=True,
    )
    assert (done.stdout, done.stderr) == ("[10, 10, 5]\n", "")


WITHOUT = """
import sys
sys.modules["concurrent.futures.process"] = sys.modules["_multiprocessing"] = None
from driftlab.monte_carlo import sweep
print(sweep(lambda rng, runs: runs, 25, seed=1))
"""
