"""How the benchmarks take times."""

import timeit
from collections.abc import Callable


def best(call: Callable[[], object], repeats: int = 5) -> float:
    """Seconds of the quickest of several calls, after one to warm up."""
    call()
    return min(timeit.repeat(call, number=1, repeat=repeats))
