"""Where many runs may go: processes of this computer, or those of a cluster."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import AbstractContextManager, contextmanager
from multiprocessing import get_context, parent_process
from threading import Thread

from driftlab.checks import checked_text, shown, whole_number

THREADS = tuple(
    f"{name}_THREADS" for name in ("OPENBLAS_NUM", "MKL_NUM", "OMP_NUM", "VECLIB_MAXIMUM")
)
"""What keeps a process to one thread for its matrices; the processes share the cores already."""


def processes(count: int | None = None) -> AbstractContextManager[Executor | None]:
    """Return processes of this computer for a ``with`` block, each with one thread for matrices.

    In a browser, where there is one process only, a warning says so, and the block has None: then
    `sweep` makes its runs one after the other.

    Parameters
    ----------
    count : int, optional
        One for each core that this process may use, if not given.

    Returns
    -------
    context manager
        Of a `concurrent.futures.Executor`, for `sweep` or `running_on`. Each process is started
        afresh and imports what the task needs, so a script has its own calls below
        ``if __name__ == "__main__":``. They end with this process, even where it is killed.

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
    return _processes(cores() if count is None else whole_number(count, "count"))


@contextmanager
def _processes(count: int) -> Iterator[Executor | None]:
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
        spawned = get_context("spawn")
        with ProcessPoolExecutor(count, spawned, initializer=_end_with_parent) as pool:
            yield pool
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)


def _end_with_parent() -> None:
    """Let a process end with the one that started it; killed, that one could not say a word."""

    def wait() -> None:
        if parent := parent_process():
            parent.join()
            os._exit(1)

    Thread(target=wait, daemon=True).start()


def cores() -> int:
    """Return how many cores this process may use.

    Returns
    -------
    int

    Examples
    --------
    >>> cores() >= 1
    True
    """
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def cluster(scheduler: str) -> AbstractContextManager[Executor]:
    """Return the workers of a cluster for a ``with`` block: ``pip install driftlab[cluster]``.

    It is a cluster of dask.distributed.

    Parameters
    ----------
    scheduler : str
        Its address, as ``tcp://10.0.0.1:8786``. The workers need this package, and the modules in
        which the task stands, in the same versions as here.

    Returns
    -------
    context manager
        Of a `concurrent.futures.Executor`, for `sweep` or `running_on`. What a worker had begun
        when it was lost, another begins anew.

    Raises
    ------
    ValueError
        If `scheduler` is no address.
    ModuleNotFoundError
        If dask.distributed is not installed.
    OSError
        If nothing answers at the address.

    Examples
    --------
    With a scheduler there, ``with cluster("tcp://10.0.0.1:8786") as pool:`` and below it
    ``sweep(trial.run, 1_000_000, seed=1, executor=pool, folder="kept")``.

    >>> cluster("10.0.0.1")
    Traceback (most recent call last):
        ...
    ValueError: scheduler: expected an address as tcp://10.0.0.1:8786, got '10.0.0.1'.
    """
    address = checked_text(scheduler, "scheduler")
    if "://" not in address:
        raise ValueError(
            f"scheduler: expected an address as tcp://10.0.0.1:8786, got {shown(scheduler)}."
        )
    return _cluster(address)


@contextmanager
def _cluster(address: str) -> Iterator[Executor]:
    try:
        from distributed import Client
    except ModuleNotFoundError as missing:
        raise ModuleNotFoundError(
            "A cluster needs dask.distributed: pip install driftlab[cluster]."
        ) from missing
    with Client(address) as client:
        yield client.get_executor(pure=False)
