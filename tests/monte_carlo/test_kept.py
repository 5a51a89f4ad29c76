"""Finished batches on a disk: whoever is killed, whenever, nothing is lost or counted twice."""

import json
import os
import pickle
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from driftlab.monte_carlo import running_on, sweep

STUDY = '''
import os, sys, time
from pathlib import Path

from driftlab.monte_carlo import processes, sweep

LOG = Path(__file__).with_name("log")


def task(rng, runs):
    """Some numbers, after a moment; and a line in a log, which no kill tears."""
    numbers = rng.standard_normal((runs, 3))
    time.sleep(0.01)
    with open(LOG, "a") as log:
        log.write(f"{numbers[0, 0]}\\n")
    return numbers


if __name__ == "__main__":
    folder = Path(__file__).with_name("kept")
    if sys.argv[1] == "here":
        sweep(task, 120, seed=9, batch=3, folder=folder)
    else:
        with processes(2) as pool:
            sweep(task, 120, seed=9, batch=3, folder=folder, executor=pool)
'''


def draws(rng, runs):
    return rng.standard_normal((runs, 3))


class Counted:
    """How often `counted` was called; no part of the task, which is told by its name."""

    calls = 0


def counted(rng, runs):
    Counted.calls += 1
    return rng.standard_normal((runs, 3))


def calls_of(*arguments, **settings):
    Counted.calls = 0
    results = sweep(counted, *arguments, **settings)
    return Counted.calls, results


def batches(folder: Path) -> list[Path]:
    return sorted(folder.glob("*/*.batch"))


def test_what_was_kept_is_not_made_again(tmp_path):
    expected = sweep(counted, 10, seed=1, batch=3)
    first, found = calls_of(10, seed=1, batch=3, folder=tmp_path)
    written = [path.stat().st_mtime_ns for path in batches(tmp_path)]
    again, known = calls_of(10, seed=1, batch=3, folder=tmp_path)
    assert [path.stat().st_mtime_ns for path in batches(tmp_path)] == written
    assert (first, again) == (4, 0)
    for results in (found, known):
        np.testing.assert_array_equal(np.concatenate(results), np.concatenate(expected))
    (study,) = tmp_path.glob("*/study.json")
    told = json.loads(study.read_text("utf-8"))
    assert told["task"].endswith("test_kept.counted")
    assert (told["seed"], told["batch"]) == (1, 3)


def test_more_runs_go_on_from_those_that_were_kept(tmp_path):
    """A batch that was cut short is another one: its runs come again with the rest."""
    calls_of(10, seed=1, batch=3, folder=tmp_path)
    calls, found = calls_of(20, seed=1, batch=3, folder=tmp_path)
    assert calls == 4  # of seven, three whole ones were there
    np.testing.assert_array_equal(
        np.concatenate(found), np.concatenate(sweep(counted, 20, seed=1, batch=3))
    )


@pytest.mark.parametrize("changed", [{"seed": 2}, {"batch": 2}])
def test_another_study_takes_nothing_of_it(changed, tmp_path):
    settings = {"seed": 1, "batch": 3}
    calls_of(10, **settings, folder=tmp_path)
    calls, _ = calls_of(10, **(settings | changed), folder=tmp_path)
    assert calls > 0
    assert len(list(tmp_path.iterdir())) == 2
    assert sweep(draws, 3, seed=1, batch=3, folder=tmp_path)
    assert len(list(tmp_path.iterdir())) == 3


def test_other_code_takes_nothing_of_it(tmp_path, monkeypatch):
    calls_of(10, seed=1, batch=3, folder=tmp_path)
    monkeypatch.setattr("driftlab.monte_carlo._code._package", lambda: "another")
    assert calls_of(10, seed=1, batch=3, folder=tmp_path)[0] == 4


def test_what_numba_compiled_is_not_taken_for_what_numpy_computes(tmp_path, monkeypatch):
    calls_of(10, seed=1, batch=3, folder=tmp_path)
    monkeypatch.setattr("driftlab.core.loops.arithmetic", lambda: "Numba 9.9")
    assert calls_of(10, seed=1, batch=3, folder=tmp_path)[0] == 4
    told = {
        json.loads(study.read_text("utf-8"))["arithmetic"] for study in tmp_path.glob("*/*.json")
    }
    assert told == {"NumPy", "Numba 9.9"}


