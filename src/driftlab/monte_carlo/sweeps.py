"""Many random runs in batches, each with a generator of its own."""

from __future__ import annotations

import json
import os
import pickle
import sys
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Executor, as_completed
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

import driftlab
from driftlab.checks import (
    checked_function,
    checked_instance,
    checked_path,
    shown,
    whole_number,
)
from driftlab.compilation import use_compiled
from driftlab.core import loops

from ._code import code_of, names_of_no_file
from ._descriptions import describe

Result = TypeVar("Result")
Task = Callable[[np.random.Generator, int], Result]


class _Place(NamedTuple):
    """Where the runs are made that say nothing of it themselves."""

    executor: Executor | None = None
    folder: Path | None = None


NOWHERE = _Place()
_place: ContextVar[_Place] = ContextVar("driftlab_sweeps", default=NOWHERE)


def running_on(
    executor: Executor | None = None, *, folder: str | Path | None = None
) -> AbstractContextManager[None]:
    """Make all sweeps in a ``with`` block on one executor, and keep them in one folder.

    So a study that names neither, as those of the book, goes to as many processors as there are.

    Parameters
    ----------
    executor : concurrent.futures.Executor, optional
    folder : str or Path, optional
        Both as for `sweep`; what is given there counts.

    Returns
    -------
    context manager

    Raises
    ------
    ValueError
        If `executor` is none, or `folder` no path.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> with ThreadPoolExecutor(2) as threads, running_on(threads):
    ...     sweep(lambda rng, runs: runs, 25, seed=1)
    [10, 10, 5]
    """
    if executor is not None:
        checked_instance(executor, Executor, "executor")
    return _running_on(_Place(executor, None if folder is None else checked_path(folder, "folder")))


@contextmanager
def _running_on(place: _Place) -> Iterator[None]:
    before = _place.set(place)
    try:
        yield
    finally:
        _place.reset(before)


def sweep(
    task: Task[Result],
    runs: int,
    *,
    seed: int,
    batch: int = 10,
    executor: Executor | None = None,
    progress: Callable[[int], object] | None = None,
    folder: str | Path | None = None,
) -> list[Result]:
    """Call ``task(rng, runs)`` for batches of runs that add up to `runs`.

    Parameters
    ----------
    task : callable
        Takes a numpy Generator and a number of runs. For a process pool it must be importable, so
        not a lambda: a method of an object whose class is in a module will do.
    runs : int
        Number of runs in all.
    seed : int
        Each batch has its own generator derived from it, so neither the executor nor the order in
        which batches finish affects the results. The size of the batches does.
    batch : int
        Number of runs in one call.
    executor : concurrent.futures.Executor, optional
        Where the calls run: `processes`, a `cluster`, threads, mpi4py's. If not given, that of
        `running_on`; without one they run here, one after the other.
    progress : callable, optional
        Called with the number of runs of each batch when it is done, as the method `update` of a
        bar of tqdm wants it.

    folder : str or Path, optional
        Where finished batches are kept, each as soon as it is done. The same call after an
        interruption, of whatever kind, takes those and makes the rest; with more runs it goes on
        from there. See the notes.

    Returns
    -------
    list
        What `task` returned, in the order of the batches.

    Raises
    ------
    ValueError
        If `runs`, `batch` or `seed` is not a whole number in its range, if `folder` is given and
        cannot be written, or `task` cannot be told from others, or if `executor` has processes of
        its own and `task` cannot be sent to them.

    Notes
    -----
    A batch is kept for its task, its seed, the size of batches and the code that the task runs:
    this package without its book, NumPy and SciPy by their versions, Numba if it compiles, the
    modules in which the functions and classes of the task stand, and those of your own that these
    import; of what stands in a notebook its code and what that names. What was kept of another
    study, or by other code of these, is never taken, so many studies may share a folder;
    ``study.json`` says which has which part of it. Not seen are other installed packages, files
    that a task reads, and a global of a module that is changed in memory: take another folder then.
    Wherever the calls run, they are compiled if they would be here.
    The task must therefore be a function of a module, a method of a dataclass, or a
    `functools.partial` of these, with numbers, texts and arrays in it.

    A file is written whole or not at all, and one that is damaged is made anew. Files are read by
    `pickle`, which runs what it reads: name no folder in which a stranger may write.

    Examples
    --------
    >>> sweep(lambda rng, runs: runs, 25, seed=1)
    [10, 10, 5]
    >>> means = sweep(lambda rng, runs: rng.standard_normal(runs).mean(), 2000, seed=1, batch=500)
    >>> np.round(means, 2)
    array([-0.03, -0.01, -0.06,  0.  ])
    """
    checked_function(task, "task", "a generator and a number of runs")
    if executor is not None:
        checked_instance(executor, Executor, "executor")
    if progress is not None:
        checked_function(progress, "progress", "a number of runs")
    total, most = whole_number(runs, "runs"), whole_number(batch, "batch")
    sizes = [min(most, total - first) for first in range(0, total, most)]
    root = whole_number(seed, "seed", least=0, most=None)
    children = np.random.SeedSequence(root).spawn(len(sizes))
    place = _place.get()
    executor = executor or place.executor
    if executor is not None and _has_processes(executor):
        _sendable(task)
    where = place.folder if folder is None else checked_path(folder, "folder")
    kept = None if where is None else _KeptBatches(where, task, root, most)
    results: list[object] = [MISSING] * len(sizes)

    def done(index: int, result: object, *, is_new: bool = True) -> None:
        if kept is not None and is_new:
            kept.write(index, sizes[index], result)
        results[index] = result
        if progress is not None:
            progress(sizes[index])

    if kept is not None:
        for index, size in enumerate(sizes):
            if (result := kept.read(index, size)) is not MISSING:
                done(index, result, is_new=False)
    left = [index for index, result in enumerate(results) if result is MISSING]
    generators = {index: np.random.default_rng(children[index]) for index in left}
    if executor is None:
        for index in left:
            done(index, task(generators[index], sizes[index]))
        return results  # type: ignore[return-value]
    compile_it = loops.on
    futures = {executor.submit(_call, compile_it, task, generators[k], sizes[k]): k for k in left}
    try:
        for future in as_completed(futures):
            done(futures[future], future.result())
    except BrokenExecutor as broken:
        broken.add_note(
            "A process ended before its runs did. In a script, what starts processes stands below "
            "if __name__ == '__main__':. If it does, memory may have run out."
        )
        raise
    finally:
        for future in futures:  # a failure or an interruption leaves no batch waiting
            future.cancel()
    return results  # type: ignore[return-value]


