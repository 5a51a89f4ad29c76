"""Many random runs: seeded, in batches, on any executor, with the same result on each."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor, as_completed
from typing import TypeVar

import numpy as np
from scipy.stats import chi2

from .checks import checked_function, checked_instance, probability, whole_number

Result = TypeVar("Result")
Task = Callable[[np.random.Generator, int], Result]


def sweep(
    task: Task[Result],
    runs: int,
    *,
    seed: int,
    batch: int = 10,
    executor: Executor | None = None,
    progress: Callable[[int], object] | None = None,
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
        Where the calls run. If not given, they run here, one after the other.
    progress : callable, optional
        Called with the number of runs of each batch when it is done, as the method `update` of a
        bar of tqdm wants it.

    Returns
    -------
    list
        What `task` returned, in the order of the batches.

    Raises
    ------
    ValueError
        If `runs`, `batch` or `seed` is not a whole number in its range.

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
    children = np.random.SeedSequence(whole_number(seed, "seed", least=0, most=None)).spawn(
        len(sizes)
    )
    generators = [np.random.default_rng(child) for child in children]

    def report(size: int) -> None:
        if progress is not None:
            progress(size)

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


def mean_square_bounds(freedom: int, runs: int, confidence: float = 0.95) -> tuple[float, float]:
    """Confidence bounds of the mean of squared normalised errors over many runs.

    Parameters
    ----------
    freedom : int
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

    Notes
    -----
    If the errors are as large as their covariance states, the sum of the squared errors of all runs
    has a chi-square distribution with ``freedom * runs`` degrees of freedom. Both tails are equal.

    Examples
    --------
    >>> [round(bound, 3) for bound in mean_square_bounds(3, 100)]
    [2.539, 3.499]
    """
    inside, many = probability(confidence, "confidence"), whole_number(runs, "runs")
    tails = np.array([1 - inside, 1 + inside]) / 2
    low, high = chi2.ppf(tails, float(whole_number(freedom, "freedom")) * many) / many
    return float(low), float(high)
