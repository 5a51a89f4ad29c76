"""Monte Carlo runs: seeded batches in many processes, kept on disk, with the same numbers anywhere.

joblib starts the processes or sends the batches to a cluster; it is imported when that is asked
for.
"""

from __future__ import annotations

import inspect
import os
import pickle
import sys
import warnings
from collections.abc import Callable, Generator
from contextlib import nullcontext, suppress
from functools import partial
from hashlib import sha256
from itertools import chain
from pathlib import Path
from typing import Any, TypeVar
from uuid import uuid4

import numpy as np
import scipy

import driftlab
from driftlab.checks import checked_function, checked_path, probability, shown, whole_number
from driftlab.core import loops
from driftlab.core.quantiles import chi_squared_quantile

__all__ = ["mean_square_bounds", "run_batches"]

Result = TypeVar("Result")
Task = Callable[[np.random.Generator, int], Result]

FOLDER = "DRIFTLAB_RUNS"
"""Environment variable: the folder of calls that name none."""


def run_batches(
    task: Task[Result],
    runs: int,
    *,
    seed: int,
    batch_size: int = 10,
    workers: int | None = None,
    folder: str | Path | None = None,
    progress: Callable[[int], object] | None = None,
) -> list[Result]:
    """Make Monte Carlo runs: call ``task(rng, size)`` for batches of runs, in parallel if asked.

    Parameters
    ----------
    task : callable
        Takes a numpy Generator and a number of runs, and draws all that is random from it.
    runs : int
        Number of runs in all.
    seed : int
        Each batch has its own generator, spawned from the seed by ``numpy.random.SeedSequence``,
        so workers and order do not change the numbers; `batch_size` does.
    batch_size : int
        Number of runs in one call of `task`.
    workers : int, optional
        Number of processes, each with one thread for matrices; -1 for one per core. If not given,
        whatever ``joblib.parallel_config`` says, such as a cluster; else one batch after another.
    folder : str or Path, optional
        Where each batch is kept when it is finished. After an interruption the same call reads
        those and makes the rest; with more runs it goes on from them. If not given, the
        environment variable ``DRIFTLAB_RUNS``.
    progress : callable, optional
        Called with the number of runs of each finished batch, as ``update`` of a bar of tqdm.

    Returns
    -------
    list
        What `task` returned, in the order of the batches.

    Raises
    ------
    ValueError
        If `folder` cannot be written, or if `task` has no source or cannot be pickled for it.
    ModuleNotFoundError
        If `workers` or `folder` need joblib, and it is not installed.

    Notes
    -----
    A kept batch is read only for the same task and source of its function or class, the same seed
    and `batch_size`, and the same versions of this package, NumPy, SciPy and Numba. Changes in what
    else the task uses, such as constants of its module, other functions and files, are not seen:
    use another folder then. Files are read by `pickle`, which runs what it reads: name no folder to
    which a stranger may write.

    Products of large matrices, if the task has them, have other last digits with several threads
    than with one. OPENBLAS_NUM_THREADS=1 in the environment gives one process the digits of many.

    Examples
    --------
    >>> run_batches(lambda rng, size: size, 25, seed=1)
    [10, 10, 5]
    >>> batches = run_batches(lambda rng, size: rng.random(size), 2000, seed=1, batch_size=1000)
    >>> np.mean(batches, axis=1).round(2)
    array([0.49, 0.51])

    On all cores, to be continued: ``run_batches(trial.run, 1000, seed=1, workers=-1,
    folder="kept")``. On a cluster: within ``joblib.parallel_config("dask")``.
    """
    checked_function(task, "task", "a generator and a number of runs")
    total, most = whole_number(runs, "runs"), whole_number(batch_size, "batch_size")
    root = whole_number(seed, "seed", least=0, most=None)
    if workers is not None and whole_number(workers, "workers", least=-1) == 0:
        raise ValueError("workers: expected a number of processes, or -1 for all cores, got 0.")
    if folder is None:
        folder = os.environ.get(FOLDER) or None
    kept_in = None if folder is None else checked_path(folder, "folder")
    if progress is not None:
        checked_function(progress, "progress", "a number of runs")
    if sys.platform == "emscripten" and (kept_in or workers not in (None, 1)):
        warnings.warn(
            "In a browser the runs come one after the other, and no batch is kept.", stacklevel=2
        )
        workers, kept_in = 1, None
    sizes = [min(most, total - first) for first in range(0, total, most)]
    files: list[Path | None] = [None] * len(sizes)
    if kept_in is not None:
        own = _own_folder(kept_in, task, root, most)
        files = [own / f"{number:07d}-{size}.batch" for number, size in enumerate(sizes)]
    kept = _read(files)
    children = np.random.SeedSequence(root).spawn(len(sizes))
    if len(kept) < len(sizes) and kept_in is not None:
        _refuse_unwritable(own)
    left = [
        (number, task, children[number], size, files[number], loops.asked)
        for number, size in enumerate(sizes)
        if number not in kept
    ]
    made = _made(left, workers)
    results: list[Any] = [None] * len(sizes)
    try:
        for number, result in chain(kept.items(), made):
            results[number] = result
            file = files[number]
            if file and not file.exists():
                _write(file, result)
            if progress is not None:
                progress(sizes[number])
    except BaseException as error:
        made.throw(error)  # no batch is left waiting
        raise
    return results


