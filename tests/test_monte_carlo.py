"""Monte Carlo runs: the same on any number of workers, and finished batches are never lost."""

import os
import subprocess
import sys
from collections import Counter
from functools import partial
from hashlib import sha256
from typing import Any

import joblib
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from joblib.externals.loky import get_reusable_executor
from scipy.stats import chi2

from driftlab import monte_carlo
from driftlab.calibration.simulation import TurntableTrial
from driftlab.monte_carlo import FOLDER, mean_square_bounds, run_batches
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme
from support import ROOT

SHORT = Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=3.0)


@pytest.fixture(autouse=True, scope="module")
def workers_that_find_the_tests():
    """Processes that another test has left may have started where no ``tests`` is in sight."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(ROOT)
        get_reusable_executor().shutdown(kill_workers=True)
        yield
        get_reusable_executor().shutdown(kill_workers=True)


class Counted:
    """How often `draws` was called in this process."""

    calls = 0


def draws(rng, size, scale=1.0):
    Counted.calls += 1
    return scale * rng.standard_normal((size, 3))


def same(found, expected):
    assert len(found) == len(expected)
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one, other)


def calls_of(task=draws, runs=10, seed=1, batch_size=3, **settings):
    Counted.calls = 0
    found = run_batches(task, runs, seed=seed, batch_size=batch_size, **settings)
    return Counted.calls, found


@settings(max_examples=15)
@given(runs=st.integers(1, 60), batch=st.integers(1, 70), seed=st.integers(0, 2**64))
def test_batches_add_up(runs, batch, seed):
    sizes = run_batches(lambda rng, size: size, runs, seed=seed, batch_size=batch)
    assert sum(sizes) == runs
    assert set(sizes[:-1]) <= {batch}
    assert 1 <= sizes[-1] <= batch


def test_each_batch_has_a_generator_spawned_from_the_seed():
    children = np.random.SeedSequence(42).spawn(3)
    expected = [
        np.random.default_rng(child).standard_normal((size, 3))
        for child, size in zip(children, (4, 4, 2), strict=True)
    ]
    same(run_batches(draws, 10, seed=42, batch_size=4), expected)
    several = np.concatenate([*expected, *run_batches(draws, 10, seed=43, batch_size=4)])
    assert len(np.unique(several)) == several.size
    same(run_batches(draws, 30, seed=42, batch_size=4)[:2], expected[:2])


def test_workers_change_nothing():
    expected = calls_of(runs=23)[1]
    for workers in (2, -1):
        same(calls_of(runs=23, workers=workers)[1], expected)
    for backend in ("threading", "loky"):
        with joblib.parallel_config(backend, n_jobs=2):
            same(calls_of(runs=23)[1], expected)


def test_trials_in_processes_are_those_of_this_one():
    trial = TurntableTrial(SHORT, sample_interval=0.5, update_interval=3.0)
    expected = run_batches(trial.run, 3, seed=1, batch_size=2)
    found = run_batches(trial.run, 3, seed=1, batch_size=2, workers=2)
    for one, other in zip(found, expected, strict=True):
        # A worker has one thread for matrices; sums in another order round differently.
        np.testing.assert_allclose(one.errors, other.errors, rtol=1e-9, atol=1e-15)
        np.testing.assert_array_equal(
            one.imu_errors.gyro_error_matrix, other.imu_errors.gyro_error_matrix
        )


def test_workers_have_one_thread_each():
    def threads(rng, size):
        return os.environ["OPENBLAS_NUM_THREADS"], os.environ["OMP_NUM_THREADS"]

    assert run_batches(threads, 2, seed=0, batch_size=1, workers=2) == [("1", "1")] * 2


@pytest.mark.parametrize("workers", [1, 2])
def test_progress_and_failures_come_out(workers):
    sizes = []
    run_batches(draws, 25, seed=0, workers=workers, progress=sizes.append)
    assert Counter(sizes) == {10: 2, 5: 1}
    with pytest.raises(ZeroDivisionError):
        run_batches(lambda rng, size: 1 / 0, 9, seed=0, batch_size=2, workers=workers)


@pytest.mark.parametrize("workers", [1, pytest.param(2, marks=pytest.mark.long)])
def test_an_interruption_keeps_what_was_done(workers, tmp_path):
    def stop(size):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        calls_of(folder=tmp_path, workers=workers, progress=stop)
    done = len(list(tmp_path.glob("*/*.batch")))
    assert done >= 1
    reported = []
    calls, found = calls_of(folder=tmp_path, progress=reported.append)
    assert calls == 4 - done
    assert sorted(reported) == [1, 3, 3, 3]
    same(found, calls_of()[1])


def test_only_the_same_study_is_read_again(tmp_path):
    assert calls_of(folder=tmp_path)[0] == 4
    calls, found = calls_of(folder=tmp_path)
    assert calls == 0
    same(found, calls_of()[1])
    calls, found = calls_of(runs=20, folder=tmp_path)
    assert calls == 4  # of seven, three whole ones were there
    same(found, calls_of(runs=20)[1])
    for other in ({"seed": 2}, {"batch_size": 2}, {"task": partial(draws, scale=2.0)}):
        assert calls_of(**other, folder=tmp_path)[0] > 0


def test_the_folder_may_come_from_the_environment(tmp_path, monkeypatch):
    monkeypatch.setenv(FOLDER, str(tmp_path))
    assert [calls_of()[0], calls_of()[0]] == [4, 0]


@pytest.mark.parametrize("name", ["driftlab.__version__", "driftlab.core.loops.arithmetic"])
def test_another_version_is_made_again(name, tmp_path, monkeypatch):
    calls_of(folder=tmp_path)
    monkeypatch.setattr(name, "9.9" if name.endswith("_") else lambda: "9.9")
    assert calls_of(folder=tmp_path)[0] == 4


STUDY = """
import os, signal
from pathlib import Path
from driftlab.monte_carlo import run_batches
HERE = Path(__file__).parent
def task(rng, size):
    with open(HERE / "log", "a") as log:
        log.write("x")
    number = rng.random()
    if {dies} and len((HERE / "log").read_text()) > 4:
        os.{kill}
    return {factor} * number