@pytest.mark.parametrize("damage", [b"", b"short", bytes(200)])
def test_a_damaged_file_is_made_anew(damage, tmp_path):
    _, expected = calls_of(10, seed=1, batch=3, folder=tmp_path)
    whole = batches(tmp_path)[1].read_bytes()
    for harm in (damage, whole[:-1], whole[:40] + b"?" + whole[41:]):
        batches(tmp_path)[1].write_bytes(harm)
        calls, found = calls_of(10, seed=1, batch=3, folder=tmp_path)
        assert calls == 1
        np.testing.assert_array_equal(np.concatenate(found), np.concatenate(expected))
        assert batches(tmp_path)[1].read_bytes() == whole


def test_none_is_a_result_like_others(tmp_path):
    assert sweep(nothing, 4, seed=1, batch=2, folder=tmp_path) == [None, None]
    assert len(batches(tmp_path)) == 2
    assert sweep(nothing, 4, seed=1, batch=2, folder=tmp_path) == [None, None]


def nothing(rng, runs):
    return None


def test_a_failure_keeps_what_was_done(tmp_path):
    def stop(size):
        if len(batches(tmp_path)) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(counted, 10, seed=1, batch=3, folder=tmp_path, progress=stop)
    reported = []
    Counted.calls = 0
    sweep(counted, 10, seed=1, batch=3, folder=tmp_path, progress=reported.append)
    assert Counted.calls == 2
    assert reported == [3, 3, 3, 1]  # those that were there count at once


def test_two_at_once_share_a_folder(tmp_path):
    def run(_):
        return np.concatenate(sweep(draws, 60, seed=1, batch=2, folder=tmp_path))

    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(run, range(4)))
    assert len(batches(tmp_path)) == 30
    assert not list(tmp_path.glob("*/*.part"))
    for each in found:
        np.testing.assert_array_equal(each, np.concatenate(sweep(draws, 60, seed=1, batch=2)))


def test_a_block_may_say_the_folder(tmp_path):
    with running_on(folder=tmp_path / "of the block"):
        sweep(draws, 4, seed=1, batch=2)
        sweep(draws, 4, seed=1, batch=2, folder=tmp_path / "own")
    assert len(batches(tmp_path / "of the block")) == len(batches(tmp_path / "own")) == 2


def test_a_folder_that_is_none_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # where an empty path would lead to
    taken = tmp_path / "file"
    taken.write_text("mine")
    with pytest.raises(ValueError, match=r"^folder: expected one to write in, got .*file"):
        sweep(draws, 4, seed=1, folder=taken)
    assert taken.read_text() == "mine"
    with pytest.raises(ValueError, match=r"^folder: expected a path, got ''"):
        sweep(draws, 4, seed=1, folder="")
    with pytest.raises(ValueError, match=r"^task: expected, to be kept, functions .*<lambda>"):
        sweep(lambda rng, runs: runs, 4, seed=1, folder=tmp_path)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there a process cannot be killed like this")
@pytest.mark.parametrize("where", ["here", "in processes"])
def test_killed_at_any_moment_and_started_again_it_is_the_same(where, tmp_path):
    script = tmp_path / "study.py"
    script.write_text(STUDY)
    rng = np.random.default_rng(4)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    command = [sys.executable, str(script), where]
    kills = 0
    for _ in range(4):
        done = len(batches(tmp_path / "kept"))
        process = subprocess.Popen(command, env=environment, start_new_session=True)
        patience = time.monotonic() + 30
        while process.poll() is None and len(batches(tmp_path / "kept")) == done:
            assert time.monotonic() < patience  # it has begun when there is one batch more
            time.sleep(0.002)
        time.sleep(rng.uniform(0, 0.06))
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            kills += 1
        process.wait()
    assert kills >= 2
    before = len(batches(tmp_path / "kept"))
    assert before > 0
    logged = len((tmp_path / "log").read_text().splitlines())
    subprocess.run(command, env=environment, check=True)
    assert len((tmp_path / "log").read_text().splitlines()) - logged == 40 - before
    sys.path.insert(0, str(tmp_path))
    try:
        import study

        found = sweep(study.task, 120, seed=9, batch=3)
    finally:
        sys.path.remove(str(tmp_path))
        del sys.modules["study"]
    kept = [pickle.loads(path.read_bytes()[32:]) for path in batches(tmp_path / "kept")]
    np.testing.assert_array_equal(np.concatenate(kept), np.concatenate(found))