def _has_processes(executor: Executor) -> bool:
    """Whether it is Python's pool of processes, which a browser's Python cannot even import."""
    if sys.platform == "emscripten":
        return False
    from concurrent.futures import ProcessPoolExecutor

    return isinstance(executor, ProcessPoolExecutor)


def _call(compile_it: bool, task: Task[Result], rng: np.random.Generator, runs: int) -> Result:
    """Call a task where it was sent, with NumPy or Numba as in the process that sent it."""
    if loops.on != compile_it:
        use_compiled(compile_it)
    return task(rng, runs)


def _sendable(task: object) -> None:
    """Refuse what another process cannot be given: a lambda, or what stands in a notebook."""
    try:
        pickle.dumps(task)
        reason = ", ".join(f"{name} of a notebook or prompt" for name in names_of_no_file(task))
    except Exception as error:
        reason = str(error)
    if reason:
        raise ValueError(
            "task: expected, for other processes, a function of a module, a method of an object of "
            f"such a class or a partial of these, got {shown(task)}: {reason}"
        )


MISSING = object()
"""What is read where there is no whole batch."""

_DIGEST = 32


class _KeptBatches:
    """The batches of one study in a folder of its own.

    Parameters
    ----------
    folder : Path
        In it, a folder is made for each study, so that many may share one. What is in it is read by
        `pickle`, which runs what it reads: name no folder in which a stranger may write.
    task : callable
        See `describe`.
    seed, batch : int
        With the task, with the code that it runs, and with NumPy or Numba, they say which study it
        is: what was kept for another, or by another version of the code, is never taken.

    Attributes
    ----------
    folder : Path
        Of the study; ``study.json`` in it says what it is.

    Raises
    ------
    ValueError
        If the task cannot be described, or the folder cannot be written.
    """

    def __init__(self, folder: Path, task: Any, seed: int, batch: int) -> None:
        study = {
            "task": describe(task),
            "seed": seed,
            "batch": batch,
            "driftlab": driftlab.__version__,
            "code": code_of(task),
            "arithmetic": loops.arithmetic(),
        }
        text = json.dumps(study, indent=1, ensure_ascii=False)
        self.folder = folder / sha256(text.encode()).hexdigest()[:20]
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._put("study.json", text.encode())
        except OSError as error:
            raise ValueError(f"folder: expected one to write in, got {folder}: {error}.") from error

    def read(self, index: int, size: int) -> Any:
        """Return what was kept of a batch, or `MISSING`; a file that is damaged counts as none."""
        try:
            kept = (self.folder / _name(index, size)).read_bytes()
        except OSError:
            return MISSING
        digest, result = kept[:_DIGEST], kept[_DIGEST:]
        return pickle.loads(result) if sha256(result).digest() == digest else MISSING

    def write(self, index: int, size: int, result: Any) -> None:
        """Keep a batch."""
        data = pickle.dumps(result, protocol=5)
        self._put(_name(index, size), sha256(data).digest() + data)

    def _put(self, name: str, data: bytes) -> None:
        """Write a file whole or not at all, whoever is killed and whoever else writes it."""
        number, part = tempfile.mkstemp(prefix=f"{name}.", suffix=".part", dir=self.folder)
        try:
            with os.fdopen(number, "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(part, self.folder / name)
        except BaseException:
            Path(part).unlink(missing_ok=True)
            raise


def _name(index: int, size: int) -> str:
    return f"{index:07d}-{size}.batch"
