"""Where many runs may go: processes of this computer, or those of a cluster."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

from driftlab.checks import checked_text, whole_number

THREADS = tuple(
    f"{name}_THREADS" for name in ("OPENBLAS_NUM", "MKL_NUM", "OMP_NUM", "VECLIB_MAXIMUM")
)
"""What keeps a process to one thread for its matrices; the processes share the cores already."""


@contextmanager
def processes(count: int | None = None) -> Iterator[Executor | None]:
    """Processes of this computer, each with one thread for its matrices.

    In a browser, where there is one process only, a warning says so, and it yields None: then
    `sweep` makes its runs one after the other.

    Parameters
    ----------
    count : int, optional
        One for each core that this process may use, if not given.

    Yields
    ------
    concurrent.futures.Executor or None
        For `sweep` or `running_on`. Each process is started afresh and imports what the task needs,
        so a script has its own calls below ``if __name__ == "__main__":``.

    Raises
    ------
    ValueError
        If `count` is not a whole number above zero.

    Examples
    --------
    >>> with processes(2) as pool:
    ...     pool.submit(pow, 2, 10).result()
    1024
    """
    many = whole_number(count, "count") if count is not None else _cores()
    if sys.platform == "emscripten":
        warnings.warn(
            "In a browser the runs come one after the other: it has one process only.",
            stacklevel=3,  # beyond contextlib
        )
        yield None
        return
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update({name: "1" for name, value in before.items() if value is None})
    try:
        # Not forked: a copy of a process with threads, as those of BLAS, may hang.
        with ProcessPoolExecutor(many, mp_context=get_context("spawn")) as pool:
            yield pool
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)


def _cores() -> int:
    """Return how many cores this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


@contextmanager
def cluster(scheduler: str) -> Iterator[Executor]:
    """The workers of a cluster, by dask.distributed: ``pip install driftlab[cluster]``.

    Parameters
    ----------
    scheduler : str
        Its address, as ``tcp://10.0.0.1:8786``. The workers need this package, and the modules in
        which the task stands, in the same versions as here.

    Yields
    ------
    concurrent.futures.Executor
        For `sweep` or `running_on`. What a worker had begun when it was lost, another begins anew.

    Raises
    ------
    ModuleNotFoundError
        If dask.distributed is not installed.
    OSError
        If nothing answers at the address.

    Examples
    --------
    >>> with cluster("tcp://10.0.0.1:8786") as pool:  # doctest: +SKIP
    ...     sweep(trial.run, 1_000_000, seed=1, executor=pool, folder="kept")
    """
    address = checked_text(scheduler, "scheduler")
    try:
        from distributed import Client
    except ModuleNotFoundError as missing:
        raise ModuleNotFoundError(
            "A cluster needs dask.distributed: pip install driftlab[cluster]."
        ) from missing
    with Client(address) as client:
        yield client.get_executor(pure=False)
