"""Many random runs: seeded, in batches, on any executor, with the same result on each."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor, as_completed
from typing import TypeVar

import numpy as np
from scipy.stats import chi2

from .checks import whole_number

Result = TypeVar("Result")
Task = Callable[[np.random.Generator, int], Result]


def sweep(
    task: Task[Result],
    runs: int,
    *,
    seed: int,
    batch: int = 10,
    executor: Executor | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> list[Result]:
    """Call ``task(rng, runs)`` for batches of runs that add up to `runs`.

    Parameters
    ----------
    task : callable
        Takes a numpy Generator and a number of runs. For a process pool it must be importable: a
        method of an object from a module, say, not a lambda.
    runs : int
    seed : int
        Each batch has a generator of its own from it, so neither the executor nor the order in
        which batches finish changes anything. The size of the batches does.
    batch : int
        Runs in one call.
    executor : concurrent.futures.Executor, optional
        Where the calls run; here, one after the other, if not given.
    progress : callable, optional
        Called with the number of runs done and `runs`; `print_progress` shows a bar.

    Returns
    -------
    list
        The results in the order of the batches.
    """
    total, most = whole_number(runs, "runs"), whole_number(batch, "batch")
    sizes = [min(most, total - first) for first in range(0, total, most)]
    children = np.random.SeedSequence(whole_number(seed, "seed", least=0)).spawn(len(sizes))
    generators = [np.random.default_rng(child) for child in children]
    done = 0

    def report(size: int) -> None:
        nonlocal done
        done += size
        if progress is not None:
            progress(done, total)

    results = []
    if executor is None:
        for generator, size in zip(generators, sizes, strict=True):
            results.append(task(generator, size))
            report(size)
        return results
    pairs = zip(generators, sizes, strict=True)
    futures = {executor.submit(task, generator, size): size for generator, size in pairs}
    try:
        for future in as_completed(futures):
            future.result()
            report(futures[future])
    finally:
        for future in futures:  # a failure or an interruption leaves no batch waiting
            future.cancel()
    return [future.result() for future in futures]


def print_progress(done: int, total: int, width: int = 40) -> None:
    """Show a bar on the terminal or under a notebook cell."""
    filled = width * done // max(total, 1)
    bar = "#" * filled + "." * (width - filled)
    print(f"\r[{bar}] {done} of {total}", end="\n" if done == total else "", flush=True)


def mean_square_bounds(freedom: int, runs: int, confidence: float = 0.95) -> tuple[float, float]:
    """Bounds of the mean over `runs` of squared normalised errors with `freedom` components each.

    Their sum has a chi-square distribution if the errors are as large as their covariance says.
    """
    if not 0 < confidence < 1:
        raise ValueError(f"confidence: expected a number between 0 and 1, got {confidence!r}.")
    many = whole_number(runs, "runs")
    tails = np.array([1 - confidence, 1 + confidence]) / 2
    low, high = chi2.ppf(tails, whole_number(freedom, "freedom") * many) / many
    return float(low), float(high)