def _made(
    batches: list[tuple[Any, ...]], workers: int | None
) -> Generator[tuple[int, Any], None, None]:
    """Make batches, and return the number and the result of each as soon as it is finished."""
    if workers == 1 or (workers is None and "joblib" not in sys.modules):
        yield from (_batch(*batch) for batch in batches)
        return
    joblib = _joblib(f"workers: {workers} processes")
    here = {"n_jobs": workers, "inner_max_num_threads": 1}
    with nullcontext() if workers is None else joblib.parallel_config("loky", **here):
        # Large arrays of the task may be written in workers, as where there are none.
        parallel = joblib.Parallel(return_as="generator_unordered", batch_size=1, mmap_mode="c")
    yield from parallel(joblib.delayed(_batch)(*batch) for batch in batches)


def _batch(
    number: int,
    task: Task[Result],
    child: np.random.SeedSequence,
    size: int,
    file: Path | None,
    asked: bool | None,
) -> tuple[int, Result]:
    """Make one batch, with NumPy or Numba as where it was asked for, and keep it at once."""
    loops.asked = asked  # a process that was there before knows nothing of it
    result = task(np.random.default_rng(child), size)
    if file:
        with suppress(Exception):  # if this computer or process cannot, the caller writes it
            _write(file, result)
    return number, result


def _joblib(what: str) -> Any:
    try:
        import joblib
    except ModuleNotFoundError as missing:
        raise ModuleNotFoundError(
            f"{what}: joblib is not installed; pip install driftlab[parallel] brings it.",
            name="joblib",
        ) from missing
    return joblib


def _own_folder(folder: Path, task: Any, seed: int, batch_size: int) -> Path:
    """Make the folder of all batches with one key: the task, its source, its seed, versions."""
    run = task
    while isinstance(run, partial):
        run = run.func
    source = _source(run)
    if not source:
        raise ValueError(
            "task: expected, to be kept, a function or class of a file or a notebook, whose source "
            f"can be read, got {shown(task)}."
        )
    versions = driftlab.__version__, np.__version__, scipy.__version__, loops.arithmetic()
    joblib = _joblib("folder")
    try:
        defaults = getattr(run, "__defaults__", None), getattr(run, "__kwdefaults__", None)
        key = joblib.hash((versions, source, defaults, task, seed, batch_size))
    except Exception as error:
        raise ValueError(
            "task: expected, to be kept, a function of a module, a method or a partial, and in it "
            f"what can be pickled, got {shown(task)}: {error}."
        ) from error
    own = folder / f"{getattr(run, '__qualname__', type(run).__name__)}-{key}"
    try:
        own.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(f"folder: expected one to write in, got {folder}: {error}.") from error
    return own


def _refuse_unwritable(folder: Path) -> None:
    """Try to write before anything is computed that would be lost."""
    trial = folder / f"{uuid4().hex}.part"
    try:
        trial.touch()
        trial.unlink()
    except OSError as error:
        raise ValueError(f"folder: expected one to write in, got {folder}: {error}.") from error


def _source(run: Any) -> str:
    """Source of a function, or of the class of a method or callable; "" where there is none."""
    thing = getattr(run, "__self__", run)
    try:
        return inspect.getsource(
            thing if inspect.isfunction(thing) or inspect.isclass(thing) else type(thing)
        )
    except (OSError, TypeError):
        return ""


def _read(files: list[Path | None]) -> dict[int, Any]:
    """Results by the numbers of their batches, from the files that are there and can be read."""
    results = {}
    for number, file in enumerate(files):
        with suppress(Exception):  # whatever is wrong with a file, its batch is made again
            if file and file.exists():
                with file.open("rb") as data:
                    digest, result = data.read(32), data.read()
                if sha256(result).digest() == digest:
                    results[number] = pickle.loads(result)
    return results


def _write(file: Path, result: Any) -> None:
    """Write a file whole or not at all, whoever is killed and whoever else writes it."""
    data = pickle.dumps(result, protocol=5)
    part = file.with_name(f"{file.stem}-{uuid4().hex}.part")
    try:
        with part.open("xb") as whole:
            whole.write(sha256(data).digest())
            whole.write(data)
            whole.flush()
            os.fsync(whole.fileno())
        os.replace(part, file)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def mean_square_bounds(
    degrees_of_freedom: int, runs: int, confidence: float = 0.95
) -> tuple[float, float]:
    """Confidence bounds of the mean of squared normalised errors (NEES, NIS) over many runs.

    If the errors are as large as their covariance states, the sum of their squares over all runs
    has a chi-square distribution with ``degrees_of_freedom * runs`` degrees of freedom. Both tails
    are equal.

    Parameters
    ----------
    degrees_of_freedom : int
        Number of components of each error.
    runs : int
        Number of independent runs over which the mean is taken.
    confidence : float
        Probability that the mean lies between the bounds, from 0 to 1.

    Returns
    -------
    lower, upper : float
        Bounds of the mean, without unit.

    Raises
    ------
    ValueError
        If `confidence` is not between 0 and 1.

    Examples
    --------
    >>> [round(bound, 3) for bound in mean_square_bounds(3, 100)]
    [2.539, 3.499]
    """
    inside, many = probability(confidence, "confidence"), whole_number(runs, "runs")
    tails = np.array([1 - inside, 1 + inside]) / 2
    low, high = (
        chi_squared_quantile(
            tails, float(whole_number(degrees_of_freedom, "degrees_of_freedom")) * many
        )
        / many
    )
    return float(low), float(high)
