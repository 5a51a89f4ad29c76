"""Processes of this computer: as many as asked, one thread each, none in a browser."""

import os
import signal
import subprocess
import sys
from concurrent.futures import BrokenExecutor
from contextlib import suppress
from select import select

import pytest

from driftlab.core import loops
from driftlab.monte_carlo import cluster, processes, sweep
from driftlab.monte_carlo.sweeps import _call
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


AT_WORK = """
import os, time
from driftlab.monte_carlo import processes, sweep

def task(rng, runs):
    os.write(1, b"begun")
    time.sleep(600)

if __name__ == "__main__":
    with processes(2) as pool:
        sweep(task, 2, seed=1, batch=1, executor=pool)
"""


ARITHMETIC = "__import__('driftlab.core.loops').core.loops.arithmetic()"


def test_they_compile_if_the_process_that_sends_the_runs_does(monkeypatch):
    pytest.importorskip("numba")
    monkeypatch.setenv(loops.VARIABLE, "0")
    with processes(1) as pool:
        for on in (False, True, False):
            monkeypatch.setattr(loops, "on", on)
            # What `sweep` sends; a process finds no function of this module.
            told = pool.submit(_call, on, eval, ARITHMETIC, {}).result()
            assert told == loops.arithmetic()
            assert told.startswith("Numba") == on


class Lost:
    """A task that ends the process which it reaches."""

    def __call__(self, rng, runs):
        raise AssertionError

    def __reduce__(self):
        return os._exit, (1,)


def test_where_a_process_is_lost_a_note_says_what_may_be_missing():
    with pytest.raises(BrokenExecutor) as lost, processes(1) as pool:
        sweep(Lost(), 1, seed=0, executor=pool)
    assert "below if __name__ == '__main__':" in lost.value.__notes__[0]


NOT_SENT = """
from driftlab.monte_carlo import processes, sweep
def task(rng, runs):
    return 1
with processes(1) as pool:
    try:
        sweep(task, 2, seed=1, executor=pool)
    except ValueError as error:
        print(error)
"""


def test_a_task_that_was_typed_is_refused_before_it_is_sent():
    done = subprocess.run(
        [sys.executable, "-c", NOT_SENT],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
    )
    assert done.stdout.startswith("task: expected, for other processes, a function of a module")
    assert done.stdout.endswith("task of a notebook or prompt\n")
    assert done.stderr == ""


@pytest.mark.skipif(sys.platform == "win32", reason="there a process cannot be killed like this")
@pytest.mark.parametrize("how", ["SIGTERM", "SIGKILL"])  # Windows has no SIGKILL to name
def test_they_end_with_the_process_that_started_them_even_where_it_is_killed(how, tmp_path):
    """All of them hold the standard output; when it ends, none of them lives any more."""
    script = tmp_path / "study.py"
    script.write_text(AT_WORK)
    process = subprocess.Popen(
        [sys.executable, str(script)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        stdout=subprocess.PIPE,
        start_new_session=True,
    )
    try:
        assert process.stdout.read(10) == b"begunbegun"
        process.send_signal(getattr(signal, how))
        assert select([process.stdout], [], [], 20)[0]
        assert process.stdout.read() == b""
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        process.stdout.close()


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