if __name__ == "__main__":
    print(run_batches(task, 8, seed=1, batch_size=1, workers={workers}, folder=HERE / "kept"))
"""


def study(folder, factor=1, workers=1):
    """Print of a script and how many batches it made."""
    script, log = folder / "study.py", folder / "log"
    script.write_text(STUDY.format(dies=False, factor=factor, workers=workers, kill="_exit(1)"))
    log.write_text("")
    done = subprocess.run(
        [sys.executable, str(script)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout, len(log.read_text())


@pytest.mark.parametrize(
    ("workers", "kill"),
    [
        pytest.param(1, "_exit(1)", marks=pytest.mark.long),
        (2, "kill(os.getpid(), signal.SIGKILL)"),
    ],
)
@pytest.mark.skipif(sys.platform == "win32", reason="there a process cannot be killed like this")
def test_a_killed_process_loses_nothing_that_was_finished(workers, kill, tmp_path):
    expected, count = study(tmp_path)
    assert count == 8
    (tmp_path / "kept").rename(tmp_path / "first")
    # Its own end is part of the source of a task, so the task reads it from a file.
    text = STUDY.replace("{dies}", "(HERE / 'dies').exists()")
    (tmp_path / "dies").touch()
    script = text.format(factor=1, workers=workers, kill=kill)
    (tmp_path / "study.py").write_text(script)
    (tmp_path / "log").write_text("")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    command = [sys.executable, str(tmp_path / "study.py")]
    assert subprocess.run(command, env=environment, capture_output=True).returncode != 0
    kept = len(list(tmp_path.glob("kept/*/*.batch")))
    assert kept >= 3
    (tmp_path / "dies").unlink()
    (tmp_path / "log").write_text("")
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == expected
    assert len((tmp_path / "log").read_text()) == 8 - kept


def test_a_changed_task_runs_again(tmp_path):
    first, _ = study(tmp_path)
    assert study(tmp_path, workers=2) == (first, 0)  # what is outside of the task may change
    assert study(tmp_path, factor=2)[1] == 8


def test_a_damaged_file_is_made_again(tmp_path):
    _, expected = calls_of(folder=tmp_path)
    file = sorted(tmp_path.glob("*/*.batch"))[1]
    whole = file.read_bytes()
    gone = b"cnowhere\nNothing\n."  # a pickle of a class that is not there any more
    for harm in (b"", whole[:-1], whole[:40] + b"?" + whole[41:], sha256(gone).digest() + gone):
        file.write_bytes(harm)
        calls, found = calls_of(folder=tmp_path)
        assert calls == 1
        same(found, expected)
        assert file.read_bytes() == whole


def test_refusals_are_one_sentence(tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(ValueError, match=r"^folder: expected one to write in, got .*file"):
        calls_of(folder=tmp_path / "file")
    with pytest.raises(ValueError, match=r"^task: expected, to be kept, a function of a module"):
        calls_of(lambda rng, size: size, folder=tmp_path)
    with pytest.raises(ValueError, match=r"^workers: expected a number of processes, or -1"):
        calls_of(workers=0)
    typed: dict[str, Any] = {}
    exec("def task(rng, size): return size", typed)  # as in a terminal, where it may change unseen
    with pytest.raises(ValueError, match=r"^task: .* whose source can be read, got"):
        calls_of(typed["task"], folder=tmp_path)


@pytest.mark.skipif(os.name == "nt" or not hasattr(os, "geteuid"), reason="modes of POSIX")
def test_others_may_read_what_the_mask_allows(tmp_path):
    before = os.umask(0o022)
    try:
        calls_of(folder=tmp_path)
    finally:
        os.umask(before)
    assert {file.stat().st_mode & 0o777 for file in tmp_path.glob("*/*")} == {0o644}


def test_a_failed_write_leaves_nothing(tmp_path, monkeypatch):
    def full(number):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        calls_of(folder=tmp_path)
    assert not [*tmp_path.glob("*/*")]


@pytest.mark.parametrize("asked", [{"workers": 2}, {"folder": "kept"}])
def test_without_joblib_a_plain_loop_serves(asked, monkeypatch):
    monkeypatch.setitem(sys.modules, "joblib", None)
    with pytest.raises(ModuleNotFoundError, match=r"joblib is not installed; pip install drift"):
        calls_of(**asked)
    monkeypatch.delitem(sys.modules, "joblib")
    assert calls_of()[0] == 4
    assert "joblib" not in sys.modules


def test_in_a_browser_a_warning_says_that_there_is_one_process(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "platform", "emscripten")
    with pytest.warns(UserWarning, match=r"^In a browser the runs come one after the other"):
        assert calls_of(workers=2, folder=tmp_path)[0] == 4
    assert not list(tmp_path.iterdir())


def test_a_batch_is_compiled_as_where_it_was_asked_for(monkeypatch):
    monkeypatch.setattr(monte_carlo.loops, "asked", None)
    monte_carlo._batch(0, draws, np.random.SeedSequence(1), 2, None, False)
    assert monte_carlo.loops.asked is False


@given(
    degrees_of_freedom=st.integers(1, 60),
    runs=st.integers(1, 1000),
    confidence=st.floats(0.01, 0.999),
)
def test_bounds_keep_equal_tails_outside(degrees_of_freedom, runs, confidence):
    low, high = mean_square_bounds(degrees_of_freedom, runs, confidence)
    tail = (1 - confidence) / 2
    assert chi2.cdf(runs * low, degrees_of_freedom * runs) == pytest.approx(tail, rel=1e-6)
    assert chi2.sf(runs * high, degrees_of_freedom * runs) == pytest.approx(tail, rel=1e-6)


def test_bounds_are_those_of_tables():
    """Chi-square of 10 degrees: 2.5 % below 3.247 and above 20.483; 0.5 %: 2.156 and 25.188."""
    assert mean_square_bounds(10, 1) == pytest.approx((3.247, 20.483), abs=5e-4)
    assert mean_square_bounds(1, 10, 0.99) == pytest.approx((0.2156, 2.5188), abs=5e-5)
