"""Processes of this computer: as many as asked, one thread each, none in a browser."""

import os
import sys

import pytest

from driftlab.monte_carlo import cluster, processes, sweep
from driftlab.monte_carlo.workers import THREADS


def test_each_has_one_thread_and_this_process_keeps_its_own(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")  # somebody has said it
    monkeypatch.delenv("OPENBLAS_NUM_THREADS")
    before = {name: os.environ.get(name) for name in THREADS}
    with processes(1) as pool:
        found = {name: pool.submit(os.getenv, name).result() for name in THREADS}
    assert found == dict.fromkeys(THREADS, "1") | {"OMP_NUM_THREADS": "3"}
    assert {name: os.environ.get(name) for name in THREADS} == before


def test_as_many_as_there_are_cores_if_not_said():
    with processes() as pool:
        cores = getattr(os, "sched_getaffinity", lambda _: range(os.cpu_count()))(0)
        assert pool._max_workers == len(cores)


@pytest.mark.parametrize("count", [0, -1, 1.5, "two"])
def test_what_is_no_number_of_processes_is_refused(count):
    with pytest.raises(ValueError, match=r"^count: expected"), processes(count):
        raise AssertionError


def test_in_a_browser_the_runs_come_one_after_the_other_and_it_says_so(monkeypatch):
    monkeypatch.setattr(sys, "platform", "emscripten")
    with (
        pytest.warns(UserWarning, match="^In a browser the runs come one after the other") as seen,
        processes() as pool,
    ):
        assert sweep(lambda rng, runs: runs, 25, seed=1, executor=pool) == [10, 10, 5]
    assert seen[0].filename == __file__


def test_a_cluster_without_dask_is_told_in_a_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(ModuleNotFoundError, match=r"pip install driftlab\[cluster\]\.$"),
        cluster("tcp://127.0.0.1:1"),
    ):
        raise AssertionError
